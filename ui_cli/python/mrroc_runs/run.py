"""A run folder."""

import csv
import json
import tomllib
from collections import Counter
from pathlib import Path

import numpy as np

from . import lcm_log, lcm_types

# Each terminal numbers its own messages: numbers tell no order there (base/link/senders.hpp).
_SEVERAL_SENDERS = ("operator", "manual.words")


class Run:
    """One run folder. Files are read when they are asked for, and once."""

    def __init__(self, folder: str | Path, definitions: str | Path | None = None):
        self.folder = Path(folder)
        if not (self.folder / "config.toml").is_file():
            raise FileNotFoundError(f"{self.folder} is no run folder: it has no config.toml")
        self._definitions = Path(definitions) if definitions else None
        self._types: lcm_types.Types | None = None
        self._events: dict[str, list[bytes]] | None = None

    def __repr__(self) -> str:
        return f"Run({str(self.folder)!r})"

    @property
    def summary(self) -> dict:
        """summary.json."""
        return json.loads((self.folder / "summary.json").read_text())

    @property
    def config(self) -> dict:
        """config.toml."""
        return tomllib.loads((self.folder / "config.toml").read_text())

    def table(self, name: str) -> dict[str, np.ndarray]:
        """A CSV file of the folder: an array per column, of numbers where all are numbers, else of text."""
        with (self.folder / name).open(newline="") as file:
            rows = list(csv.reader(file))
        if not rows:
            raise ValueError(f"{self.folder / name} is empty")
        columns = list(zip(*rows[1:], strict=True)) or [()] * len(rows[0])
        return {heading: _array(column) for heading, column in zip(rows[0], columns, strict=True)}

    def arm(self, number: int) -> dict[str, np.ndarray]:
        """arm1.csv, arm2.csv: a row per macrostep. Positions [m], angle-axis [rad], forces [N], moments [N m]."""
        return self.table(f"arm{number}.csv")

    def log(self) -> list[dict[str, str]]:
        """messages.log: what processes said. time is in seconds of the wall clock since the start."""
        lines = []
        for line in (self.folder / "messages.log").read_text().splitlines():
            fields = line.split(maxsplit=4)
            if len(fields) == 5 and not line.startswith("#"):
                lines.append(dict(zip(("time", "process", "class", "code", "text"), fields, strict=True)))
        return lines

    def channels(self) -> dict[str, int]:
        """Channels of events.lcmlog, without the session's name, and the number of their messages."""
        return dict(Counter({name: len(data) for name, data in self._by_channel().items()}))

    def messages(self, channel: str) -> dict[str, np.ndarray]:
        """All messages of a channel: an array per field, nested fields as `header.stamp`. The first index counts
        messages, in the order in which they were sent, also those that came late. Raises KeyError for a channel that is not there, ValueError for messages of another version."""
        by_channel = self._by_channel()
        if channel not in by_channel:
            raise KeyError(f"no channel {channel}; there are {', '.join(sorted(by_channel))}")
        data = by_channel[channel]
        if self._types is None:
            self._types = lcm_types.Types(self._definitions or lcm_types.default_folder())
        name = self._types.name_of(data[0])
        if name is None or any(d[:8] != data[0][:8] for d in data):
            raise ValueError(f"{channel}: messages of another version than the definitions")
        layout = self._types.dtype(name)
        if any(len(d) != 8 + layout.itemsize for d in data):
            raise ValueError(f"{channel}: messages of a wrong size")
        raw = np.frombuffer(b"".join(d[8:] for d in data), dtype=layout)
        return dict(_flatten("", raw))

    def _by_channel(self) -> dict[str, list[bytes]]:
        if self._events is None:
            self._events = {}
            for event in lcm_log.events(self.folder / "events.lcmlog"):
                self._events.setdefault(_without_session(event.channel), []).append(event.data)
            for channel, data in self._events.items():
                if channel not in _SEVERAL_SENDERS:
                    data.sort(key=_number)
        return self._events


def _number(message: bytes) -> int:
    return int.from_bytes(message[16:24], "big", signed=True)  # behind LCM's fingerprint and the session


def _without_session(channel: str) -> str:
    return channel.split(".", 1)[-1]  # names of sessions have no full stop


def _array(column: tuple[str, ...]) -> np.ndarray:
    try:
        return np.array(column, dtype=float)
    except ValueError:
        return np.array(column)


def _flatten(prefix: str, raw: np.ndarray):
    for name in raw.dtype.names:
        part = raw[name]
        if part.dtype.names:
            yield from _flatten(f"{prefix}{name}.", part)
        else:
            yield prefix + name, part.astype(part.dtype.newbyteorder("="))


def open_run(folder: str | Path, definitions: str | Path | None = None) -> Run:
    """A run folder. definitions: folder of the .lcm files, when the package is not in a clone."""
    return Run(folder, definitions)


def newest_run(runs: str | Path = "runs", task: str = "") -> Run:
    """The newest run folder below `runs`, of a task if one is named."""
    folders = [f for f in Path(runs).glob(f"{task}*") if (f / "config.toml").is_file()]
    if not folders:
        raise FileNotFoundError(f"there is no run{' of ' + task if task else ''} in {Path(runs).resolve()}")
    return Run(max(folders, key=lambda f: (f / "config.toml").stat().st_mtime))
