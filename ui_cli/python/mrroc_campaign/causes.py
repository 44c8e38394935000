"""Which of the varied values failures depend on: for every key the one cut that tells failures from successes best."""

from dataclasses import dataclass, replace

import numpy as np

from .paired import holm

_PERMUTATIONS = 999
_MOST_CUTS = 200  # thresholds that are tried
_SMALLEST_PART = 0.05  # of the runs, on either side of a cut


@dataclass(frozen=True)
class Dependence:
    """A key and its best cut. p: how often failures that are dealt out at random would be told apart as well by any cut
    of this key, times the number of keys that are as good or worse (Holm 1979). inside, outside: failures and runs
    where the rule holds, and elsewhere. correlation: Spearman's, between value and failure; None for words."""

    key: str
    p: float
    rule: str
    inside: tuple[int, int]
    outside: tuple[int, int]
    correlation: float | None


def dependences(values: dict[str, list], failed: list[bool], seed: int = 1) -> list[Dependence]:
    """Of all keys, the strongest first; empty when there is nothing to tell apart."""
    y = np.asarray(failed, dtype=float)
    if not 0 < y.sum() < len(y):
        return []
    random = np.random.default_rng(seed)
    shuffled = np.stack([y, *(random.permutation(y) for _ in range(_PERMUTATIONS))])
    found = [d for key, column in values.items() if (d := _of_key(key, column, y, shuffled))]
    corrected = holm([d.p for d in found])
    found = [replace(d, p=p) for d, p in zip(found, corrected, strict=True)]
    return sorted(found, key=lambda d: (d.p, -abs(_difference(d))))


def _difference(d: Dependence) -> float:
    return d.inside[0] / d.inside[1] - d.outside[0] / d.outside[1]


def _of_key(key: str, column: list, y: np.ndarray, shuffled: np.ndarray) -> Dependence | None:
    numbers = all(isinstance(x, (int, float)) for x in column)
    sides, rules = _threshold_cuts(key, np.asarray(column, float)) if numbers else _word_cuts(key, column)
    if not len(sides):
        return None
    strength = _strength(sides, shuffled)  # a row per permutation, the true order first
    best = strength.max(axis=1)
    p = float(np.count_nonzero(best >= best[0] - 1e-12)) / len(best)
    fails_more = np.array([y[side].mean() > y.mean() for side in sides])
    cut = int((strength[0] + 1e-9 * fails_more).argmax())  # of two words both cuts are one: tell where it fails
    side, rule = sides[cut], rules[cut]
    if not fails_more[cut]:
        side, rule = ~side, rule.replace(" > ", " <= ") if numbers else rule.replace(" = ", " is not ")
    parts = [(int(y[s].sum()), int(s.sum())) for s in (side, ~side)]
    return Dependence(key, p, rule, parts[0], parts[1], spearman(np.asarray(column, float), y) if numbers else None)


def _strength(sides: np.ndarray, shuffled: np.ndarray) -> np.ndarray:
    """Chi-squared of the table of side and failure, for every permutation and every cut."""
    n, failures = shuffled.shape[1], shuffled[0].sum()
    size = sides.sum(axis=1).astype(float)
    inside = shuffled @ sides.T.astype(float)
    expected = failures * size / n
    variance = expected * (1 - size / n) * (1 - failures / n)
    return (inside - expected) ** 2 / variance


def _threshold_cuts(key: str, x: np.ndarray) -> tuple[np.ndarray, list[str]]:
    ends = np.unique(x)
    middles = (ends[:-1] + ends[1:]) / 2
    if len(middles) > _MOST_CUTS:
        middles = np.unique(np.quantile(x, np.linspace(0, 1, _MOST_CUTS + 2)[1:-1]))
    return _large_enough(x[None, :] > middles[:, None], [f"{key} > {m:.4g}" for m in middles])


def _word_cuts(key: str, column: list) -> tuple[np.ndarray, list[str]]:
    words = sorted({str(w) for w in column})
    sides = np.array([[str(w) == word for w in column] for word in words])
    return _large_enough(sides, [f"{key} = {word}" for word in words])


def _large_enough(sides: np.ndarray, rules: list[str]) -> tuple[np.ndarray, list[str]]:
    if not len(sides):
        return sides, rules
    share = sides.mean(axis=1)
    kept = (share >= _SMALLEST_PART) & (share <= 1 - _SMALLEST_PART)
    return sides[kept], [rule for rule, keep in zip(rules, kept, strict=True) if keep]


def spearman(x: np.ndarray, y: np.ndarray) -> float:
    """Spearman's rank correlation; 0 when one of both does not vary."""
    from scipy.stats import rankdata

    a, b = rankdata(x), rankdata(y)
    return 0.0 if a.std() == 0 or b.std() == 0 else float(np.corrcoef(a, b)[0, 1])
