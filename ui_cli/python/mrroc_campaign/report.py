"""What a campaign tells at its end."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

from .intervals import ALPHA, Sequence, clopper_pearson, confidence_sequence
from .plan import Plan
from .results import WORKER_LOST, Results, writing

PAGE = "page.html"


@dataclass(frozen=True)
class Rate:
    """The success rate, and that of every fault, of the same runs: with --stop-when of the beginning of the plan that has
    ended without a gap, otherwise of all that are counted."""

    rows: list[dict]  # of the table `runs`
    successes: int
    low: float  # ends of the interval
    high: float
    at_all_times: bool  # the interval bears looking at it after every run, for that decided when to stop
    later: int  # runs that have ended too, behind a gap

    @property
    def runs(self) -> int:
        """How many runs count; 0: there is no rate yet."""
        return len(self.rows)

    @property
    def share(self) -> float:
        """Successes of runs."""
        return self.successes / self.runs if self.runs else 0.0

    def faults(self) -> list[tuple[str, int]]:
        """Codes and how many runs ended so, the most frequent first."""
        return Counter(r["fault"] for r in self.rows if r["fault"]).most_common()

    def lost(self) -> int:
        """Runs whose workers died again and again."""
        return sum(r["fault"] == WORKER_LOST for r in self.rows)

    def interval(self, number: int) -> tuple[float, float]:
        """For the share of a number of these runs."""
        return (confidence_sequence if self.at_all_times else clopper_pearson)(number, self.runs)


def rate(plan: Plan, counted: list[dict]) -> Rate:
    """The success rate of a campaign whose table is `counted`, in the order of the plan."""
    if not plan.stop_when:
        successes = sum(r["success"] for r in counted)
        ends = clopper_pearson(successes, len(counted)) if counted else (0.0, 1.0)
        return Rate(counted, successes, *ends, False, 0)
    sequence = Sequence({r["run"]: bool(r["success"]) for r in counted})
    rows = counted[: sequence.runs]
    return Rate(rows, sequence.successes, *sequence.interval(), True, len(counted) - len(rows))


def lines(results: Results) -> list[str]:
    """The success rate and the faults, for a terminal."""
    found, planned = rate(results.plan, results.counted()), len(results.planned())
    enough = found.at_all_times and found.runs < planned and found.high - found.low <= results.plan.stop_when
    told = [f"{found.runs} of {planned} runs" + (", enough for --stop-when" if enough else "")]
    if found.later:
        told[0] += f"; {found.later} behind them have ended too and do not count, since one before them has not"
    if not found.runs:
        return [*told, "success: not known yet"]
    told.append(
        f"success: {found.successes} of {found.runs}, {100 * found.share:.1f} % ({100 * found.low:.1f} to {100 * found.high:.1f} % at {100 * (1 - ALPHA):.0f} %)"
    )
    return told + [f"  {count:5} {fault}" for fault, count in found.faults()]


def write_page(results: Results) -> None:
    """The page of the campaign, in its folder."""
    from . import page

    new = results.folder / (PAGE + ".new")
    text = page.of(results).encode(errors="backslashreplace")
    with writing(results.folder):
        new.write_bytes(text)
        new.replace(Path(results.folder / PAGE))
