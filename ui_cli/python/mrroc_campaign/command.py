"""The words of the command line."""

import argparse
import shlex
import signal
import sys
from datetime import datetime
from pathlib import Path

from . import program, repeat
from .errors import CampaignError, bad_usage
from .line import CALLED, Line, Once, above_zero, width
from .plan import METHODS, Plan
from .words import apart

_HELP = """Runs a task many times, with seeds and values of a plan, and tells how often it succeeds and what failures depend on.

  {called} TASK --seeds 1:1000 [--vary KEY=VALUES]...   runs a campaign
  {called} TASK --seeds 1:1000 @FILE                    the same, with --vary and other words from a file: tasks/TASK/plants.txt
  {called} --resume DIR                                 goes on with one that was ended early
  {called} compare A B                                  two campaigns, paired by seed
  {called} tune TASK --for KEY --over KEY=VALUES...     looks for the values that make a figure best
  {called} page DIR                                     makes the page of a campaign anew
  {called} scheduler | worker tcp://HOST:PORT           for campaigns on several hosts; they listen on 127.0.0.1 unless told otherwise

Each command has --help. Words behind -- are options of the task: {called} press --seeds 1:9 -- --max-time 20
"""


_GIVEN = {
    "--seed", "--run-dir", "--processes", "--view", "--attended", "--clock", "--strict", "--session",
}  # fmt: skip
_NO_RUN = {"-h", "--help", "--parameters", "--truth", "--json", "--check"}


def main(words: list[str]) -> int:
    """Obeys a command line. Returns the exit status: 0 done, 1 not all was carried out, 2 bad usage, 3 the machine
    failed."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    commands = {"compare": _compare, "tune": _tune, "page": _page, "scheduler": _scheduler, "worker": _worker}
    if not words or words[0] in ("-h", "--help", "help"):
        print(_HELP.format(called=CALLED), end="")
        return 0
    try:
        if words[0] in commands:
            return commands[words[0]](words[1:])
        if words[0][0:1] not in ("-", "@") and not {"-h", "--help"} & set(words):
            program.find(words[0], commands)
        return _run(words)
    except CampaignError as failed:
        sys.stdout.flush()
        print(f"error: {failed.code}: {failed}", file=sys.stderr)
        return failed.status
    except ModuleNotFoundError as missing:
        packages = "python3-distributed python3-scipy python3-tqdm python3-optuna"
        print(
            f"error: missing_packages: there is no Python module {missing.name}; type: apt-get install {packages}",
            file=sys.stderr,
        )
        return 2
    except KeyboardInterrupt:
        return 130


def _add_where(line: argparse.ArgumentParser) -> None:
    line.add_argument(
        "--on",
        default="local",
        metavar="local|tcp://HOST:PORT",
        help="this machine (default), or a scheduler's workers",
    )
    line.add_argument("--workers", type=above_zero, metavar="N", help="on this machine (default: one a core)")
    _add_key(line)


def _add_key(line: argparse.ArgumentParser) -> None:
    line.add_argument(
        "--key-file", type=Path, metavar="FILE", help="the key of a scheduler tls://HOST:PORT, which makes the file"
    )


def _add_runs(line: argparse.ArgumentParser) -> None:
    line.add_argument(
        "--plan", choices=METHODS, default="lhs", help="Latin hypercube (default), or a scrambled Sobol sequence"
    )
    line.add_argument("--plan-seed", type=int, default=1, metavar="N", help="of the plan (default 1)")
    line.add_argument("--processes", choices=("one", "separate"), default="one", help="of each run (default: one)")
    line.add_argument(
        "--timeout", type=float, default=600.0, metavar="S", help="longest run, by the wall clock (default 600)"
    )
    line.add_argument(
        "--keep", choices=("failed", "all", "none"), default="failed", help="which run folders (default: failed)"
    )
    line.add_argument("--dir", type=Path, metavar="DIR", help="the campaign's folder (default runs/campaign-TASK-TIME)")


def _run(words: list[str]) -> int:
    words, options = apart(words)
    line = Line("", "Runs a task with all seeds; words behind -- are options of the task.", files=True)
    line.add_argument("task", nargs="?", help="a task, such as press")
    line.add_argument("--seeds", action=Once, metavar="FIRST:LAST", help="one run for each, also A,B,C")
    line.add_argument(
        "--vary",
        action="append",
        default=[],
        metavar="KEY=VALUES",
        help="LOW:HIGH, normal(M,S) or A,B,C; may be repeated; keys: TASK --parameters",
    )
    line.add_argument(
        "--stop-when",
        type=width,
        default=0.0,
        metavar="WIDTH",
        help="end when the success rate's interval is that narrow, such as 0.1",
    )
    line.add_argument(
        "--resume",
        type=Path,
        metavar="DIR",
        help="go on with the campaign of that folder",
    )
    _add_where(line)
    _add_runs(line)
    chosen = line.parse_args(words)
    if chosen.resume:
        return _carry_out(_taken_up(chosen, options), chosen, _where(chosen))
    if not chosen.task or not chosen.seeds:
        raise bad_usage(f"name a task and its seeds: {CALLED} press --seeds 1:100")
    plan = _plan_of(chosen, options, chosen.seeds, chosen.vary, chosen.stop_when)
    where = _where(chosen)
    from . import campaign

    return _carry_out(campaign.begin(plan, _folder_of(chosen, "campaign")), chosen, where)


def _taken_up(chosen: argparse.Namespace, options: list[str]):
    """The campaign that goes on. What is typed beside its folder must be what it began with."""
    from . import campaign

    if chosen.dir:
        raise bad_usage("--resume and --dir name two folders")
    results = campaign.take_up(chosen.resume)
    plan, usual = results.plan, Plan("", "")
    if results.note("search"):
        raise bad_usage(
            f"{chosen.resume} is a search, whose runs are no campaign: {CALLED} tune goes on with it, by the line that began it and --dir {chosen.resume} --resume"
        )
    for given, begun, default in (
        (chosen.task, plan.task, None),
        (chosen.seeds, plan.seeds, None),
        (chosen.vary, plan.vary, []),
        (options, plan.options, []),
        (chosen.plan, plan.method, usual.method),
        (chosen.plan_seed, plan.plan_seed, usual.plan_seed),
        (chosen.processes, plan.processes, usual.processes),
        (chosen.timeout, plan.timeout_s, usual.timeout_s),
        (chosen.keep, plan.keep, usual.keep),
        (chosen.stop_when, plan.stop_when, usual.stop_when),
    ):
        if given not in (default, begun):
            raise bad_usage(
                f"{chosen.resume} began as: {repeat.campaign_line(plan)}; {CALLED} --resume {chosen.resume} goes on"
            )
    return results


def _plan_of(
    chosen: argparse.Namespace, options: list[str], seeds: str, varied: list[str], stop_when: float = 0.0
) -> Plan:
    _refuse_options(chosen.task, {word.split("=", 1)[0] for word in options})
    if not chosen.timeout > 0:
        raise bad_usage("--timeout must be above 0")
    return Plan(
        task=chosen.task, seeds=seeds, vary=varied, options=options, method=chosen.plan, plan_seed=chosen.plan_seed,
        processes=chosen.processes, timeout_s=chosen.timeout, keep=chosen.keep, stop_when=stop_when,
        program=program.digest(chosen.task, chosen.processes), folder=str(Path.cwd()),
    )  # fmt: skip


def _refuse_options(task: str, given: set[str]) -> None:
    """What behind -- makes no run, or is the campaign's to say."""
    if taken := given & _GIVEN:
        raise bad_usage(f"{sorted(taken)[0]} is given to each run by the campaign, or does not suit one")
    if taken := given & _NO_RUN:
        raise bad_usage(f"{sorted(taken)[0]} makes no run; type: {repeat.called()} {task} {sorted(taken)[0]}")
    needed = program.WAIT_FOR_A_PERSON.get(task)
    if needed and needed not in given:
        raise bad_usage(f"{task} waits for a person, whom a campaign has not; give it a script: -- {needed} FILE")


