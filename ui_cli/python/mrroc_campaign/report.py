"""What a campaign tells at its end."""

from collections import Counter
from pathlib import Path

from .intervals import ALPHA, Sequence, clopper_pearson
from .results import Results, writing

PAGE = "page.html"


def rate(results: Results) -> tuple[int, int, float, float]:
    """Successes, runs, and the interval of the success rate: one that bears looking at it all the time, where that
    decided when to stop (of runs in the order of the plan), otherwise the exact one."""
    ended = results.successes()
    if results.plan.stop_when:
        sequence = Sequence(ended)
        return sequence.successes, sequence.runs, *sequence.interval()
    successes = sum(ended.values())
    return successes, len(ended), *clopper_pearson(successes, len(ended))


def lines(results: Results) -> list[str]:
    """The success rate and the faults, for a terminal."""
    successes, runs, low, high = rate(results)
    planned = len(results.planned())
    told = [
        f"{runs} of {planned} runs" + (", enough for --stop-when" if runs < planned and results.plan.stop_when else "")
    ]
    share = 100 * successes / runs if runs else 0.0
    told.append(
        f"success: {successes} of {runs}, {share:.1f} % ({100 * low:.1f} to {100 * high:.1f} % at {100 * (1 - ALPHA):.0f} %)"
    )
    faults = Counter(r["fault"] for r in results.counted() if r["fault"])
    told += [f"  {count:5} {fault}" for fault, count in faults.most_common()]
    return told


def write_page(results: Results) -> None:
    """The page of the campaign, in its folder."""
    from . import page

    new = results.folder / (PAGE + ".new")
    with writing(results.folder):
        new.write_text(page.of(results))
        new.replace(Path(results.folder / PAGE))
