"""python -m tests.slurm [--cpus N] [arguments of Snakemake]"""

import sys

from tests.slurm.trial import main

sys.exit(main(sys.argv[1:]))
