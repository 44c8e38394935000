"""Intervals for a share of successes: for a number of runs that was fixed beforehand, and for one that was not."""

from math import lgamma, log, log1p

ALPHA = 0.05  # one interval in twenty may miss the true share


def clopper_pearson(successes: int, runs: int, alpha: float = ALPHA) -> tuple[float, float]:
    """The exact interval of a binomial share (Clopper, Pearson 1934), for a number of runs that was fixed
    beforehand."""
    from scipy.stats import beta

    low = beta.ppf(alpha / 2, successes, runs - successes + 1) if successes else 0.0
    high = beta.ppf(1 - alpha / 2, successes + 1, runs - successes) if successes < runs else 1.0
    return float(low), float(high)


def confidence_sequence(successes: int, runs: int, alpha: float = ALPHA) -> tuple[float, float]:
    """An interval that holds the true share at all times at once with probability 1 - alpha, so that one may look after
    every run and stop when one likes: the shares p for which the mixture of likelihoods under Beta(1/2, 1/2) is less
    than 1 / alpha times the likelihood under p. That ratio is a martingale under p, and Ville's inequality bounds how
    often it ever comes so high (Robbins 1970; Howard, Ramdas, McAuliffe, Sekhon 2021)."""
    if runs == 0:
        return 0.0, 1.0
    s, f = successes, runs - successes
    mixture = lgamma(s + 0.5) + lgamma(f + 0.5) - lgamma(runs + 1) - 2 * lgamma(0.5)

    def excess(p: float) -> float:
        likelihood = (s * log(p) if s else 0.0) + (f * log1p(-p) if f else 0.0)
        return mixture - likelihood + log(alpha)

    share = s / runs
    low = _crossing(excess, 0.0, share) if s else 0.0
    high = _crossing(excess, 1.0, share) if f else 1.0
    return low, high


def _crossing(excess, outside: float, inside: float) -> float:
    """Where excess changes its sign. At the share itself it is below 0, and it grows towards the ends. Rounded
    outwards."""
    for _ in range(60):
        middle = (outside + inside) / 2
        if excess(middle) >= 0:
            outside = middle
        else:
            inside = middle
    return outside


class Sequence:
    """Runs as they end, looked at in the order of the plan: those that take long, and may fail for it, are not left
    behind. Only a beginning of the plan without gaps counts."""

    def __init__(self, successes: dict[int, bool]):
        self._ended = dict(successes)
        self.runs, self.successes = 0, 0
        self._advance()

    def add(self, run: int, success: bool) -> None:
        """A run has ended."""
        self._ended[run] = success
        self._advance()

    def interval(self, alpha: float = ALPHA) -> tuple[float, float]:
        """confidence_sequence() of what counts so far."""
        return confidence_sequence(self.successes, self.runs, alpha)

    def narrower_than(self, width: float) -> bool:
        """Whether one may stop. width 0: never."""
        low, high = self.interval()
        return high - low <= width

    def _advance(self) -> None:
        while self.runs in self._ended:
            self.successes += self._ended[self.runs]
            self.runs += 1