def _folder_of(chosen: argparse.Namespace, kind: str) -> Path:
    return chosen.dir or Path("runs") / f"{kind}-{chosen.task}-{datetime.now():%Y-%m-%dT%H-%M-%S}"


def _where(chosen: argparse.Namespace):
    from .campaign import Where

    if chosen.on != "local" and not chosen.on.startswith("tls://" if chosen.key_file else "tcp://"):
        raise bad_usage(f"--on {chosen.on}: write local, tcp://HOST:PORT, or with --key-file tls://HOST:PORT")
    return Where(chosen.on, _workers_of(chosen), chosen.key_file)


def _workers_of(chosen: argparse.Namespace) -> int:
    from . import hosts

    return chosen.workers or len(hosts.cores())


def _carry_out(results, chosen: argparse.Namespace, where) -> int:
    from . import campaign, report

    again = f"{CALLED} --resume {shlex.quote(str(results.folder))}" + (
        f" --on {chosen.on}" if chosen.on != "local" else ""
    )
    again += f" --key-file {shlex.quote(str(chosen.key_file))}" if chosen.key_file else ""
    try:
        lost = campaign.carry_out(results, where)
    except (CampaignError, KeyboardInterrupt) as ended:
        print(f"{len(results.successes())} runs are counted; to go on: {again}", file=sys.stderr)
        if isinstance(ended, CampaignError):
            raise
        print("error: interrupted: the campaign was ended early", file=sys.stderr)
        return 130
    for text in report.lines(results):
        print(text)
    report.write_page(results)
    print(f"page: {results.folder / report.PAGE}\ncampaign: {results.folder}")
    if lost:
        raise CampaignError(
            1,
            "runs_lost",
            f"{len(lost)} runs killed their workers again and again, the first is {lost[0]}; they count as failures; to try them once more: {again}",
        )
    return 0


