"""Tests of pairs: the same run under A and under B."""

import warnings
from dataclasses import dataclass
from math import nan

import numpy as np

_MOST_EXACT = 60  # pairs; of more the normal approximation is good to a hundredth
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
    two differences; low, high: its interval at 95 %, NaN for fewer than six pairs, of which none is that certain; p:
    Wilcoxon's signed-rank test that there is no shift, corrected for the number of figures (Holm)."""

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
    x, y = np.asarray(a, float), np.asarray(b, float)
    d = y - x
    n = len(d)
    if n == 0:
        return Shift(figure, 0, nan, nan, nan, nan, nan, 1.0)
    sample = (
        d if n <= _MOST_FOR_ALL_MEANS else np.quantile(d, (np.arange(_MOST_FOR_ALL_MEANS) + 0.5) / _MOST_FOR_ALL_MEANS)
    )
    i, j = np.triu_indices(len(sample))
    means = np.sort((sample[i] + sample[j]) / 2)
    outside = int(_means_outside(n) / (n * (n + 1) / 2) * len(means))  # of the sample as many as of all pairs
    low, high = (float(means[outside - 1]), float(means[-outside])) if outside else (nan, nan)
    middles = (float(np.median(v)) for v in (x, y, means))
    return Shift(figure, n, *middles, low, high, _p_of_no_shift(d))


def _means_outside(n: int) -> int:
    """The interval goes from that smallest to that largest of the n (n + 1) / 2 means of two differences; 0: there is
    none. It is the largest number C of which the signed-rank statistic is below C with a probability of at most 2.5 %
    (Hollander, Wolfe 1999, 3.3)."""
    from scipy.stats import norm

    if n <= _MOST_EXACT:
        below = np.cumsum(_rank_sums(np.arange(1, n + 1)))
        return int(np.searchsorted(below, 0.025 + 1e-12, side="right"))
    return int(n * (n + 1) / 4 - norm.ppf(0.975) * (n * (n + 1) * (2 * n + 1) / 24) ** 0.5)


def _rank_sums(ranks: np.ndarray) -> np.ndarray:
    """Probability of every sum of whole-numbered ranks, each of which counts or not by the toss of a coin."""
    p = np.ones(1)
    for rank in ranks:
        more = np.zeros(len(p) + int(rank))
        more[: len(p)] += p / 2
        more[int(rank) :] += p / 2
        p = more
    return p


def _p_of_no_shift(d: np.ndarray) -> float:
    """Wilcoxon's test, two-sided; differences of 0 tell nothing, and equal ones share their ranks."""
    from scipy.stats import rankdata, wilcoxon as signed_ranks

    d = d[d != 0]
    if not len(d):
        return 1.0
    if len(d) > _MOST_EXACT:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it tells that it approximates
            return float(signed_ranks(d, method="approx").pvalue)
    ranks = np.rint(2 * rankdata(np.abs(d))).astype(int)  # twice, so that shared ones are whole
    p, positive = _rank_sums(ranks), int(ranks[d > 0].sum())
    return float(min(1.0, 2 * min(p[: positive + 1].sum(), p[positive:].sum())))


def holm(p: list[float]) -> list[float]:
    """Corrected for their number: the smallest times n, the next times n - 1, and none below one before it (Holm
    1979)."""
    corrected, worst = [0.0] * len(p), 0.0
    for k, at in enumerate(np.argsort(p)):
        worst = max(worst, min(1.0, p[at] * (len(p) - k)))
        corrected[at] = worst
    return corrected
