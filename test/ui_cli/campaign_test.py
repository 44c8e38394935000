"""Campaigns, on a made-up task and on press. Usage: campaign_test.py SOURCE_DIR BIN_DIR [NAME...]"""

import importlib.util
import sys
import unittest
from pathlib import Path

for needed, package in (("distributed", "distributed"), ("scipy", "scipy"), ("tqdm", "tqdm"), ("optuna", "optuna")):
    if importlib.util.find_spec(needed) is None:
        print(f"skipped: python3-{package} is not installed (./run campaign installs it)")
        sys.exit(77)

sys.path.insert(0, str(Path(__file__).parent / "campaign"))
from plan_cases import *  # noqa: E402, F403
from run_cases import *  # noqa: E402, F403
from runner_cases import *  # noqa: E402, F403
from statistics_cases import *  # noqa: E402, F403
from table_cases import *  # noqa: E402, F403

if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
