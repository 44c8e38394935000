"""What is wanted of a run's figures, as the run itself has told in its table."""

import re

_VERDICT = re.compile(r"\s*(NOT OK|ok)?\s*$")
_LABEL = 48  # columns of a figure's meaning, with what stands before it (mp/figure_table.cpp)
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"


def read(said: str, figures: dict[str, float | list[float] | None]) -> dict[str, str]:
    """What is wanted, such as "<= 0.5" or "1 +- 0.05", by a figure's key. The table names meanings, not keys: a row
    belongs to the key whose numbers it shows. A row that could be of several is left out."""
    wanted: dict[str, str] = {}
    by_cells: dict[tuple[str, ...], list[str]] = {}
    for key, value in figures.items():
        by_cells.setdefault(tuple(_cell(x) for x in (value if isinstance(value, list) else [value])), []).append(key)
    for cells, text in _rows(said):
        keys = by_cells.get(cells, [])
        if text and len(keys) == 1:
            wanted[keys[0]] = text
    return wanted


def interval(wanted: str) -> tuple[float | None, float | None]:
    """Lower and upper bound of what is wanted; None: there is none."""
    if match := re.fullmatch(rf"({_NUMBER}) \+- ({_NUMBER})", wanted):
        middle, half = float(match[1]), float(match[2])
        return middle - half, middle + half
    if match := re.fullmatch(rf"(<=|>=)? ?({_NUMBER})", wanted):
        x = float(match[2])
        return {"<=": (None, x), ">=": (x, None)}.get(match[1], (x, x))
    return None, None


def _cell(x: float | None) -> str:
    return "-" if x is None else f"{x:.4g}"


def _rows(said: str):
    column = 0
    for line in said.splitlines():
        if line.startswith("  figure "):
            column = line.index("wanted")
        elif column and not line.startswith("  "):
            return
        elif column and line[:_LABEL].strip():
            yield tuple(line[_LABEL:column].split()), _VERDICT.sub("", line[column:])
