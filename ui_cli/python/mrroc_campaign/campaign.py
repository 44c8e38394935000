"""A campaign: a plan is made or taken up again, its runs are carried out and counted, and it ends when it may."""

import shutil
from collections.abc import Callable
from contextlib import closing, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from distributed import Client

from . import hosts, keys, plan as plans, program
from .errors import bad_usage
from .intervals import Sequence
from .job import job_of
from .plan import Plan
from .progress import Progress
from .results import Results, refuse_used, writing
from .runner import Runner


@dataclass(frozen=True)
class Where:
    """Where runs are carried out: on this machine (on: local) by some workers, or by those of a scheduler,
    tcp://HOST:PORT or, with its key, tls://HOST:PORT."""

    on: str
    workers: int
    key: Path | None = None

    @property
    def local(self) -> bool:
        """Whether workers see our files."""
        return self.on == "local"

    def scratch(self, folder: Path) -> str:
        """The folder for runs, as job_of() takes it."""
        return str(folder.resolve()) if self.local else ""


def begin(plan: Plan, folder: Path) -> Results:
    """Judges a plan and makes the campaign's file. Nothing runs before all of it has been judged."""
    varied = plans.variations(plan)
    planned = plans.rows(plan, varied)
    plans.check_extremes(plan, planned, varied)
    refuse_used(folder, f"--resume {folder}")
    return Results.create(folder, plan, planned, [v.key for v in varied])


def take_up(folder: Path) -> Results:
    """The campaign in a folder, to go on with it."""
    results = Results(folder)
    plan = results.plan
    if not plan.program.startswith(program.DIGESTS):
        raise bad_usage(
            f"{folder} began with a version that looked at the program {plan.task} alone, not at all that its runs start; begin anew"
        )
    if program.digest(plan.task, plan.processes) != plan.program:
        raise bad_usage(
            f"the program {plan.task}, or one that it starts, has changed since {folder} began: runs of two builds are not counted together; begin anew"
        )
    return results


@contextmanager
def runner_on(where: Where, scratch: Path, told: Callable[[str], None]):
    """Yields a Runner. told: takes lines for a person."""
    if where.local:
        with hosts.local_cluster(where.workers, scratch) as cluster:
            with closing(Runner(lambda: Client(cluster, set_as_default=False), told)) as runner:
                yield runner
    else:
        hosts.configure()
        security = keys.read(where.key)
        with closing(
            Runner(lambda: Client(where.on, timeout=10, set_as_default=False, security=security), told)
        ) as runner:
            yield runner


def carry_out(results: Results, where: Where) -> list[int]:
    """Runs what is not counted yet, and once more what was lost. Returns the numbers of runs that were lost."""
    plan, done = results.plan, results.successes()
    if Sequence(done).narrower_than(plan.stop_when):
        return []
    for run in results.lost():
        del done[run]
    rows = {row.run: row for row in results.planned()}
    todo = [row for row in rows.values() if row.run not in done]
    sequence = Sequence(done)
    if not todo:
        return []
    scratch = results.folder / "scratch"
    with results.alone(), emptied(scratch), _progress(len(rows), done) as bar:

        def take(result: dict) -> bool:
            if results.add(rows[result["run"]], result):
                sequence.add(result["run"], result["success"])
                bar.count(result["success"])
            return not sequence.narrower_than(plan.stop_when)

        with runner_on(replace(where, workers=min(where.workers, len(todo))), scratch, bar.say) as runner:
            return runner.run((job_of(plan, row, where.scratch(scratch)) for row in todo), take)


@contextmanager
def _progress(total: int, done: dict[int, bool]):
    bar = Progress(total, len(done), sum(not success for success in done.values()))
    try:
        yield bar
    finally:
        bar.close()


@contextmanager
def emptied(scratch: Path):
    """A folder for what runs; what is left in it is of runs that were not counted."""
    shutil.rmtree(scratch, ignore_errors=True)
    with writing(scratch.parent):
        scratch.mkdir()
    try:
        yield
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
