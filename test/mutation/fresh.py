"""Knows when `v.f += x` does what `v.f = x` does: v was made a few lines above, its field f is zero then, and nothing
has touched it since. What cannot be shown from the text is taken for different."""

from __future__ import annotations

import functools
import pathlib
import re

FOLDERS = ["base", "ecp", "edp", "mp", "vsp", "robots", "tasks"]
ASSIGNMENT = re.compile(r"^\s*(\w+)\.((?:\w+)(?:\.\w+|\[[^\]]+\])*) = ([^=;]+);$")
LOOP = re.compile(r"\b(for|while|do)\b|\[[&=]")  # also a lambda, which may be called in one
NUMBER = re.compile(r"^(?:(?:std::)?u?int(?:8|16|32|64)?(?:_t)?|unsigned|bool|char|float|double|(?:std::)?size_t|std::string)$")


class Fresh:
    """Fields of the structures below a folder."""

    def __init__(self, root: pathlib.Path):
        self.root = root

    @functools.cached_property
    def fields(self) -> dict[str, list[dict[str, bool]]]:
        """By name of the structure, for each of that name: its fields that are numbers, and whether they begin with zero."""
        found: dict[str, list[dict[str, bool]]] = {}
        for folder in FOLDERS:
            for file in sorted((self.root / folder).rglob("*.[ch]pp")):
                self._read(file.read_text().splitlines(), found)
        return found

    @staticmethod
    def _read(lines: list[str], found: dict) -> None:
        for n, line in enumerate(lines):
            head = re.match(r"(\s*)struct (\w+)(?: final)? \{$", line)
            if not head:
                continue
            fields: dict[str, bool] = {}
            for inner in lines[n + 1 :]:
                if inner.startswith(head[1] + "}"):
                    break
                field = re.match(r"\s*([\w:]+) (\w+(?:, \w+)*)(\{.*\})?;", inner)
                if field and NUMBER.match(field[1]):
                    zero = field[3] in ("{}", "{0}") or (field[1] == "std::string" and not field[3])
                    fields.update({name: zero for name in field[2].split(", ")})
            found.setdefault(head[2], []).append(fields)

    def begins_with_zero(self, declared: str, braces: bool, path: str) -> bool:
        """Whether a path into a new variable of a type is zero. Messages are plain numbers, zero when made with braces."""
        name = declared.split("::")[-1]
        if name.endswith("_t"):
            return braces
        kinds = self.fields.get(name, [])
        return bool(kinds) and all(k.get(path) is True for k in kinds)

    def is_same(self, lines: list[str], number: int) -> bool:
        """Whether an assignment, of the line of that number from 1 on, finds zero."""
        assignment = ASSIGNMENT.match(lines[number - 1])
        if not assignment:
            return False
        variable, path, _ = assignment.groups()
        for line in reversed(lines[max(0, number - 60) : number - 1]):
            made = re.match(rf"\s*(?:mrroc::)?([\w:]+) {variable}(\{{\}})?;", line)
            if made and made[1] not in ("return", "auto"):
                return self.begins_with_zero(made[1], bool(made[2]), path)
            touched = re.search(rf"(?<![\w.]){variable}(?:(?![\w.])|(?:\.\w+)+\()", line) or f"{variable}.{path}" in line
            if touched or not re.match(r"\s+\S|\s*$", line) or LOOP.search(line):
                return False
        return False
