"""Two campaigns side by side, paired by seed."""

import json
from dataclasses import asdict, dataclass, field, replace

from .errors import bad_usage
from .paired import Shift, Successes, holm, mcnemar, wilcoxon
from .results import Results


@dataclass(frozen=True)
class Comparison:
    """What compare() found."""

    pairs: int
    successes: Successes
    figures: list[Shift]
    notes: list[str] = field(default_factory=list)

    def as_json(self) -> str:
        """One document; what is not known is null."""

        def known(x):
            if isinstance(x, dict):
                return {k: known(v) for k, v in x.items()}
            if isinstance(x, list):
                return [known(v) for v in x]
            return None if x != x else x

        return json.dumps(known(asdict(self)), indent=2)

    def as_text(self) -> str:
        """A table for a terminal."""
        s = self.successes
        lines = [f"{self.pairs} pairs of runs with the same seed", *self.notes]
        lines.append(
            f"success: both {s.both}, only A {s.only_a}, only B {s.only_b}, neither {s.neither}; p = {s.p:.3g} (McNemar, exact)"
        )
        lines.append(
            f"  {'figure':<30}{'pairs':>6}{'median A':>12}{'median B':>12}{'B - A':>12}  {'at 95 %':<26}p (Wilcoxon, Holm)"
        )
        for f in self.figures:
            between = f"{f.low:.4g} to {f.high:.4g}" if f.low == f.low else "too few pairs"
            lines.append(
                f"  {f.figure:<30}{f.pairs:>6}{f.median_a:>12.4g}{f.median_b:>12.4g}{f.difference:>12.4g}  {between:<26}{f.p:.3g}"
            )
        return "\n".join(lines)


def compare(a: Results, b: Results) -> Comparison:
    """Raises CampaignError when there is no seed that both have."""
    for results in (a, b):
        if results.note("search"):
            raise bad_usage(f"{results.folder} is a search, which has every seed many times; compare campaigns")
    of_a, of_b = ({r["seed"]: r for r in results.counted()} for results in (a, b))
    for results, runs in ((a, of_a), (b, of_b)):
        if not runs:
            raise bad_usage(f"{results.folder} has no run that is counted yet; go on with --resume {results.folder}")
    seeds = sorted(of_a.keys() & of_b.keys())
    if not seeds:
        raise bad_usage(f"{a.folder} and {b.folder} have no seed in common")
    pairs = [(of_a[seed], of_b[seed]) for seed in seeds]
    shifts = []
    for name in (n for n in a.figures() if n in b.figures()):
        both = [(x[name], y[name]) for x, y in pairs if x[name] is not None and y[name] is not None]
        if both:
            shifts.append(wilcoxon(name, [x for x, _ in both], [y for _, y in both]))
    corrected = holm([s.p for s in shifts])
    shifts = [replace(s, p=p) for s, p in zip(shifts, corrected, strict=True)]
    ended = mcnemar([(bool(x["success"]), bool(y["success"])) for x, y in pairs])
    return Comparison(len(pairs), ended, shifts, _notes(a, b, pairs, of_a, of_b))


def _notes(a: Results, b: Results, pairs: list, of_a: dict, of_b: dict) -> list[str]:
    notes = []
    if a.plan.task != b.plan.task:
        notes.append(f"note: A ran {a.plan.task}, B {b.plan.task}")
    if single := len(of_a.keys() ^ of_b.keys()):
        notes.append(f"note: {single} runs have no counterpart and are left out")
    shared = [k for k in a.planned()[0].settings if k in b.planned()[0].settings]
    if differing := [k for k in shared if any(x[k] != y[k] for x, y in pairs)]:
        notes.append(
            f"note: {', '.join(differing)} had other values in B; the same --vary, --plan and --plan-seed pair them too"
        )
    return notes
