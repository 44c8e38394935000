"""Where the tests of campaigns run: a folder of their own, a made-up task, and commands in processes of their own."""

import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "ui_cli" / "python"))
HOP = Path(__file__).with_name("hop")
_ENVIRONMENT = os.environ | {
    "PYTHONPATH": str(SOURCE / "ui_cli" / "python"),
    "PYTHONDONTWRITEBYTECODE": "1",
    "MRROC_CALLED": "./run",
}


class Place(unittest.TestCase):
    """A test with a folder, in which every command runs."""

    def setUp(self):
        self.home = Path(tempfile.mkdtemp(prefix="mrroc_campaign."))
        self.programs = self.home / "bin"
        self.programs.mkdir()
        shutil.copy(HOP, self.programs / "hop")
        self.started: list[subprocess.Popen] = []
        os.environ["MRROC_PROGRAMS"] = str(self.programs)

    def tearDown(self):
        for process in self.started:
            if process.poll() is None:
                process.kill()
            process.communicate()
        shutil.rmtree(self.home, ignore_errors=True)

    def start(self, *words, before=()) -> subprocess.Popen:
        """A command in a session of its own, so that a signal comes to it as from a terminal."""
        environment = _ENVIRONMENT | {"MRROC_PROGRAMS": str(self.programs)}
        process = subprocess.Popen(
            [*before, sys.executable, "-m", "mrroc_campaign", *map(str, words)], cwd=self.home, env=environment, start_new_session=True,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.started.append(process)
        return process

    def command(self, *words, status=0, before=()) -> str:
        """What a command says on both streams, when it ends with that status."""
        process = self.start(*words, before=before)
        said = "\n".join(process.communicate(timeout=100))
        self.assertEqual(process.returncode, status, said)
        return said

    def counted(self, folder: str) -> list[dict]:
        """The table of a campaign."""
        db = sqlite3.connect(self.home / folder / "results.sqlite")
        db.row_factory = sqlite3.Row
        rows = [dict(r) for r in db.execute("SELECT * FROM runs ORDER BY run")]
        db.close()
        return rows

    def hashes(self, folder: str) -> list[tuple[int, str]]:
        """Of every counted run."""
        return [(r["run"], r["log_hash"]) for r in self.counted(folder)]

    def await_runs(self, folder: str, number: int, process: subprocess.Popen):
        """Until so many runs are counted, or the command has ended."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None:
            if (self.home / folder / "results.sqlite").is_file() and len(self.counted(folder)) >= number:
                return
            time.sleep(0.02)


def children(pid: int, word: str) -> list[int]:
    """Processes below one, whose command line has a word."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parent = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if parent == pid:
                found += children(int(entry.name), word)
                if word.encode() in words:
                    found.append(int(entry.name))
    return found


def kill(pids: list[int]) -> None:
    """Without a warning; who has gone already is no matter."""
    for pid in pids:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass


def is_alive(word: str) -> bool:
    """Whether any process has a word in its command line, such as a folder of this test."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid():
            try:
                if word.encode() in (entry / "cmdline").read_bytes():
                    return True
            except OSError:
                continue
    return False
