"""What a campaign runs: every run's seed and values, the same whenever it is asked for."""

import re
import warnings
from dataclasses import asdict, dataclass, field

from . import program, vary
from .errors import bad_usage
from .vary import Variation
from .words import typed

METHODS = ("lhs", "sobol")
_MOST_RUNS = 1_000_000
_LARGEST_SEED = 2**63 - 1  # as tasks take them


@dataclass(frozen=True)
class Plan:
    """Everything that decides what is run. A campaign's file keeps it, and the table of runs that follows from it."""

    task: str
    seeds: str
    vary: list[str] = field(default_factory=list)  # as typed
    options: list[str] = field(default_factory=list)  # of the task, for all runs
    method: str = "lhs"
    plan_seed: int = 1
    processes: str = "one"
    timeout_s: float = 600.0  # of the wall clock, for one run
    keep: str = "failed"  # which run folders
    stop_when: float = 0.0  # width of the interval; 0: all runs
    program: str = ""  # fingerprint
    folder: str = ""  # where the options' files are looked for

    def as_dict(self) -> dict:
        """For JSON."""
        return asdict(self)


@dataclass(frozen=True)
class Row:
    """One run of a plan: its number from 0, its seed, its varied values as text."""

    run: int
    seed: int
    settings: dict[str, str]


def seeds_of(text: str) -> list[int]:
    """Seeds FIRST:LAST, both included, or A,B,C."""
    if any(len(digits) > 19 or int(digits) > _LARGEST_SEED for digits in re.findall(r"\d+", text)):
        raise bad_usage(f"--seeds {text}: a seed is at most {_LARGEST_SEED}")
    if ends := re.fullmatch(r"(\d+):(\d+)", text):
        first, last = int(ends[1]), int(ends[2])
        if first > last or last - first >= _MOST_RUNS:
            raise bad_usage(f"--seeds {text}: the first must not be above the last, and there are at most {_MOST_RUNS}")
        return list(range(first, last + 1))
    if not re.fullmatch(r"\d+(,\d+)*", text):
        raise bad_usage(f"--seeds {text}: write FIRST:LAST or A,B,C")
    seeds = [int(word) for word in text.split(",")]
    if len(set(seeds)) != len(seeds):
        raise bad_usage(f"--seeds {text}: a seed is there twice")
    return seeds


def variations(plan: Plan) -> list[Variation]:
    """How values vary, judged by the task itself."""
    known = program.parameters(plan.task, plan.options)
    return distinct([judged(plan, "--vary", text, text, known) for text in plan.vary], plan, "--vary")


def judged(plan: Plan, option: str, text: str, values: str, known: dict[str, program.Parameter]) -> Variation:
    """How the value of an option varies. text: as typed; values: as vary.parse() takes it."""
    told = typed(option, text)
    refuse_unknown(plan, values, known, told)
    variation = vary.parse(values, known, told)
    program.refuse_what_is_no_input(variation.key)
    return variation


def distinct(parsed: list[Variation], plan: Plan, option: str) -> list[Variation]:
    """Refuses a key that has its value twice."""
    keys = [v.key for v in parsed]
    for key in keys:
        if keys.count(key) > 1:
            raise bad_usage(f"{option} names '{key}' twice")
        if key in _set_by(plan.options):
            raise bad_usage(f"{option} and --set behind -- both name '{key}'; leave one out")
    return parsed


def _set_by(options: list[str]) -> set[str]:
    """Keys that a task's options set."""
    values = [word for before, word in zip(["", *options], options, strict=False) if before == "--set"]
    values += [word.removeprefix("--set=") for word in options if word.startswith("--set=")]
    return {word.split("=", 1)[0] for word in values}


def refuse_unknown(plan: Plan, text: str, known: dict[str, program.Parameter], told: str) -> None:
    """Lets the task refuse a key that it does not know: it tells which one comes near."""
    key, _, values = text.partition("=")
    if values and key not in known:
        program.check(plan.task, plan.options, key, "0", told)


def rows(plan: Plan, varied: list[Variation]) -> list[Row]:
    """All runs. Each value's quantiles are those of a Latin hypercube, or of a scrambled Sobol sequence, over all
    runs."""
    seeds = seeds_of(plan.seeds)
    quantiles = _quantiles(plan, len(seeds), len(varied))
    return [
        Row(run, seed, {v.key: v.value(u) for v, u in zip(varied, quantiles[run], strict=True)})
        for run, seed in enumerate(seeds)
    ]


def check_extremes(plan: Plan, planned: list[Row], varied: list[Variation]) -> None:
    """Lets the task judge the smallest and the largest value of every key of the plan, and every word: what is out of
    range is refused before anything runs. Values that do not go together show when they run."""
    for v, text in zip(varied, plan.vary, strict=True):
        values = {row.settings[v.key] for row in planned}
        tried = sorted(values) if v.kind == "choice" else {min(values, key=float), max(values, key=float)}
        for value in tried:
            program.check(plan.task, plan.options, v.key, value, typed("--vary", text))


def _quantiles(plan: Plan, runs: int, dimensions: int):
    if dimensions == 0:
        return [()] * runs
    from scipy.stats import qmc  # slow to import: only who plans needs it

    if plan.method == "sobol":
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a number of runs that is no power of two loses some of the balance
            return qmc.Sobol(dimensions, scramble=True, seed=plan.plan_seed).random(runs).tolist()
    return qmc.LatinHypercube(dimensions, seed=plan.plan_seed).random(runs).tolist()
