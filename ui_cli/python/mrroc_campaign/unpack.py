"""Brings a run folder that a worker has packed to its place, whatever is in the archive."""

import errno
import os
import shutil
import tarfile
import zlib
from io import BytesIO
from pathlib import Path, PurePosixPath

LARGEST_MB = 200  # of all files of a run folder; a larger one stays where it is
_MOST_FILES = 100_000
_OF_THE_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO)


def unpack(packed: bytes, folder: Path) -> bool:
    """Makes `folder` of an archive: only what comes to stand below it, no links and no devices, all of it owned by the one
    who asked. Returns False, and leaves no folder, when the archive is damaged or too large. Raises OSError when the disk
    is full."""
    folder.mkdir()
    try:
        with tarfile.open(fileobj=BytesIO(packed)) as archive:
            archive.extractall(folder, members=_members(archive))
        return True
    except OSError as failed:
        shutil.rmtree(folder, ignore_errors=True)
        if failed.errno in _OF_THE_DISK:
            raise
        return False
    except (tarfile.TarError, zlib.error, EOFError, ValueError, OverflowError):
        shutil.rmtree(folder, ignore_errors=True)
        return False


def is_below(name: str) -> bool:
    """Whether a member of that name comes to stand in the folder: `//x` is as absolute as `/x`."""
    path = PurePosixPath(name)
    return not path.is_absolute() and ".." not in path.parts


def _members(archive: tarfile.TarFile) -> list[tarfile.TarInfo]:
    members, size = [], 0
    for member in archive:
        size += member.size
        if member.size < 0 or size > LARGEST_MB * 1_000_000 or len(members) >= _MOST_FILES:
            raise tarfile.TarError("too much")
        if (member.isfile() or member.isdir()) and is_below(member.name):
            member.uid, member.gid, member.uname, member.gname = os.getuid(), os.getgid(), "", ""
            member.mode = 0o755 if member.isdir() else 0o644
            members.append(member)
    return members
