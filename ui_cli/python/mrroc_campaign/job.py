"""One run, as a worker carries it out: a process in a session and a folder of its own. Imports little, for workers
start often."""

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import tarfile
import tempfile
import time
import uuid
from io import BytesIO
from pathlib import Path

from . import program
from .errors import CampaignError, HostFailed
from .plan import Plan, Row
from .unpack import LARGEST_MB

# Faults of the machine, which say nothing of the run: a full disk, no multicast, nothing of the like.
_OF_THE_HOST = ("cannot_write", "no_multicast")
_END_OF_OUTPUT = 100_000  # bytes in which the last error is looked for
_LARGEST_SUMMARY = 10_000_000  # bytes
_NO_PICTURES = "--no-pictures"
_LONGEST_DRAWING = 60  # s, of one picture


def job_of(plan: Plan, row: Row, scratch: str) -> dict:
    """What a worker needs to know of a run. scratch: the folder for runs, which the worker sees as we do; empty: it
    takes one of its own."""
    return {
        "task": plan.task, "program": plan.program, "options": plan.options, "processes": plan.processes, "keep": plan.keep,
        "timeout_s": plan.timeout_s, "folder": plan.folder, "scratch": scratch, "run": row.run, "seed": row.seed, "settings": row.settings,
    }  # fmt: skip


def execute(job: dict) -> dict:
    """Runs a job and tells how it ended. job: what job_of() makes of a row. Raises HostFailed when it is not the
    run that has failed, which is then not counted."""
    try:
        place = Path(job["scratch"] or tempfile.gettempdir()) / f"{job['run']:06d}-{uuid.uuid4().hex[:8]}"
        place.mkdir(parents=True)
        try:
            return _execute(job, place)
        except BaseException:
            shutil.rmtree(place, ignore_errors=True)
            raise
    except (OSError, CampaignError) as failed:
        raise HostFailed(f"{socket.gethostname()}: {failed}") from None


def words_of(job: dict, run_folder: Path | None) -> list[str]:
    """The task's options, which repeat the run bit for bit."""
    words = ["--seed", str(job["seed"]), "--processes", job["processes"], "--strict", *job["options"]]
    words += program.settings_as_words(job["settings"])
    if run_folder is None:
        return words
    pictures = [] if _NO_PICTURES in job["options"] else [_NO_PICTURES]  # those of runs that are kept are drawn later
    return [*words, *pictures, "--run-dir", str(run_folder)]


def _execute(job: dict, place: Path) -> dict:
    path = program.find(job["task"])
    if program.digest(job["task"], job["processes"]) != job["program"]:
        raise HostFailed(
            f"{socket.gethostname()}: {path}, or a program that it starts, is of another build than that of this campaign"
        )
    folder, began = place / "run", time.monotonic()
    status, output = _run([str(path), *words_of(job, folder)], job, place)
    result = _judge(status, output, folder)
    result |= {"run": job["run"], "wall_s": round(time.monotonic() - began, 4), "host": socket.gethostname()}
    if result["fault"] in _OF_THE_HOST and status == 3:
        raise HostFailed(f"{socket.gethostname()}: {result['fault']}: {result['text']}")
    if job["keep"] == "all" or (job["keep"] == "failed" and not result["success"]):
        if _NO_PICTURES not in job["options"]:
            _draw(folder)
        result |= _kept(place, shared=bool(job["scratch"]))
    else:
        shutil.rmtree(place, ignore_errors=True)
    return result


def _run(words: list[str], job: dict, place: Path) -> tuple[int | None, str]:
    """Exit status (None: out of time) and what the process said at its end, its standard error last."""
    # The kernel ends the process when this worker is killed; the group goes with a run that is out of time.
    guarded = ["setpriv", "--pdeathsig", "KILL", *words]
    where = job["folder"] if Path(job["folder"]).is_dir() else place
    with (place / "output.txt").open("wb+") as out, (place / "errors.txt").open("wb+") as err:
        with subprocess.Popen(
            guarded, stdin=subprocess.DEVNULL, stdout=out, stderr=err, cwd=where, start_new_session=True
        ) as process:
            try:
                status = process.wait(job["timeout_s"])
            except subprocess.TimeoutExpired:
                status = None
            finally:
                with contextlib.suppress(ProcessLookupError, PermissionError):
                    os.killpg(process.pid, signal.SIGKILL)
        return status, _end_of(out) + "\n" + _end_of(err)


def _draw(folder: Path) -> None:
    """The pictures whose scripts the run has left, as it would have drawn them itself; without gnuplot none."""
    for script in sorted(folder.glob("plots/*.gp")):
        with contextlib.suppress(OSError, subprocess.TimeoutExpired):
            subprocess.run(
                ["gnuplot", f"plots/{script.name}"],
                cwd=folder,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                timeout=_LONGEST_DRAWING,
                check=False,
            )


def _end_of(said) -> str:
    said.seek(max(0, said.seek(0, os.SEEK_END) - _END_OF_OUTPUT))
    return said.read().decode(errors="replace")


def _summary(file: Path) -> dict:
    """What a run says of itself; empty: nothing that can be read."""
    try:
        with file.open("rb") as stored:
            summary = json.loads(stored.read(_LARGEST_SUMMARY))
    except (OSError, ValueError, RecursionError):
        return {}
    return summary if isinstance(summary, dict) else {}


def _judge(status: int | None, output: str, folder: Path) -> dict:
    """Nothing but exit status 0 and a summary that says `done` is a success."""
    summary = _summary(folder / "summary.json")
    success = status == 0 and summary.get("outcome") == "done"
    code, text = program.last_error(output)
    if status is None:
        code, text = "wall_time", "the run was ended, since it took longer than --timeout"
    elif status < 0:
        code, text = f"signal_{-status}", "the program was ended by a signal"
    elif status > 0 and not code:
        code, text = f"status_{status}", "the program told no reason"
    elif status == 0 and not success:
        code, text = "no_summary", "the exit status is 0, but summary.json is missing, damaged, or does not say done"
    return {
        "success": success,
        "outcome": summary.get("outcome", "none"),
        "fault": "" if success else code,
        "text": "" if success else text,
        "exit_status": status,
        "log_hash": summary.get("log_hash", ""),
        "sim_s": summary.get("sim_s"),
        "figures": summary.get("figures", {}),
        "bars": summary.get("wanted", {}),
    }


def _kept(place: Path, shared: bool) -> dict:
    """The run's folder: its path, where the one who asked sees it too, otherwise all of it."""
    if shared:
        return {"folder": str(place)}
    size = sum(f.stat().st_size for f in place.rglob("*") if f.is_file())
    if size > LARGEST_MB * 1_000_000:
        return {"left_at": f"{socket.gethostname()}:{place}"}
    packed = BytesIO()
    with tarfile.open(fileobj=packed, mode="w:gz", compresslevel=1) as archive:
        archive.add(place, arcname=".")
    shutil.rmtree(place, ignore_errors=True)
    return {"packed": packed.getvalue()}
