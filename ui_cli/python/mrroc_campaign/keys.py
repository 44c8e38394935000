"""Who may give work to a scheduler and its workers: whoever has the key. All traffic is encrypted (TLS) under a
certificate that is made for the occasion."""

import json
import os
from pathlib import Path

from distributed.security import Security

from .errors import bad_usage

_ROLES = ("client", "scheduler", "worker")


def make(file: Path) -> Security:
    """A new key, in a file that nobody else can read."""
    security = Security.temporary()
    try:
        with os.fdopen(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as out:
            json.dump({"certificate": security.tls_worker_cert, "key": security.tls_worker_key}, out)
    except OSError as failed:
        raise bad_usage(f"the key cannot be written: {failed}") from None
    return security


def read(file: Path | None) -> Security | None:
    """The key in a file; None: there is none, and nothing is encrypted."""
    if file is None:
        return None
    try:
        found = json.loads(file.read_text())
        parts = {
            f"tls_{role}_{part}": found[name]
            for role in _ROLES
            for part, name in (("cert", "certificate"), ("key", "key"))
        }
        return Security(tls_ca_file=found["certificate"], require_encryption=True, **parts)
    except (OSError, ValueError, KeyError, TypeError) as wrong:
        raise bad_usage(f"--key-file {file} is no key of a scheduler: {wrong}") from None
