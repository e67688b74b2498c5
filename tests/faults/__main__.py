"""python -m tests.faults [--quick]"""

import sys

from tests.faults.campaign import main

sys.exit(main(sys.argv[1:]))
