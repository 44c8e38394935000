#!/usr/bin/env python3
"""What a run looked like in Python: its figures, the force of every arm, who said how much. Also cell by cell in a notebook.

Usage: example.py [RUN] [--picture FILE]      RUN: a run folder; without it the newest one below ./runs
"""

# %% The reader: installed, or the one beside this file, from wherever this is called
import argparse
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent) if "__file__" in globals() else "ui_cli/python")
try:
    import mrroc_runs
except ModuleNotFoundError as missing:
    sys.exit(f"error: the module {missing.name} is missing: apt-get install python3-numpy, or pip install numpy")


# %% Which run
def chosen_run(words: list[str]) -> tuple[mrroc_runs.Run, str]:
    """The run that the command line names, and the picture that it wants."""
    line = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    line.add_argument("run", nargs="?", help="a run folder")
    line.add_argument("--picture", default="", metavar="FILE", help="draw the forces there; needs matplotlib")
    chosen = line.parse_args(words)
    try:
        return mrroc_runs.open_run(chosen.run) if chosen.run else mrroc_runs.newest_run(), chosen.picture
    except FileNotFoundError as nothing:
        print(f"error: {nothing}; name a run folder: example.py RUN", file=sys.stderr)
        sys.exit(2)


# %% What can be asked of it
def tell(run: mrroc_runs.Run) -> None:
    """Prints figures, forces and channels."""
    print(f"{run.folder}: {run.summary['task']}, {run.summary['outcome']}, {run.summary['sim_s']:.2f} s simulated")
    for name, value in run.summary["figures"].items():
        print(f"  {name} = {value}")
    for number, name in enumerate(run.config["robots"]["order"], start=1):
        F_a = run.messages(f"{name}.reply")["F_a"]
        print(f"  {name} (arm{number}.csv): F_z from {F_a[:, 2].min():.2f} to {F_a[:, 2].max():.2f} N")
    for channel, count in sorted(run.channels().items()):
        print(f"  {channel:24} {count} messages")


def draw(run: mrroc_runs.Run, picture: str) -> None:
    """Draws F_z of every arm over simulated time [s]."""
    try:
        import matplotlib

        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ModuleNotFoundError:
        sys.exit("error: --picture needs matplotlib: apt-get install python3-matplotlib, or pip install matplotlib")
    for name in run.config["robots"]["order"]:
        reply = run.messages(f"{name}.reply")
        plt.plot(reply["step"] * run.config["time"]["dt"], reply["F_a"][:, 2], label=name)
    plt.xlabel("t [s]")
    plt.ylabel("F_z [N]")
    plt.legend()
    plt.savefig(picture)
    print(f"picture: {picture}")


# %% On the command line
if __name__ == "__main__":
    the_run, wanted = chosen_run([] if "ipykernel" in sys.modules else sys.argv[1:])
    try:
        tell(the_run)
    except (FileNotFoundError, ValueError) as damage:  # such as no summary.json
        sys.exit(f"error: {the_run.folder} is not the folder of a whole run, or it still runs: {damage}")
    if wanted:
        draw(the_run, wanted)
