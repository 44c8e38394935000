"""A campaign's file: its plan, and a row of a table for every run that has been counted (SQLite).

Table `runs`: run (number in the plan, from 0), seed, a column per varied value under its key, success (1: done, and all
figures as wanted), outcome (of summary.json; none: there is none), fault (code; empty: none), text (of the fault),
exit_status (null: out of time, or lost), log_hash, sim_s and wall_s [s], host, folder (of a run that was kept), bars (JSON: what
was wanted, [least, most] by figure, null: no bound), and a column per figure under its key; one number of several is
KEY[0], KEY[1]. Table `planned`: run, seed, settings (JSON: value as text by key). Table `campaign`: key, value (JSON)."""

import errno
import fcntl
import json
import os
import shutil
import sqlite3
from collections.abc import Iterable
from contextlib import contextmanager
from pathlib import Path

from .errors import CampaignError, bad_usage
from .plan import Plan, Row
from .unpack import unpack

FILE = "results.sqlite"
WORKER_LOST = "worker_lost"  # fault of a run that killed its workers again and again
MARK = "figure "  # before a figure that is named as another column
_MOST_FIGURES = 1000  # SQLite takes 2000 columns
_OF_RIGHTS = (errno.EACCES, errno.EPERM, errno.EROFS, errno.ENOENT, errno.ENOTDIR, errno.ENAMETOOLONG)
_COLUMNS = {
    "run": "INTEGER PRIMARY KEY", "seed": "INTEGER", "success": "INTEGER", "outcome": "TEXT", "fault": "TEXT", "text": "TEXT",
    "exit_status": "INTEGER", "log_hash": "TEXT", "sim_s": "REAL", "wall_s": "REAL", "host": "TEXT", "folder": "TEXT", "bars": "TEXT",
}  # fmt: skip


def _quoted(name: str) -> str:
    return '"' + name.replace('"', '""') + '"'


def refuse_used(folder: Path, resume: str) -> None:
    """Nothing may be where a new campaign is to be. resume: how to go on with one that is there."""
    with reading(folder):
        if not folder.exists() or (folder.is_dir() and not any(folder.iterdir())):
            return
        begun = (folder / FILE).is_file()
    what = "is not an empty folder" if folder.is_dir() else "is a file"
    raise bad_usage(f"{folder} {what}; choose another --dir" + (f", or go on with {resume}" if begun else ""))


