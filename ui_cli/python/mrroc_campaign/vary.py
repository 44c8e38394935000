"""How one value varies: KEY=LOW:HIGH, KEY=normal(M,S) or KEY=A,B,C."""

import math
import re
from dataclasses import dataclass
from statistics import NormalDist

from .errors import bad_usage
from .program import Parameter

_NORMAL = re.compile(r"normal\((?P<mean>[^,()]+),(?P<deviation>[^,()]+)\)$")
_SMALLEST = 1e-12  # the normal distribution has no quantile 0


@dataclass(frozen=True)
class Variation:
    """The values of a key. kind: uniform (low, high), normal (mean, deviation) or choice (words)."""

    key: str
    kind: str
    numbers: tuple[float, ...] = ()
    words: tuple[str, ...] = ()
    integer: bool = False

    def value(self, u: float) -> str:
        """The value at the quantile u of [0, 1), as text for the task, which reads it back to the last bit."""
        if self.kind == "choice":
            return self.words[min(int(u * len(self.words)), len(self.words) - 1)]
        if self.kind == "normal":
            x = NormalDist(*self.numbers).inv_cdf(min(max(u, _SMALLEST), 1 - _SMALLEST))
        else:
            low, high = self.numbers
            x = math.floor(low + u * (high - low + 1)) if self.integer else low + u * (high - low)
        return str(round(x)) if self.integer else repr(float(x))


def parse(text: str, known: dict[str, Parameter], told: str = "") -> Variation:
    """A word behind --vary. told: what errors name. Raises CampaignError when the key is no parameter of the task, or
    the values do not fit it."""
    told = told or f"--vary {text}"
    key, equals, values = text.partition("=")
    if not equals or not values:
        raise bad_usage(f"{told}: write KEY=LOW:HIGH, KEY=normal(M,S) or KEY=A,B,C")
    parameter = known.get(key)
    if parameter is None:
        raise bad_usage(f"{told}: unknown key '{key}'")
    integer = parameter.kind == "integer"
    if normal := _NORMAL.match(values):
        mean, deviation = (_number(told, normal[name]) for name in ("mean", "deviation"))
        if not deviation > 0:
            raise bad_usage(f"{told}: the standard deviation must be above 0")
        variation = Variation(key, "normal", (mean, deviation), integer=integer)
    elif parameter.kind != "word" and len(ends := values.split(":")) == 2:
        low, high = (_number(told, end) for end in ends)
        if not low < high:
            raise bad_usage(f"{told}: the lower end must be below the upper one")
        if integer and not (low.is_integer() and high.is_integer()):
            raise bad_usage(f"{told}: '{key}' takes whole numbers")
        variation = Variation(key, "uniform", (low, high), integer=integer)
    elif values.startswith("normal("):
        raise bad_usage(f"{told}: write normal(M,S), such as {key}=normal(4,0.5)")
    else:
        words = split_words(values)
        if len(set(words)) < 2:
            some = f"'{key}' takes {_words_that_fit(parameter)}; " if parameter.kind in ("list", "word") else ""
            ends = "" if some else ", or LOW:HIGH"
            raise bad_usage(f"{told}: {some}name at least two different values{ends}")
        return Variation(key, "choice", words=words)
    if parameter.kind in ("list", "word"):
        raise bad_usage(f"{told}: '{key}' takes {_words_that_fit(parameter)}; name its values: {key}=A,B")
    return variation


def _words_that_fit(parameter: Parameter) -> str:
    kind = "lists in brackets" if parameter.kind == "list" else "words"
    return f"{kind}: {parameter.range}" if parameter.range else f"{kind}, such as {parameter.default}"


def split_words(values: str) -> tuple[str, ...]:
    """Words between commas; a comma inside of brackets or quotation marks separates none."""
    words, word, depth, quoted = [], "", 0, False
    for c in values:
        quoted ^= c == '"'
        depth += 0 if quoted else (c == "[") - (c == "]")
        if c == "," and depth == 0 and not quoted:
            words.append(word)
            word = ""
        else:
            word += c
    return tuple(w.strip() for w in [*words, word])


def _number(told: str, word: str) -> float:
    try:
        x = float(word)
    except ValueError:
        x = math.nan
    if not math.isfinite(x):
        raise bad_usage(f"{told}: '{word}' is no number")
    return x
