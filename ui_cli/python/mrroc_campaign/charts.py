"""Small pictures in SVG for the page of a campaign."""

from html import escape

import numpy as np

_W, _H, _LEFT, _BOTTOM, _TOP = 340, 170, 42, 30, 10


def short(x: float, digits: int = 3) -> str:
    """A number in few letters."""
    for size, mark in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if abs(x) >= size:
            return f"{x / size:.{digits}g} {mark}"
    return f"{x:.{digits}g}"


def distinct(numbers: list[float]) -> list[str]:
    """Different numbers in as few letters as tell them apart."""
    for digits in range(3, 17):
        told = [short(x, digits) for x in numbers]
        if len(set(told)) == len(set(numbers)):
            break
    return told


def _svg(parts: list[str], title: str) -> str:
    return f'<svg viewBox="0 0 {_W} {_H}" role="img" aria-label="{escape(title)}"><title>{escape(title)}</title>{"".join(parts)}</svg>'


def _text(x: float, y: float, text: str, anchor: str = "middle") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{escape(text)}</text>'


class _Axis:
    """Places of numbers on the horizontal axis."""

    def __init__(self, low: float, high: float):
        margin = 0.04 * (high - low) or max(abs(low), 1e-9) * 0.05
        self.low, self.high = low - margin, high + margin

    def __call__(self, x: float) -> float:
        return _LEFT + (_W - _LEFT - 8) * (x - self.low) / (self.high - self.low)

    def line(self) -> list[str]:
        """The axis with its ends and its middle."""
        y = _H - _BOTTOM
        parts = [f'<path class="axis" d="M{_LEFT} {y}H{_W - 8}"/>']
        places = [self.low + (self.high - self.low) * (0.08 + 0.42 * k) for k in range(3)]
        for x, told in zip(places, distinct(places), strict=True):
            parts.append(f'<path class="axis" d="M{self(x):.1f} {y}v4"/>' + _text(self(x), y + 16, told))
        return parts


def histogram(values: list[float], bars: tuple[float | None, float | None], title: str, failed: list[bool]) -> str:
    """How often a figure has which value; those of failed runs are dark. bars: what is wanted, at least and at most."""
    known = [b for b in bars if b is not None]
    # A bar that is far away from all values would press them into one column.
    spread = max(values) - min(values)
    shown = [b for b in known if min(values) - 3 * spread <= b <= max(values) + 3 * spread] if spread else known
    axis = _Axis(min([*values, *shown]), max([*values, *shown]))
    edges = np.linspace(
        min(values), max(values) if spread else min(values) + 1e-9, min(30, max(5, int(len(values) ** 0.5) + 1)) + 1
    )
    every, _ = np.histogram(values, edges)
    bad, _ = np.histogram([v for v, f in zip(values, failed, strict=True) if f], edges)
    top, floor = max(1, every.max()), _H - _BOTTOM
    parts = axis.line()
    for k, (count, of_failed) in enumerate(zip(every, bad, strict=True)):
        x, width = axis(edges[k]), max(2.0, axis(edges[k + 1]) - axis(edges[k]) - 0.5)
        for number, kind in ((count, "ok"), (of_failed, "bad")):
            height = (floor - _TOP) * number / top
            if number:
                parts.append(
                    f'<rect class="{kind}" x="{x:.1f}" y="{floor - height:.1f}" width="{width:.1f}" height="{height:.1f}"/>'
                )
    parts += [f'<path class="bar" d="M{axis(b):.1f} {_TOP - 6}V{floor}"/>' for b in shown]
    parts.append(_text(_LEFT - 4, _TOP + 8, str(top), "end"))
    return _svg(parts, title)


def rates(groups: list[tuple[str, int, int, float, float]], title: str) -> str:
    """Shares with their intervals, side by side. groups: name, failures, runs, ends of the interval."""
    floor = _H - _BOTTOM
    parts = [f'<path class="axis" d="M{_LEFT} {floor}H{_W - 8}M{_LEFT} {_TOP}V{floor}"/>']
    parts += [_text(_LEFT - 4, floor - (floor - _TOP) * s + 4, f"{100 * s:.0f} %", "end") for s in (0, 0.5, 1)]
    step = (_W - _LEFT - 8) / len(groups)
    for k, (name, failures, runs, low, high) in enumerate(groups):
        x = _LEFT + step * (k + 0.5)
        y, y_low, y_high = (floor - (floor - _TOP) * s for s in (failures / runs, low, high))
        parts.append(
            f'<rect class="bad" x="{x - step * 0.3:.1f}" y="{y:.1f}" width="{step * 0.6:.1f}" height="{floor - y:.1f}"/>'
        )
        parts.append(
            f'<path class="whisker" d="M{x:.1f} {y_low:.1f}V{y_high:.1f}M{x - 4:.1f} {y_low:.1f}h8M{x - 4:.1f} {y_high:.1f}h8"/>'
        )
        parts.append(_text(x, floor + 14, name))
    return _svg(parts, title)


def interval(share: float, low: float, high: float) -> str:
    """A share between 0 and 1 with its interval, on one line."""
    x = [8 + (_W - 16) * s for s in (0, share, low, high, 1)]
    return (
        f'<svg class="flat" viewBox="0 0 {_W} 34" role="img" aria-label="interval"><path class="axis" d="M{x[0]} 12H{x[4]}"/>'
        f'<rect class="span" x="{x[2]:.1f}" y="7" width="{max(1.0, x[3] - x[2]):.1f}" height="10"/><circle class="point" cx="{x[1]:.1f}" cy="12" r="5"/>'
        + _text(x[0], 31, "0", "start") + _text(x[4], 31, "100 %", "end") + "</svg>"
    )  # fmt: skip
