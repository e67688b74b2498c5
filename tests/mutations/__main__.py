"""python -m tests.mutations [--all | mutant ...]"""

import sys

from tests.mutations.stored import main

sys.exit(main(sys.argv[1:]))
