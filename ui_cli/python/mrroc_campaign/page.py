"""A campaign as a page of HTML that needs nothing else: success rate, figures, causes, and how to repeat each
failure."""

import json
from html import escape
from pathlib import Path

import numpy as np

from . import bars, causes, charts, repeat, report
from .groups import grouped
from .intervals import clopper_pearson
from .report import Rate
from .results import MARK, WORKER_LOST, Results, kept_as

_MOST_FAILURES = 300
_STYLE = (Path(__file__).parent / "page.css").read_text()


def of(results: Results) -> str:
    """The page as text."""
    runs, plan = results.counted(), results.plan
    search = results.note("search")
    title = f"{plan.task}: {'search, ' if search else ''}{len(runs)} runs"
    parts = [f"<h1>{escape(title)}</h1>"]
    if search:
        parts.append(_search(search))
    else:
        parts.append(f"<p><code>{escape(repeat.campaign_line(plan))}</code></p>")
    if runs:
        rate = report.rate(plan, runs)
        parts.append(_faults_of_search(rate) if search else _rate(rate, len(results.planned())))
        parts.append(_figures(results, runs))
        parts.append("" if search else _causes(results, runs))
        parts.append(_failures(results, runs))
    else:
        parts.append("<p>No run has been counted yet.</p>")
    head = f'<meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{escape(title)}</title><style>{_STYLE}</style>'
    return f'<!doctype html>\n<html lang="en"><head>{head}</head>\n<body>' + "\n".join(parts) + "</body></html>\n"


def _table(headings: list[str], rows: list[list[str]], kind: str = "") -> str:
    """Cells are HTML."""
    top = "".join(f"<th>{escape(h)}</th>" for h in headings)
    body = "\n".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return f'<div class="wide"><table class="{kind}"><thead><tr>{top}</tr></thead><tbody>{body}</tbody></table></div>'


def _without_advice(text: str) -> str:
    return text.rsplit("; ", 1)[0]  # errors of programs end with what to do


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _search(search: dict) -> str:
    best = "largest" if search["largest"] else "smallest"
    return (
        f"<p>A search for the {best} <code>{escape(search['figure'])}</code> over {', '.join(f'<code>{escape(k)}</code>' for k in search['space'])}. "
        "Its values were proposed one after the other by what was found before, so how many of its runs ended as wanted is no success rate.</p>"
    )


def _faults_of_search(rate: Rate) -> str:
    rows = [[f"<code>{escape(fault)}</code>", str(count), _example(rate, fault)] for fault, count in rate.faults()]
    return f"<section><h2>Failed</h2>{_table(['failed by', 'runs', 'such as'], rows)}</section>" if rows else ""


def _example(rate: Rate, fault: str) -> str:
    return escape(_without_advice(next(r["text"] for r in rate.rows if r["fault"] == fault)))


def _rate(rate: Rate, planned: int) -> str:
    later = (
        f"<p>{rate.later} runs that stand behind these in the plan have ended too, and do not count here: one before them has not.</p>"
        if rate.later
        else ""
    )
    if not rate.runs:
        return f"<section><h2>Success</h2><p>Not known yet: the first run of the plan has not ended.</p>{later}</section>"
    kind = (
        "an interval that holds at all times (Robbins 1970), since it decided when to stop"
        if rate.at_all_times
        else "Clopper and Pearson's exact interval"
    )
    rows = []
    for fault, count in rate.faults():
        low, high = rate.interval(count)
        share = [_percent(count / rate.runs), f"{_percent(low)} to {_percent(high)}"]
        rows.append([f"<code>{escape(fault)}</code>", str(count), *share, _example(rate, fault)])
    faults = _table(["failed by", "runs", "share", "at 95 %", "such as"], rows) if rows else "<p>No run failed.</p>"
    lost = (
        f"<p>Of {rate.lost()} runs the workers died, again and again: they count as failures (<code>{WORKER_LOST}</code>). <code>--resume</code> tries them once more.</p>"
        if rate.lost()
        else ""
    )
    return (
        f'<section><h2>Success</h2><p class="big">{_percent(rate.share)}</p>'
        f"<p>{rate.successes} of {rate.runs} runs ended as wanted{f'; {planned} were planned' if planned != rate.runs else ''}. "
        f"At 95 % the true rate is between {_percent(rate.low)} and {_percent(rate.high)}: {kind}.</p>{lost}{later}"
        f"{charts.interval(rate.share, rate.low, rate.high)}{faults}</section>"
    )


