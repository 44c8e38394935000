"""Looks for the values of parameters that make a figure best: Optuna proposes, the campaign's runner tries."""

import re
import shlex
import warnings
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from statistics import fmean

import optuna
from optuna.distributions import BaseDistribution, CategoricalDistribution, FloatDistribution, IntDistribution
from optuna.trial import TrialState

from . import campaign, plan as plans, program, repeat
from .errors import CampaignError, bad_usage
from .job import job_of
from .plan import Plan, Row
from .program import Parameter
from .progress import Progress
from .results import Results, refuse_used
from .runner import Runner
from .vary import Variation
from .words import typed

_LOG = re.compile(r"(?P<key>[^=]+)=log\((?P<low>[^,()]+),(?P<high>[^,()]+)\)$")

_DEFAULT = "default"


@dataclass(frozen=True)
class Search:
    """What is looked for: the figure, whether it is to be large, over which values, in how many trials."""

    figure: str
    largest: bool
    space: dict[str, BaseDistribution]
    trials: int


@dataclass(frozen=True)
class Trial:
    """Values and what came of them. value: mean of the figure over the seeds; None when a run did not come to its
    end."""

    settings: dict[str, str]
    value: float | None
    failed: int


def search_of(plan: Plan, goal: str, over: list[str], trials: int) -> Search:
    """Judges the words of the command line, the ends of every range by the task itself."""
    known = program.parameters(plan.task, plan.options)
    found = [_distribution(plan, text, known) for text in over]
    plans.distinct([variation for variation, _ in found], plan, "--over")
    space = {variation.key: distribution for variation, distribution in found}
    figure = goal.removeprefix("max:")
    return Search(figure, goal.startswith("max:") or figure == "success", space, trials)


def tune(results: Results, search: Search, where: campaign.Where) -> list[Trial]:
    """Tries the default values, then what Optuna's estimator (TPE, Bergstra 2011) proposes, each with all seeds of the
    plan. Runs that are counted already are not carried out again: proposals follow from the seed and from what was
    found, so a search that was ended early goes on as if it had not been."""
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    plan, seeds = results.plan, plans.seeds_of(results.plan.seeds)
    study, trials = _study(plan, search), []
    scratch, done = results.folder / "scratch", results.successes()
    total = search.trials * len(seeds)
    bar = Progress(total, 0, 0)
    try:
        with results.alone(), campaign.emptied(scratch), campaign.runner_on(where, scratch, bar.say) as runner:
            for number in range(search.trials):
                asked = study.ask(search.space)
                settings = {key: _as_text(asked.params[key]) for key in search.space}
                rows = [Row(number * len(seeds) + k, seed, settings) for k, seed in enumerate(seeds)]
                results.plan_more(rows)
                _carry_out(results, search, runner, rows, done, where.scratch(scratch), bar)
                trials.append(_judge(results, search, rows))
                asked.set_user_attr("failed", trials[-1].failed)
                value = trials[-1].value
                study.tell(asked, value, state=TrialState.COMPLETE if value is not None else TrialState.PRUNED)
    finally:
        bar.close()
    return trials


def best_of(trials: list[Trial], search: Search) -> Trial:
    """The fewest failed runs, then the best value."""
    measured = [t for t in trials if t.value is not None]
    if not measured:
        raise CampaignError(
            1, "nothing_found", "no trial came to its end with all seeds; look at the runs that were kept"
        )
    return min(measured, key=lambda t: (t.failed, -t.value if search.largest else t.value))


def lines(results: Results, search: Search, trials: list[Trial]) -> list[str]:
    """What was found, for a terminal, with the lines that try it on seeds that the search has not seen."""
    best, first, plan = best_of(trials, search), trials[0], results.plan
    seeds = plans.seeds_of(plan.seeds)
    told = [f"{len(trials)} trials of {len(seeds)} runs"]
    named = _name_of_first(plan, search, first)
    for name, trial in ((named, first), ("best", best)):
        value = "not measured" if trial.value is None else f"{trial.value:.6g}"
        told.append(
            f"  {name:{max(8, len(named))}} {search.figure} {value}, {trial.failed} of {len(seeds)} runs failed: {shlex.join(f'{k}={v}' for k, v in trial.settings.items())}"
        )
    if named == _DEFAULT and best.settings == first.settings:
        return [*told, "the default is the best that was found: nothing is to be changed"]
    fresh = replace(plan, seeds=f"{max(seeds) + 1}:{max(seeds) + 100}")
    found = replace(fresh, options=[*plan.options, *program.settings_as_words(best.settings)])
    told.append("to see whether it holds for other seeds:")
    told += [f"  {repeat.campaign_line(p, folder)}" for p, folder in ((fresh, "runs/before"), (found, "runs/after"))]
    told.append(f"  {repeat.called()} campaign compare runs/before runs/after")
    return told


