"""LCM message definitions with fields of fixed size: their fingerprints, and how they become numpy arrays."""

import os
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

_PRIMITIVE = {
    "int8_t": ">i1",
    "int16_t": ">i2",
    "int32_t": ">i4",
    "int64_t": ">i8",
    "byte": ">u1",
    "boolean": ">i1",
    "float": ">f4",
    "double": ">f8",
}
_FIELD = re.compile(r"^\s*(\w+)\s+(\w+)\s*((?:\[\d+\])*)\s*;$")


@dataclass
class Member:
    """One field of a message."""

    type: str
    name: str
    shape: tuple[int, ...]


@dataclass
class Definition:
    """One message type."""

    name: str
    members: list[Member] = field(default_factory=list)


def _update(value: int, byte: int) -> int:
    """The step of LCM's hash: a signed 64-bit number."""
    shifted = (value << 8) & 0xFFFFFFFFFFFFFFFF
    value = ((shifted ^ ((value >> 55) & 0xFFFFFFFFFFFFFFFF)) + byte) & 0xFFFFFFFFFFFFFFFF
    return value - (1 << 64) if value >> 63 else value


def _update_text(value: int, text: str) -> int:
    value = _update(value, len(text))
    for letter in text.encode():
        value = _update(value, letter)
    return value


def parse(text: str) -> list[Definition]:
    """Definitions in a .lcm file. Raises ValueError for what has no fixed size."""
    found: list[Definition] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("//")[0].strip()
        if not line or line.startswith("package") or line == "}":
            continue
        if opened := re.match(r"^struct\s+(\w+)\s*\{?$", line):
            found.append(Definition(opened[1]))
        elif line == "{":
            continue
        elif member := _FIELD.match(line):
            shape = tuple(int(n) for n in re.findall(r"\[(\d+)\]", member[3]))
            found[-1].members.append(Member(member[1], member[2], shape))
        else:
            raise ValueError(f"line {number}: '{line}' is no field of fixed size")
    return found


class Types:
    """All message types of a folder."""

    def __init__(self, folder: Path):
        files = sorted(folder.glob("*.lcm"))
        if not files:
            raise FileNotFoundError(f"{folder} holds no .lcm files; set MRROC_MSG to the folder base/msg of a clone")
        self._types = {d.name: d for file in files for d in parse(file.read_text())}
        self._by_fingerprint = {self.fingerprint(name): name for name in self._types}

    def fingerprint(self, name: str) -> bytes:
        """The first eight bytes of every message of the type."""
        value = self._hash(name) & 0xFFFFFFFFFFFFFFFF
        return value.to_bytes(8, "big")

    def _hash(self, name: str) -> int:
        value = 0x12345678
        for m in self._types[name].members:
            value = _update_text(value, m.name)
            if m.type in _PRIMITIVE:
                value = _update_text(value, m.type)
            value = _update(value, len(m.shape))
            for size in m.shape:
                value = _update(value, 0)  # of constant size
                value = _update_text(value, str(size))
        for m in self._types[name].members:
            if m.type not in _PRIMITIVE:
                value += self._hash(m.type.split(".")[-1])
        value &= 0xFFFFFFFFFFFFFFFF
        return ((value << 1) | (value >> 63)) & 0xFFFFFFFFFFFFFFFF

    def name_of(self, message: bytes) -> str | None:
        """The type of a message, None when no definition has its fingerprint."""
        return self._by_fingerprint.get(message[:8])

    def dtype(self, name: str) -> np.dtype:
        """Layout of the type on the wire, without the fingerprint."""
        members = []
        for m in self._types[name].members:
            base = np.dtype(_PRIMITIVE[m.type]) if m.type in _PRIMITIVE else self.dtype(m.type.split(".")[-1])
            members.append((m.name, base, m.shape))
        return np.dtype(members)


def default_folder() -> Path:
    """Where the definitions are: $MRROC_MSG, those installed with this package, or base/msg of the clone that holds it."""
    if given := os.environ.get("MRROC_MSG"):
        return Path(given)
    here = Path(__file__).resolve()
    installed = here.parent / "msg"
    return installed if installed.is_dir() else here.parents[3] / "base" / "msg"