def _figures(results: Results, runs: list[dict]) -> str:
    cards = [card for name in results.figures() if (card := _figure(name, runs))]
    return (
        "<section><h2>Figures</h2><p>How often a figure had which value; dark: in runs that failed. The line is what is wanted. Where that differs "
        "from run to run the axis is the figure's share of it: between -1 and 1 around a middle, or up to 1.</p>"
        f'<div class="cards">{"".join(cards)}</div></section>'
        if cards
        else ""
    )


def _figure(name: str, runs: list[dict]) -> str:
    measured = [r for r in runs if r.get(name) is not None]  # a column may be newer than the rows
    if not measured:
        return ""
    key = name.split("[")[0].removeprefix(MARK)
    wanted = [tuple(json.loads(r["bars"] or "{}").get(key, (None, None))) for r in measured]
    values, failed = [r[name] for r in measured], [not r["success"] for r in measured]
    told = {w for w in wanted if w != (None, None)}
    limits, note = (None, None), "nothing is wanted of it"
    if len(told) == 1:
        limits, note = next(iter(told)), f"wanted {bars.text(next(iter(told)))}"
    elif told:
        shares = [bars.share(v, w) for v, w in zip(values, wanted, strict=True)]
        failed = [f for f, s in zip(failed, shares, strict=True) if s is not None]
        values = [s for s in shares if s is not None]
        if not values:
            return ""
        limits, note = (-1.0 if any(None not in w for w in told) else None, 1.0), "as a share of what is wanted"
    q = np.quantile(values, (0, 0.5, 0.95, 1))
    numbers = f"least {q[0]:.4g}, median {q[1]:.4g}, 95 % below {q[2]:.4g}, most {q[3]:.4g}"
    missing = f"; not measured in {len(runs) - len(measured)} runs" if len(measured) < len(runs) else ""
    return (
        f'<figure><figcaption><b>{escape(name)}</b> <span class="dim">{escape(note)}</span></figcaption>'
        f'{charts.histogram(values, limits, name, failed)}<p class="dim">{numbers}{missing}</p></figure>'
    )


def _causes(results: Results, runs: list[dict]) -> str:
    keys = list(results.planned()[0].settings)
    if not keys:
        return ""
    failed = [not r["success"] for r in runs]
    found = causes.dependences({k: [r[k] for r in runs] for k in keys}, failed)
    if not found:
        text = (
            "<p>There is nothing to tell apart: "
            + ("no run failed" if not any(failed) else "no run succeeded, or nothing varied enough")
            + ".</p>"
        )
        return f"<section><h2>What failures depend on</h2>{text}{_correlations(results, runs, keys)}</section>"
    rows = [
        [
            f"<code>{escape(d.key)}</code>", f"{'<b>' if d.p <= 0.05 else ''}{d.p:.3f}{'</b>' if d.p <= 0.05 else ''}", f"<code>{escape(d.rule)}</code>",
            f"{_percent(d.inside[0] / d.inside[1])} ({d.inside[0]} of {d.inside[1]})", f"{_percent(d.outside[0] / d.outside[1])} ({d.outside[0]} of {d.outside[1]})",
            "" if d.correlation is None else f"{d.correlation:+.2f}",
        ]
        for d in found
    ]  # fmt: skip
    cards = "".join(
        f"<figure><figcaption><b>{escape(d.key)}</b></figcaption>{_rates(d.key, runs)}</figure>" for d in found[:6]
    )
    return (
        "<section><h2>What failures depend on</h2><p>For each varied value the one cut that tells failures best from successes. p: how often failures dealt "
        "out at random are told apart as well by some cut of the same value (999 permutations), corrected for the number of values (Holm); 0.05 and less is "
        "bold. A dependence is no cause yet: repeat a failure with that value alone changed.</p>"
        + _table(["value", "p", "fails where", "failed there", "failed elsewhere", "rank correlation"], rows)
        + f'<p>Share of failed runs over each value; where there are many of them a bar is of neighbours, and named by their median:</p><div class="cards">{cards}</div>{_correlations(results, runs, keys)}</section>'
    )


