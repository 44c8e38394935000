#!/usr/bin/python3
"""Draws where success ends in the plants of docs/robustness.md: docs/pictures/plants.png. Needs gnuplot.

Usage: plants.py PICTURE PRESS DRAWING EDGE_FOLLOW VISUAL_SERVO
PICTURE  file to write
others   folders of campaigns of these tasks over tasks/TASK/plants.txt; every run is a point"""

import json
import sqlite3
import subprocess
import sys
from pathlib import Path

STIFFNESS = "sim.paper.stiffness"
RIGID, ELASTIC, ALL = "rigid gears", "gears of 8 to 15 Hz", "cameras 3 mm and 0.5 degrees out of place"
COLOURS = {RIGID: "#0072b2", ELASTIC: "#d55e00", ALL: "#0072b2"}


def rows(folder: str) -> list[dict]:
    file = Path(folder, "results.sqlite")
    if not file.is_file():
        sys.exit(f"error: {folder} is no folder of a campaign: it has no results.sqlite")
    base = sqlite3.connect(f"file:{file}?mode=ro", uri=True)
    base.row_factory = sqlite3.Row
    return [dict(r) for r in base.execute("SELECT * FROM runs ORDER BY run")]


def of_arms(run: dict, figure: str) -> list[tuple[str, float]]:
    """A figure of each arm that has one, and its gears."""
    found = []
    for k, arm in enumerate(("arm1", "arm2")):
        value = run.get(f"{figure}[{k}]", run.get(figure) if k == 0 else None)
        if value is not None:
            found.append((ELASTIC if run.get(f"sim.robots.{arm}.elasticity") else RIGID, value))
    return found


def panel(runs: list[dict], across: str, figure: str) -> tuple[dict[str, list[str]], list[float]]:
    """The points of a figure by kind, and the bounds within which it is wanted."""
    points: dict[str, list[str]] = {}
    for run in runs:
        for kind, value in of_arms(run, figure):
            shown = kind if across == STIFFNESS else ALL
            points.setdefault(shown, []).append(f"{run[across]} {value}")
    wanted = next((json.loads(r["bars"]) for r in runs if r["bars"]), {}).get(figure, [])
    return points, [bound for bound in wanted if bound is not None]


def drawn(title: str, label: str, across: str, points: dict[str, list[str]], bounds: list[float]) -> str:
    lines = [f"set title '{title}' font 'sans:Bold,12' textcolor rgb '#1b2a41'", f"set ylabel '{label}'"]
    if across == STIFFNESS:
        lines += ["set logscale x", "set xrange [2000:100000]", "set xlabel 'stiffness of the surface [N/m]'"]
    else:
        lines += ["unset logscale x", "set format x '%g'", "set xrange [*:*]", "set xlabel 'focal length, true over believed'"]
    kinds = [k for k in COLOURS if k in points]
    lines += [f"$p{n} << E\n" + "\n".join(points[k]) + "\nE" for n, k in enumerate(kinds)]
    titles = ["title 'wanted'", "notitle"]
    plots = [f"{b} with lines lw 1.4 lc rgb '#4b5563' dt 2 {t}" for b, t in zip(bounds, titles, strict=False)]
    plots += [f"$p{n} with points pt 7 ps 0.4 lc rgb '{COLOURS[k]}' title '{k}'" for n, k in enumerate(kinds)]
    return "\n".join([*lines, f"set yrange [{'*' if len(bounds) > 1 else 0}:*]", "plot " + ", ".join(plots)])


def main(picture: str, press: str, drawing: str, edge: str, servo: str) -> None:
    lens = "sim.cameras.eih.focal_scale"
    panels = [
        ("press: force after the approach", "N", STIFFNESS, press, "approach_settled_N"),
        ("drawing: deviation of the force", "N", STIFFNESS, drawing, "paper_force_std_N"),
        ("edge_follow: error of the force, rms", "N", STIFFNESS, edge, "edge_follow_rms_N"),
        ("visual_servo: what its camera can know", "mm", lens, servo, "final_err_mm"),
    ]
    script = [
        "set terminal pngcairo size 1200,820 enhanced font 'sans,11' background rgb 'white' rounded",
        f"set output '{picture}'",
        "set border 3 lw 1 lc rgb '#667080'",
        "set tics nomirror out scale 0.6 textcolor rgb '#333a45'",
        "set grid lt 1 lw 1 lc rgb '#e4e8ee'",
        "set key below horizontal samplen 1.5",
        "set format x '%.0s%c'",
        "set multiplot layout 2,2",
    ]
    for title, unit, across, folder, figure in panels:
        script.append(drawn(title, f"[{unit}]", across, *panel(rows(folder), across, figure)))
    subprocess.run(["gnuplot"], input="\n".join([*script, "unset multiplot"]), text=True, check=True)


if __name__ == "__main__":
    if len(sys.argv) != 6:
        sys.exit(__doc__)
    main(*sys.argv[1:])
