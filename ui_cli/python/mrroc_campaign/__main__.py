"""The command: python3 -m mrroc_campaign, which is ./run campaign."""

import sys

from .command import main

sys.exit(main(sys.argv[1:]))