def _page(words: list[str]) -> int:
    line = Line(" page", "Makes the page of a campaign anew, also while it runs.")
    line.add_argument("folder", type=Path)
    folder = line.parse_args(words).folder
    from . import report
    from .results import Results

    results = Results(folder)
    report.write_page(results)
    print(f"page: {results.folder / report.PAGE}")
    return 0


def _compare(words: list[str]) -> int:
    line = Line(
        " compare",
        "Two campaigns of one plan, paired by seed: McNemar's exact test for success, Wilcoxon's signed ranks for figures.",
    )
    line.add_argument("a", type=Path)
    line.add_argument("b", type=Path)
    line.add_argument("--json", action="store_true", help="one document instead of the table")
    chosen = line.parse_args(words)
    from . import compare
    from .results import Results

    found = compare.compare(Results(chosen.a), Results(chosen.b))
    print(found.as_json() if chosen.json else found.as_text())
    return 0


def _tune(words: list[str]) -> int:
    words, options = apart(words)
    line = Line(
        " tune",
        "Looks for the values that make a figure best (Optuna); words behind -- are options of the task.",
        files=True,
    )
    line.add_argument("task", help="a task, such as press")
    line.add_argument(
        "--for",
        dest="goal",
        required=True,
        metavar="KEY",
        help="figure that is to be small; max:KEY: large; its mean over the seeds",
    )
    line.add_argument(
        "--over",
        action="append",
        required=True,
        metavar="KEY=VALUES",
        help="LOW:HIGH, log(LOW,HIGH) or A,B,C; may be repeated",
    )
    line.add_argument("--seeds", action=Once, default="1:5", metavar="FIRST:LAST", help="of each trial (default 1:5)")
    line.add_argument("--trials", type=above_zero, default=40, metavar="N", help="sets of values that are tried (default 40)")
    line.add_argument("--resume", action="store_true", help="go on with the search in --dir")
    _add_where(line)
    _add_runs(line)
    chosen = line.parse_args(words)
    from . import tune

    if chosen.resume and not chosen.dir:
        raise bad_usage("--resume goes on in the folder that --dir names")
    plan = _plan_of(chosen, options, chosen.seeds, [])
    where = _where(chosen)
    search = tune.search_of(plan, chosen.goal, chosen.over, chosen.trials)
    results = tune.begin(plan, search, _folder_of(chosen, "tune"), chosen.resume)
    try:
        trials = tune.tune(results, search, where)
    except (CampaignError, KeyboardInterrupt) as ended:
        if isinstance(ended, CampaignError) and ended.status == 2:
            raise
        print(f"what was tried is kept; to go on: the same line with --dir {results.folder} --resume", file=sys.stderr)
        raise
    for text in tune.lines(results, search, trials):
        print(text)
    print(f"search: {results.folder}")
    return 0


def _scheduler(words: list[str]) -> int:
    line = Line(
        " scheduler",
        "Dask's scheduler, until Ctrl-C. Without --key-file whoever reaches its port can run anything as you.",
    )
    line.add_argument("--listen", default="127.0.0.1", metavar="HOST", help="address of this host (default 127.0.0.1)")
    line.add_argument("--port", type=int, default=8786)
    _add_key(line)
    chosen = line.parse_args(words)
    if not 0 <= chosen.port < 65536:
        raise bad_usage("--port takes a number from 0 to 65535")
    from . import hosts

    hosts.serve_scheduler(chosen.listen, chosen.port, chosen.key_file)
    return 0


def _worker(words: list[str]) -> int:
    line = Line(
        " worker", "Workers of this host for a scheduler, one a core, until Ctrl-C. Programs are those of this host."
    )
    line.add_argument("scheduler", metavar="tcp://HOST:PORT", help="or, with its key, tls://HOST:PORT")
    _add_key(line)
    line.add_argument("--listen", default="127.0.0.1", metavar="HOST", help="address of this host (default 127.0.0.1)")
    line.add_argument("--workers", type=above_zero, metavar="N", help="(default: one a core)")
    line.add_argument("--folder", type=Path, default=None, help=argparse.SUPPRESS)
    line.add_argument(
        "--single", action="store_true", help=argparse.SUPPRESS
    )  # one process of those that the others keep
    chosen = line.parse_args(words)
    from tempfile import TemporaryDirectory

    from . import hosts

    if chosen.single:
        hosts.serve_one(chosen.scheduler, chosen.folder, chosen.listen, chosen.key_file)
        return 0
    hosts.await_scheduler(chosen.scheduler, lambda text: print(text, flush=True))
    with TemporaryDirectory(prefix="mrroc-worker-") as folder:
        workers = hosts.Workers(chosen.scheduler, _workers_of(chosen), Path(folder), chosen.listen, chosen.key_file)
        try:
            workers.wait()
        except KeyboardInterrupt:
            return 0
        finally:
            workers.end()
    return 0
