"""What is wanted of a figure: at least and at most, None where there is no bound, as summary.json has it."""

from math import isfinite, nan

Bars = tuple[float | None, float | None]


def text(bars: Bars) -> str:
    """Such as "<= 0.5" or "1 +- 0.05"; nothing when there is no bound."""
    low, high = bars
    if low is not None and high is not None:
        return f"{low:g}" if low == high else f"{(low + high) / 2:g} +- {(high - low) / 2:g}"
    return f"<= {high:g}" if high is not None else f">= {low:g}" if low is not None else ""


def share(value: float, bars: Bars) -> float | None:
    """How much of what is wanted a value takes: within it between -1 and 1 around a middle, or up to 1; None where that
    is no number."""
    low, high = bars
    if low is not None and high is not None:
        share = (2 * value - low - high) / (high - low) if high > low else nan
    elif high:
        share = value / high
    else:
        share = low / value if low and value else nan
    return share if isfinite(share) else None
