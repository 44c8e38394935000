"""Takes the message definitions along, so that the installed package needs no clone. All else is in pyproject.toml."""

from pathlib import Path
from shutil import copy

from setuptools import setup
from setuptools.command.build_py import build_py

DEFINITIONS = Path(__file__).resolve().parents[2] / "base" / "msg"


class WithDefinitions(build_py):
    """The package's modules, and base/msg/*.lcm as mrroc_runs/msg."""

    def run(self):
        super().run()
        folder = Path(self.build_lib) / "mrroc_runs" / "msg"
        folder.mkdir(parents=True, exist_ok=True)
        for file in DEFINITIONS.glob("*.lcm"):
            copy(file, folder)


setup(cmdclass={"build_py": WithDefinitions})
