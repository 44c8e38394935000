"""Options as all programs here take them, with errors in one form."""

import argparse
import re

from . import repeat
from .errors import bad_usage

CALLED = f"{repeat.called()} campaign"
_FROM_FILE = "@FILE stands for the words of a file, in which # begins a remark, such as tasks/press/plants.txt."


class Line(argparse.ArgumentParser):
    """A command's options. files: whether it takes @FILE."""

    def __init__(self, name: str, about: str, files: bool = False):
        super().__init__(
            prog=f"{CALLED}{name}",
            description=about,
            epilog=_FROM_FILE if files else None,
            allow_abbrev=False,
            formatter_class=argparse.RawDescriptionHelpFormatter,
        )

    def error(self, message: str):
        behind = "options of the task stand behind --; " if message.startswith("unrecognized") else ""
        raise bad_usage(f"{message}; {behind}look at {self.prog} --help")


class Once(argparse.Action):
    """An option that a line may have once."""

    def __call__(self, parser, namespace, values, option_string=None):
        if (first := getattr(namespace, f"{self.dest} typed", None)) is not None:
            parser.error(f"{option_string} is there twice, as {first} and as {values}")
        setattr(namespace, f"{self.dest} typed", values)
        setattr(namespace, self.dest, values)


def above_zero(text: str) -> int:
    """The type of an option that takes a whole number above 0."""
    if not re.fullmatch(r"\d+", text) or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no whole number above 0")
    return int(text)


def width(text: str) -> float:
    """The type of an option that takes a width of an interval."""
    try:
        if 0 < float(text) < 1:
            return float(text)
    except ValueError:
        pass
    raise argparse.ArgumentTypeError(f"'{text}' is no width of the interval between 0 and 1, such as 0.1")
