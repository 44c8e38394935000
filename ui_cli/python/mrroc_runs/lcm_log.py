"""LCM event logs."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_SYNC = 0xEDA1DA01
_HEADER = struct.Struct(">IqqII")


@dataclass
class Event:
    """One message as it was written down."""

    number: int
    time_us: int  # since 1970
    channel: str
    data: bytes


def events(file: Path) -> Iterator[Event]:
    """All events of a log. Raises ValueError where it is damaged; a last one that was cut off is left out."""
    with file.open("rb") as log:
        while head := log.read(_HEADER.size):
            if len(head) < _HEADER.size:
                return
            sync, number, time_us, channel_size, data_size = _HEADER.unpack(head)
            if sync != _SYNC:
                raise ValueError(f"{file}: no event begins at byte {log.tell() - _HEADER.size}")
            channel, data = log.read(channel_size), log.read(data_size)
            if len(data) < data_size:
                return
            yield Event(number, time_us, channel.decode(), data)