class Results:
    """The file of the campaign in a folder."""

    def __init__(self, folder: Path):
        self.folder = folder
        with reading(folder):
            if not (folder / FILE).is_file():
                raise bad_usage(f"{folder} is no folder of a campaign: it has no {FILE}")
            with (folder / FILE).open("rb"):
                pass
            self._db = sqlite3.connect(folder / FILE, isolation_level=None, timeout=30)
        self._db.row_factory = sqlite3.Row
        self._lock = None
        try:
            self.plan = Plan(**self.note("plan"))
        except (sqlite3.DatabaseError, TypeError, ValueError) as damage:
            raise bad_usage(f"{folder / FILE} is no file of a campaign, or of another version: {damage}") from None
        self._columns = {c["name"] for c in self._db.execute("PRAGMA table_info(runs)")}

    @classmethod
    def create(cls, folder: Path, plan: Plan, planned: list[Row], keys: list[str]) -> "Results":
        """A new file. It appears when it is whole. keys: of the varied values."""
        new = folder / (FILE + ".new")
        with writing(folder):
            folder.mkdir(parents=True, exist_ok=True)
            new.unlink(missing_ok=True)
            db = sqlite3.connect(new, isolation_level=None)
            columns = [f"{_quoted(n)} {t}" for n, t in _COLUMNS.items()] + [f"{_quoted(k)} NUMERIC" for k in keys]
            db.execute("BEGIN")
            db.execute("CREATE TABLE campaign (key TEXT PRIMARY KEY, value TEXT)")
            db.execute("CREATE TABLE planned (run INTEGER PRIMARY KEY, seed INTEGER, settings TEXT)")
            db.execute(f"CREATE TABLE runs ({', '.join(columns)})")
            db.execute("INSERT INTO campaign VALUES ('plan', ?)", [json.dumps(plan.as_dict())])
            db.executemany("INSERT INTO planned VALUES (?, ?, ?)", [_planned(row) for row in planned])
            db.execute("COMMIT")
            db.close()
            os.replace(new, folder / FILE)
        return cls(folder)

    def note(self, key: str):
        """A value that was kept with the campaign; None: there is none."""
        row = self._db.execute("SELECT value FROM campaign WHERE key = ?", [key]).fetchone()
        return None if row is None else json.loads(row["value"])

    def keep_note(self, key: str, value) -> None:
        """Keeps a value of JSON with the campaign."""
        with writing(self.folder):
            self._db.execute("INSERT OR REPLACE INTO campaign VALUES (?, ?)", [key, json.dumps(value)])

    @contextmanager
    def alone(self):
        """Only one may carry out a campaign at a time. The system frees the lock of who has died."""
        with writing(self.folder):
            opened = (self.folder / ".lock").open("w")
        with opened as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise bad_usage(f"another process is carrying out the campaign {self.folder}") from None
            yield

    def planned(self) -> list[Row]:
        """All runs of the plan."""
        found = self._db.execute("SELECT * FROM planned ORDER BY run")
        return [Row(r["run"], r["seed"], json.loads(r["settings"])) for r in found]

    def plan_more(self, more: list[Row]) -> None:
        """Adds runs to the plan; those with a number that is there already are left out."""
        with writing(self.folder):
            self._db.execute("BEGIN")
            self._db.executemany("INSERT OR IGNORE INTO planned VALUES (?, ?, ?)", [_planned(row) for row in more])
            self._db.execute("COMMIT")

    def counted(self) -> list[dict]:
        """The table `runs`."""
        return [dict(r) for r in self._db.execute("SELECT * FROM runs ORDER BY run")]

    def counted_among(self, runs: Iterable[int]) -> list[dict]:
        """Rows of the table `runs` with these numbers."""
        rows = (self._db.execute("SELECT * FROM runs WHERE run = ?", [run]).fetchone() for run in runs)
        return [dict(r) for r in rows if r]

    def successes(self) -> dict[int, bool]:
        """Whether a run succeeded, by its number."""
        return {r["run"]: bool(r["success"]) for r in self._db.execute("SELECT run, success FROM runs")}

    def lost(self) -> list[int]:
        """Runs whose workers died again and again; they count as failures until they are carried out."""
        return [r["run"] for r in self._db.execute("SELECT run FROM runs WHERE fault = ?", [WORKER_LOST])]

    def figures(self) -> list[str]:
        """Columns that are figures, in the order in which they were met."""
        return self.note("figures") or []

    def add(self, row: Row, result: dict) -> bool:
        """Counts a run, all of it or nothing. result: as told.checked() makes it. Returns False when it is counted
        already; a run that was lost is counted anew."""
        figures = self._flat(result["figures"])
        values = {k: result[k] for k in _COLUMNS if k in result} | {
            "seed": row.seed,
            "bars": json.dumps(result["bars"]),
        }
        values |= row.settings | figures
        with writing(self.folder):
            counted = self._db.execute("SELECT fault FROM runs WHERE run = ?", [row.run]).fetchone()
            if counted and counted["fault"] != WORKER_LOST:
                return False
            values["folder"] = self._keep(row.run, result)
            self._db.execute("BEGIN IMMEDIATE")
            try:
                if new := [name for name in figures if name not in self._columns]:
                    for name in new:
                        self._db.execute(f"ALTER TABLE runs ADD COLUMN {_quoted(name)} REAL")
                    known = json.dumps([*self.figures(), *new])
                    self._db.execute("INSERT OR REPLACE INTO campaign VALUES ('figures', ?)", [known])
                names, marks = ", ".join(map(_quoted, values)), ", ".join("?" * len(values))
                self._db.execute(f"INSERT OR REPLACE INTO runs ({names}) VALUES ({marks})", list(values.values()))
                self._db.execute("COMMIT")
            except BaseException:
                if self._db.in_transaction:
                    self._db.execute("ROLLBACK")
                raise
            self._columns.update(figures)
        return True

    def _keep(self, run: int, result: dict) -> str:
        """Brings what a worker kept of a run to its place."""
        kept = self.folder / kept_as(run)
        if "left_at" in result:
            return result["left_at"]
        if "packed" not in result and not self._is_scratch(result.get("folder", "")):
            return ""
        shutil.rmtree(kept, ignore_errors=True)  # of one who died before he had counted it
        kept.parent.mkdir(exist_ok=True)
        if "packed" not in result:
            os.replace(result["folder"], kept)
        elif not unpack(result["packed"], kept):
            return ""
        said = kept / "output.txt"
        if said.is_file() and not said.is_symlink():
            with said.open("a") as out:
                out.write(f"campaign: this run folder was moved to {kept}/run\n")
        return kept_as(run)

    def _is_scratch(self, folder: str) -> bool:
        """Whether it is one of those in which runs of this campaign were carried out: nothing else is taken away."""
        try:
            path = Path(folder).resolve()
            return path.parent == (self.folder / "scratch").resolve() and path.is_dir()
        except (OSError, ValueError):  # no path at all
            return False

    def _flat(self, figures: dict) -> dict[str, float | None]:
        """A column per number. A figure that is named as another column gets a mark before it. SQLite does not tell
        capitals from small letters: of two such names the first is kept."""
        known = {name.lower(): name for name in self.figures()}
        others = {name.lower() for name in self._columns} - set(known)
        flat: dict[str, tuple[str, float | None]] = {}
        for key, value in figures.items():
            name = f"{MARK}{key}" if key.lower() in others else key
            several = [(f"{name}[{k}]", x) for k, x in enumerate(value)] if isinstance(value, list) else [(name, value)]
            for column, x in several:
                if column.lower() in known or len(known) < _MOST_FIGURES:
                    flat.setdefault(column.lower(), (known.setdefault(column.lower(), column), x))
        return dict(flat.values())


def kept_as(run: int) -> str:
    """The folder of a run that was kept, in the campaign's."""
    return f"kept/{run:06d}"


def _planned(row: Row) -> list:
    return [row.run, row.seed, json.dumps(row.settings)]


@contextmanager
def writing(folder: Path):
    """Makes one clear error of a full disk and of all else that keeps the campaign from being written."""
    try:
        yield
    except (OSError, sqlite3.OperationalError) as failed:
        if _is_of_rights(failed):
            raise _not_allowed(folder, "written", failed) from None
        raise CampaignError(
            3,
            "cannot_write",
            f"{folder} cannot be written ({failed}); all runs that are counted are kept: make room, then go on",
        ) from None


@contextmanager
def reading(folder: Path):
    """Makes one clear error of a folder that may not be read."""
    try:
        yield
    except (OSError, sqlite3.OperationalError) as failed:
        raise _not_allowed(folder, "read", failed) from None


def _is_of_rights(failed: Exception) -> bool:
    if isinstance(failed, OSError):
        return failed.errno in _OF_RIGHTS
    return any(told in str(failed) for told in ("readonly", "unable to open"))


def _not_allowed(folder: Path, what: str, failed: Exception) -> CampaignError:
    return bad_usage(f"{folder} cannot be {what} ({failed}); look at its rights, or choose another folder with --dir")
