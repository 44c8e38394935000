"""The line that repeats a run bit for bit."""

import os
import shlex

from .job import job_of, words_of
from .plan import Plan, Row


def called() -> str:
    """How the program is called here."""
    return os.environ.get("MRROC_CALLED", "./run")


def line_of(plan: Plan, row: Row) -> str:
    """To type where the campaign was begun."""
    return shlex.join([called(), plan.task, *words_of(job_of(plan, row, ""), None)])


def campaign_line(plan: Plan, folder: str = "") -> str:
    """The line that does the whole campaign again, in a folder."""
    words = [called(), "campaign", plan.task, "--seeds", plan.seeds]
    for text in plan.vary:
        words += ["--vary", text]
    usual = Plan(task=plan.task, seeds=plan.seeds)
    for option, value, default in (
        ("--plan", plan.method, usual.method), ("--plan-seed", plan.plan_seed, usual.plan_seed),
        ("--processes", plan.processes, usual.processes), ("--timeout", plan.timeout_s, usual.timeout_s),
        ("--keep", plan.keep, usual.keep), ("--stop-when", plan.stop_when, usual.stop_when),
    ):  # fmt: skip
        if value != default:
            words += [option, str(value)]
    if folder:
        words += ["--dir", folder]
    return shlex.join([*words, *(["--", *plan.options] if plan.options else [])])
