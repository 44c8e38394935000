"""Tests of pairs: the same run under A and under B."""

from dataclasses import dataclass
from math import nan

import numpy as np

_MOST_FOR_ALL_MEANS = 3000  # pairs; their means of two are some millions


@dataclass(frozen=True)
class Successes:
    """How pairs ended. p: McNemar's exact test that A and B succeed equally often."""

    both: int
    only_a: int
    only_b: int
    neither: int
    p: float


@dataclass(frozen=True)
class Shift:
    """How much larger a figure is under B. difference: the Hodges-Lehmann estimate, the median of the means of every
    two differences; low, high: its interval at 95 %; p: Wilcoxon's signed-rank test that there is no shift, corrected
    for the number of figures (Holm)."""

    figure: str
    pairs: int
    median_a: float
    median_b: float
    difference: float
    low: float
    high: float
    p: float


def mcnemar(pairs: list[tuple[bool, bool]]) -> Successes:
    """Only pairs that end differently tell anything: under equal rates either way is a coin's toss (McNemar 1947)."""
    from scipy.stats import binomtest

    count = {k: pairs.count(k) for k in ((True, True), (True, False), (False, True), (False, False))}
    only_a, only_b = count[True, False], count[False, True]
    p = binomtest(only_a, only_a + only_b).pvalue if only_a + only_b else 1.0
    return Successes(count[True, True], only_a, only_b, count[False, False], float(p))


def wilcoxon(figure: str, a: list[float], b: list[float]) -> Shift:
    """The shift of one figure; p is not corrected yet."""
    from scipy.stats import norm, wilcoxon as signed_ranks

    x, y = np.asarray(a, float), np.asarray(b, float)
    d = y - x
    n = len(d)
    if n == 0:
        return Shift(figure, 0, nan, nan, nan, nan, nan, 1.0)
    p = float(signed_ranks(d, method="auto").pvalue) if np.any(d) else 1.0
    sample = (
        d if n <= _MOST_FOR_ALL_MEANS else np.quantile(d, (np.arange(_MOST_FOR_ALL_MEANS) + 0.5) / _MOST_FOR_ALL_MEANS)
    )
    i, j = np.triu_indices(len(sample))
    means = np.sort((sample[i] + sample[j]) / 2)
    # Ends by the normal approximation of the signed-rank statistic (Hollander, Wolfe 1999, 3.3), as a share of the means.
    total, scale = n * (n + 1) / 2, (n * (n + 1) * (2 * n + 1) / 24) ** 0.5
    below = max(0.0, (total / 2 - norm.ppf(0.975) * scale) / total)
    at = min(int(below * len(means)), len(means) - 1)
    return Shift(
        figure,
        n,
        float(np.median(x)),
        float(np.median(y)),
        float(np.median(means)),
        float(means[at]),
        float(means[len(means) - 1 - at]),
        p,
    )


def holm(p: list[float]) -> list[float]:
    """Corrected for their number: the smallest times n, the next times n - 1, and none below one before it (Holm
    1979)."""
    corrected, worst = [0.0] * len(p), 0.0
    for k, at in enumerate(np.argsort(p)):
        worst = max(worst, min(1.0, p[at] * (len(p) - k)))
        corrected[at] = worst
    return corrected