def _name_of_first(plan: Plan, search: Search, first: Trial) -> str:
    """What the values that were tried first are: the default ones, or those of the search that come nearest."""
    known = program.parameters(plan.task, plan.options)
    others = [known[key] for key in search.space if not _is_default(known[key], first.settings[key])]
    if not others:
        return _DEFAULT
    if len(search.space) == 1:
        return f"nearest to the default ({others[0].default})"
    return f"nearest to the default ({', '.join(f'{p.key}={p.default}' for p in others)})"


def _is_default(parameter: Parameter, value: str) -> bool:
    if parameter.kind in ("number", "integer"):
        return float(value) == float(parameter.default)
    return value.strip('"') == parameter.default.strip('"')


def begin(plan: Plan, search: Search, folder: Path, resume: bool) -> Results:
    """The file of a new search, or of one that goes on."""
    asked = {"figure": search.figure, "largest": search.largest, "space": {k: repr(d) for k, d in search.space.items()}}
    if resume:
        results = campaign.take_up(folder)
        if results.note("search") != asked or replace(results.plan, folder=plan.folder) != plan:
            raise bad_usage(f"{folder} is another search; type the line that began it, with --resume")
        return results
    refuse_used(folder, "--resume")
    results = Results.create(folder, plan, [], list(search.space))
    results.keep_note("search", asked)
    return results


def _study(plan: Plan, search: Search) -> optuna.Study:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # constraints are told to be new
        sampler = optuna.samplers.TPESampler(
            seed=plan.plan_seed, constraints_func=lambda trial: (trial.user_attrs.get("failed", 0),)
        )
    study = optuna.create_study(direction="maximize" if search.largest else "minimize", sampler=sampler)
    known = program.parameters(plan.task, plan.options)
    study.enqueue_trial({key: _default(known[key], search.space[key]) for key in search.space})
    return study


def _carry_out(
    results: Results, search: Search, runner: Runner, rows: list[Row], done: dict[int, bool], scratch: str, bar: Progress
) -> None:
    by_run = {row.run: row for row in rows}
    for row in rows:
        if row.run in done:
            bar.count(done[row.run])

    def take(result: dict) -> bool:
        if results.add(by_run[result["run"]], result):
            bar.count(result["success"])
        if result["outcome"] == "done":
            _refuse_unknown(search.figure, results.figures())
        return True

    todo = [job_of(results.plan, row, scratch) for row in rows if row.run not in done]
    runner.run(todo, take)  # a lost run has failed, and its trial is not measured


def _refuse_unknown(figure: str, known: list[str]) -> None:
    """After a run that came to its end, and has all figures."""
    if figure in ("success", *known):
        return
    near = get_close_matches(figure, known, 1)
    told = f"did you mean '{near[0]}'? There" if near else "there"
    raise bad_usage(f"there is no figure '{figure}'; {told} are {', '.join(known) or 'none'}")


def _judge(results: Results, search: Search, rows: list[Row]) -> Trial:
    runs = results.counted_among(row.run for row in rows)
    failed = sum(not r["success"] for r in runs)
    values = [r.get(search.figure) for r in runs if search.figure == "success" or r["outcome"] == "done"]
    whole = len(values) == len(rows) and all(v is not None for v in values)
    return Trial(rows[0].settings, fmean(values) if whole else None, failed)


def _distribution(plan: Plan, text: str, known: dict[str, Parameter]) -> tuple[Variation, BaseDistribution]:
    told, log = typed("--over", text), _LOG.match(text)
    values = f"{log['key']}={log['low']}:{log['high']}" if log else text
    if not log and "=" in text and text.split("=", 1)[1].startswith(("log(", "normal(")):
        raise bad_usage(f"{told}: a search takes LOW:HIGH, log(LOW,HIGH) or A,B,C")
    variation = plans.judged(plan, "--over", text, values, known)
    for value in variation.words or [variation.value(0.0), variation.value(1 - 1e-12)]:
        program.check(plan.task, plan.options, variation.key, value, told)
    if variation.kind == "choice":
        return variation, CategoricalDistribution(variation.words)
    low, high = variation.numbers
    if log and low <= 0:
        raise bad_usage(f"{told}: logarithms need values above 0")
    kind = IntDistribution if variation.integer else FloatDistribution
    return variation, kind(
        int(low) if variation.integer else low, int(high) if variation.integer else high, log=bool(log)
    )


def _default(parameter: Parameter, distribution: BaseDistribution):
    """The default value, or the nearest one of the search."""
    if isinstance(distribution, CategoricalDistribution):
        return next((word for word in distribution.choices if _is_default(parameter, word)), distribution.choices[0])
    x = min(max(float(parameter.default), distribution.low), distribution.high)
    return int(x) if isinstance(distribution, IntDistribution) else x


def _as_text(value) -> str:
    return repr(value) if isinstance(value, (int, float)) else str(value)
