"""The program of a task: where it is, which parameters it has, and whether it takes some values."""

import hashlib
import json
import os
import re
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import lru_cache
from pathlib import Path

from .errors import CampaignError, bad_usage

# Another file, robot or host, or what the campaign itself gives: no input of a simulation.
_NOT_VARIED = ("seed", "log.", "film.", "hosts.")
_NOT_VARIED_ENDS = (".hardware", ".core", ".record")
WAIT_FOR_A_PERSON = {"manual": "--words"}  # tasks, and the option that names a script of what a person would do
DIGESTS = "2-"  # of fingerprints: those before were of the program of the task alone


@dataclass(frozen=True)
class Parameter:
    """A row of `TASK --parameters`: default (or what options make of it) as text in TOML, range in words (empty: none), unit."""

    key: str
    default: str
    range: str
    unit: str

    @property
    def kind(self) -> str:
        """number, integer, list or word."""
        if self.default.startswith("["):
            return "list"
        if self.default.startswith('"') or self.default in ("true", "false"):
            return "word"
        return "integer" if self.default.lstrip("+-").isdigit() else "number"


def folder() -> Path:
    """Where programs are: MRROC_PROGRAMS, the build of the clone that this file is in, or of an installation below the
    same prefix."""
    named = os.environ.get("MRROC_PROGRAMS")
    if named:
        return Path(named)
    here = Path(__file__).resolve()
    built = here.parents[3] / "build" / "release" / "bin"
    return built if built.is_dir() else here.parents[3] / "mrroc"


def find(task: str, commands: Iterable[str] = ()) -> Path:
    """The program of a task. commands: what else the word may have been meant to be."""
    path = folder() / task
    if "/" in task or task.startswith(".") or not os.access(path, os.X_OK) or not path.is_file():
        near = get_close_matches(task, [*commands, *_names()], 1)
        raise bad_usage(
            f"there is no task named '{task}' in {folder()}; "
            + (f"did you mean '{near[0]}'?" if near else "build it, or set MRROC_PROGRAMS to the folder of the programs")
        )
    return path


def _names() -> list[str]:
    """Programs that may be tasks."""
    try:
        found = [path.name for path in folder().iterdir() if path.is_file() and os.access(path, os.X_OK)]
    except OSError:
        return []
    return [name for name in found if not _is_started(name) and not name.endswith("_test")]


def digest(task: str, processes: str) -> str:
    """Fingerprint of all that a run can start, so that runs of two builds are not counted together: the program of the
    task, with separate processes all drivers, control systems, receptors and the simulator, and the libraries that are
    not the system's. processes: one or separate."""
    programs = [find(task)]
    if processes == "separate":
        programs += [path for path in folder().iterdir() if _is_started(path.name) and path.is_file()]
    states = tuple(sorted({_state(path) for path in programs}))
    files = {*states, *map(_state, _libraries(str(folder()), states))}
    said = sorted((Path(path).name, _digest(path, *state)) for path, *state in files)
    return DIGESTS + hashlib.sha256(json.dumps(said).encode()).hexdigest()[:16]


def _is_started(name: str) -> bool:
    return name == "simulator" or (name.startswith(("edp_", "ecp_", "vsp_")) and not name.endswith("_test"))


def _state(path: str | Path) -> tuple[str, int, int]:
    """What changes when a file does."""
    now = os.stat(path)
    return str(path), now.st_size, now.st_mtime_ns


@lru_cache(maxsize=1024)
def _digest(path: str, _size: int, _changed: int) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


@lru_cache(maxsize=8)
def _libraries(beside: str, programs: tuple) -> list[str]:
    """What the loader finds for programs, in their folder or elsewhere than where the system has its own."""
    paths = [path for path, *_ in programs]
    told = subprocess.run(["ldd", *paths], capture_output=True, text=True, errors="replace", check=False).stdout
    found = {line.split(" => ", 1)[1].rsplit(" (", 1)[0] for line in told.splitlines() if " => /" in line}
    return [p for p in found if str(Path(p).parent) == beside or not p.startswith(("/lib", "/usr/lib"))]


def settings_as_words(settings: dict[str, str]) -> list[str]:
    """Options of a task that set values."""
    return [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]


def parameters(task: str, options: list[str]) -> dict[str, Parameter]:
    """What can be varied, by its key, as the task itself tells it with those options."""
    try:
        rows = json.loads(_ask(task, options))
        # With --set or --config among the options the task tells the value that they make, under that name.
        return {
            r["key"]: Parameter(r["key"], r.get("default", r.get("value")), r["range"] or "", r["unit"] or "")
            for r in rows
        }
    except (ValueError, KeyError, TypeError, AttributeError):
        raise bad_usage(f"{task} does not tell its parameters as a task does") from None


def check(task: str, options: list[str], key: str, value: str, word: str) -> None:
    """Lets the task itself judge a value, before anything runs. Raises its own words behind `word`, which is where the
    value comes from."""
    try:
        _ask(task, [*options, *settings_as_words({key: value})])
    except CampaignError as refused:
        text = str(refused)
        if f"--set {key}=" not in text:  # it is of another option
            raise
        text = text.removeprefix(f"--set {key}={value}: ")
        text = re.sub(r"([;?.]) [Cc]orrect that --set option$", lambda end: end[1].replace(";", ""), text)
        raise CampaignError(refused.status, refused.code, f"{word}: {text}") from None


def refuse_what_is_no_input(key: str) -> None:
    """Values of a simulation are varied, not which robot, host or file is used."""
    if key.startswith(_NOT_VARIED) or key.endswith(_NOT_VARIED_ENDS):
        raise bad_usage(
            f"'{key}' is no input of a simulation and is not varied" + ("; use --seeds" if key == "seed" else "")
        )


def _ask(task: str, words: list[str]) -> str:
    asked = [find(task), *words, "--parameters", "--json"]
    try:
        answer = subprocess.run(asked, capture_output=True, text=True, errors="replace", check=False, timeout=60)
    except (OSError, subprocess.TimeoutExpired) as failed:
        raise bad_usage(f"{task} does not tell its parameters as a task does: {failed}") from None
    if answer.returncode != 0:
        code, text = last_error(answer.stderr)
        raise CampaignError(2, code or "bad_usage", text or f"{task} did not take {' '.join(words)}")
    return answer.stdout


def last_error(said: str) -> tuple[str, str]:
    """Code and text of the last line `error: CODE: text` on a program's standard error; empty: there is none."""
    for line in reversed(said.splitlines()):
        if line.startswith("error: ") and ": " in line[7:]:
            code, text = line[7:].split(": ", 1)
            return code, text
    return "", ""
