"""What a worker tells of a run, made fit for the table and the page. It comes from another process, maybe of another
host, and from a run that may have ended in any way: nothing is believed to have the type and the size that it should."""

import re

_MOST_FIGURES = 500  # of one run
_MOST_NUMBERS = 64  # of one figure
_LARGEST = 1e100  # of a figure; sums and squares of such numbers are still numbers


def checked(told, run: int) -> dict:
    """What `told` says of a run, with all that Results.add() takes, each of its type. A number that is none, is not
    finite or beyond 1e100 becomes None: not measured. Nothing but exit status 0 with the outcome `done` is a success,
    and a failure has a code."""
    told = told if isinstance(told, dict) else {}
    status, outcome = told.get("exit_status"), _text(told.get("outcome"), 40) or "none"
    status = status if isinstance(status, int) and abs(status) < 2**31 else None
    success = told.get("success") is True and status == 0 and outcome == "done"
    result = {
        "run": run, "success": success, "outcome": outcome, "fault": "" if success else _code(told.get("fault")),
        "text": "" if success else _text(told.get("text"), 2000), "exit_status": status,
        "log_hash": _text(told.get("log_hash"), 64), "sim_s": _number(told.get("sim_s")), "wall_s": _number(told.get("wall_s")), "host": _text(told.get("host"), 100),
        "figures": _figures(told.get("figures")), "bars": _bars(told.get("bars")),
    }  # fmt: skip
    result |= {key: told[key] for key, kind in (("folder", str), ("packed", bytes)) if isinstance(told.get(key), kind)}
    return result | ({"left_at": left_at} if (left_at := _text(told.get("left_at"), 4000)) else {})


def printable(text: str) -> str:
    """Without what a terminal would obey, and what UTF-8 has no bytes for."""
    return "".join(c if c.isprintable() else " " for c in text)


def _text(value, most: int) -> str:
    return printable(value[:most]) if isinstance(value, str) else ""


def _code(value) -> str:
    return re.sub(r"[^\w.-]", "_", value[:60]) if isinstance(value, str) and value else "unknown"


def _number(value) -> float | None:
    return float(value) if isinstance(value, (int, float)) and abs(value) <= _LARGEST else None  # NaN is not below


def _names(value) -> list[str]:
    """Keys that are names of figures: KEY[0] is the name of a column."""
    if not isinstance(value, dict):
        return []
    return [k for k in value if isinstance(k, str) and 0 < len(k) <= 80 and k.isprintable() and not {"[", "]"} & set(k)]


def _figures(value) -> dict:
    figures = {}
    for key in _names(value)[:_MOST_FIGURES]:
        x = value[key]
        figures[key] = [_number(n) for n in x[:_MOST_NUMBERS]] if isinstance(x, list) else _number(x)
    return figures


def _bars(value) -> dict:
    bars = {}
    for key in _names(value)[:_MOST_FIGURES]:
        if isinstance(value[key], list | tuple) and len(value[key]) == 2:
            bars[key] = [_number(n) for n in value[key]]
    return bars