def _rates(key: str, runs: list[dict]) -> str:
    numbers = all(isinstance(r[key], (int, float)) for r in runs)
    column = [r[key] if numbers else str(r[key]) for r in runs]
    parts = grouped(column)
    names = charts.distinct([float(np.median(part)) for part in parts]) if numbers else [part[0] for part in parts]
    groups = []
    for name, values in zip(names, parts, strict=True):
        part = [r for r, x in zip(runs, column, strict=True) if x in values]
        failures = sum(not r["success"] for r in part)
        groups.append((name, failures, len(part), *clopper_pearson(failures, len(part))))
    return charts.rates(groups, f"share of failed runs over {key}")


def _correlations(results: Results, runs: list[dict], keys: list[str]) -> str:
    numbers = [k for k in keys if all(isinstance(r[k], (int, float)) for r in runs)]
    rows = []
    for name in results.figures():
        measured = [r for r in runs if r.get(name) is not None]
        if len(measured) >= 10 and numbers:
            rho = [
                causes.spearman(np.array([r[k] for r in measured]), np.array([r[name] for r in measured]))
                for k in numbers
            ]
            rows.append(
                [
                    f"<code>{escape(name)}</code>",
                    *(f'<span style="opacity:{0.35 + 0.65 * abs(x):.2f}">{x:+.2f}</span>' for x in rho),
                ]
            )
    if not rows:
        return ""
    return "<h3>Figures and values: Spearman's rank correlation</h3>" + _table(["figure", *numbers], rows)


def _failures(results: Results, runs: list[dict]) -> str:
    failed = [r for r in runs if not r["success"]]
    if not failed:
        return ""
    planned = {row.run: row for row in results.planned()}
    rows = []
    for r in failed[:_MOST_FAILURES]:
        folder = escape(r["folder"])
        if r["folder"] == kept_as(r["run"]):  # elsewhere: HOST:PATH, which no link reaches
            folder = f'<a href="{folder}/run/">{folder}</a>'
        line = f"<code>{escape(repeat.line_of(results.plan, planned[r['run']]))}</code>"
        rows.append(
            [
                str(r["run"]),
                str(r["seed"]),
                f"<code>{escape(r['fault'])}</code> {escape(_without_advice(r['text']))}",
                line,
                f"<code>{escape(r['log_hash'] or '')}</code>",
                folder,
            ]
        )
    more = f"<p>{len(failed) - _MOST_FAILURES} more are in results.sqlite.</p>" if len(failed) > _MOST_FAILURES else ""
    return (
        "<section><h2>Failures</h2><p>Each line repeats its run bit for bit: <code>ui_cli log compare</code> finds no difference. The "
        "<code>log_hash</code> is the one that stands here, but after some faults in which processes end by themselves. A run without a hash did not come to "
        "its end - <code>wall_time</code>, <code>signal_N</code>, <code>worker_lost</code> -, and where it was ended lies with the machine.</p>"
        + _table(["run", "seed", "failed by", "to repeat it", "log_hash", "folder"], rows, "failures")
        + f"{more}</section>"
    )
