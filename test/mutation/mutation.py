#!/usr/bin/env python3
"""How good the tests are: makes small plausible errors, one at a time, and counts those that a test notices.

  test/mutation/mutation.py --sample 60 --area edp       errors of one area
  test/mutation/mutation.py --files edp/servo.cpp        of these files
  test/mutation/mutation.py --sample 300 --json FILE     of all areas in equal parts, and the scores by area

Needs a build with its tests (--build, usual: build/release). Neither the sources nor the build are changed: a run that
is killed leaves nothing but a folder below build/mutation, which the next one removes."""

from __future__ import annotations

import argparse
import concurrent.futures
import json
import os
import pathlib
import shutil
import subprocess
import sys
import threading
import time
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True


def find_universalmutator(folder: pathlib.Path) -> None:
    """Makes universalmutator importable: what is installed, or what pip installs into an environment of its own.

    Raises RuntimeError, with what to do, when neither is possible."""
    try:
        import universalmutator  # noqa: F401

        return
    except ImportError:
        pass
    environment = folder / "venv"
    packages = list(environment.glob("lib/python3*/site-packages/universalmutator"))
    if not packages:
        try:
            subprocess.run([sys.executable, "-m", "venv", str(environment)], check=True, capture_output=True)
            pip = [str(environment / "bin" / "pip"), "install", "--quiet", "universalmutator==1.14.1"]
            subprocess.run(pip, check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError) as e:
            shutil.rmtree(environment, ignore_errors=True)
            raise RuntimeError("universalmutator cannot be installed; `apt-get install python3-venv` and a way to "
                               "pypi.org are needed, or an installed universalmutator") from e
        packages = list(environment.glob("lib/python3*/site-packages/universalmutator"))
    sys.path.append(str(packages[0].parent))


def read_areas(file: pathlib.Path = HERE / "areas.toml") -> dict:
    with open(file, "rb") as f:
        return tomllib.load(f)


class Record:
    """What has been found so far, as lines of JSON in a file, so that a run can be gone on with."""

    def __init__(self, file: pathlib.Path, resume: bool):
        self.file = file
        self.lock = threading.Lock()
        self.known: dict[str, dict] = {}
        if resume and file.exists():
            for line in file.read_text().splitlines():
                try:
                    entry = json.loads(line)
                except ValueError:
                    continue  # the last line of a run that was killed
                self.known[entry["key"]] = entry
        elif file.exists():
            file.unlink()

    def add(self, entry: dict) -> None:
        with self.lock:
            self.known[entry["key"]] = entry
            with open(self.file, "a", encoding="utf-8") as f:
                f.write(json.dumps(entry) + "\n")


class Run:
    """One sample of one area."""

    def __init__(self, options, built, record: Record, scratch: pathlib.Path):
        from mutants import Equivalents

        self.options = options
        self.built = built
        self.record = record
        self.scratch = scratch
        self.equivalents = Equivalents(ROOT)
        self.clean: dict[str, float] = {}
        self.data: dict[str, pathlib.Path] = {}
        self.local = threading.local()

    def time_tests(self, tests: list[str]) -> list[str]:
        """Runs the tests without a mutant. @return those that are there and pass"""
        from trial import run_test

        good = []
        for test in tests:
            if not self.built.has(test):
                print(f"{test} is not built and left out", flush=True)
                continue
            if test not in self.clean:
                begun = time.monotonic()
                if not run_test(self.built.folder / "bin" / test, self._folder("clean"), 600, self.data):
                    sys.exit(f"error: {test} fails without a mutant")
                self.clean[test] = time.monotonic() - begun
                self._keep_data()
            good.append(test)
        return good

    def _keep_data(self) -> None:
        """What the first run of a test has made, such as tables that take minutes, is there for the others."""
        for variable, source in self.data.items():
            made = self.scratch / "clean" / "run" / variable
            if made.exists() and not source.exists():
                self.data[variable] = made.rename(self._folder("data") / variable)

    def _folder(self, name: str) -> pathlib.Path:
        folder = self.scratch / name
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def try_one(self, mutant, tests) -> dict:
        """@return its entry in the record"""
        from trial import Trials

        if not hasattr(self.local, "trials"):
            self.local.trials = Trials(self.built, ROOT, self._folder(str(threading.get_ident())), self.data)
        result = self.local.trials.run(mutant, tests, self.clean)
        entry = {"key": mutant.key, "file": mutant.file, "line": mutant.number, "before": mutant.before.strip(),
                 "after": mutant.after.strip(), "rule": mutant.rule, "outcome": result.outcome, "by": result.by,
                 "tests": result.tests, "seconds": round(result.seconds, 1)}
        self.record.add(entry)
        return entry

    def area(self, name: str, area: dict, files: list[str], wanted: int) -> list[dict]:
        """Tries mutants of the files until so many count. @return the entries of those"""
        from mutants import sample

        self.data = {variable: self.built.folder / folder for variable, folder in area.get("data", {}).items()}
        tests = self.time_tests(area["tests"])
        source = sample(ROOT, files, f"{self.options.seed} {name}")
        counted: list[dict] = []
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            waiting: dict = {}
            while len(counted) < wanted:
                while source and len(waiting) < self.options.jobs:
                    mutant = next(source, None)
                    if mutant is None:
                        source = None
                    elif not self.equivalents.why(mutant):
                        waiting[pool.submit(self._known_or_tried, mutant, tests)] = mutant
                if not waiting:
                    break
                done, _ = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    mutant = waiting.pop(future)
                    entry = future.result()
                    if entry["outcome"] in ("killed", "survived", "untried"):
                        counted.append(entry)
                        self._say(name, len(counted), wanted, entry, mutant)
        return counted

    def _known_or_tried(self, mutant, tests) -> dict:
        known = self.record.known.get(mutant.key)
        if known and not (self.options.survivors and known["outcome"] == "survived"):
            return known
        return self.try_one(mutant, tests)

    @staticmethod
    def _say(name, number, wanted, entry, mutant) -> None:
        text = f"{name} {number}/{wanted} {entry['outcome']} {entry['seconds']} s {entry['by']}"
        if entry["outcome"] != "killed":
            text += f"\n{mutant.diff()}\n  tests: {' '.join(entry['tests'])}"
        print(text, flush=True)


def scores(by_area: dict[str, list[dict]]) -> dict[str, float]:
    """Killed mutants of those that count, in per cent."""

    def score(entries):
        return round(100 * sum(e["outcome"] == "killed" for e in entries) / len(entries), 1)

    figures = {f"mutation_score_{name}_pct": score(e) for name, e in by_area.items() if e}
    if figures:
        figures["mutation_score_worst_pct"] = min(figures.values())
        figures["mutation_score_pct"] = score([e for entries in by_area.values() for e in entries])
    return figures


def report(by_area: dict[str, list[dict]]) -> str:
    """What survived, with its diff and the tests that ran."""
    lines = []
    for name, entries in by_area.items():
        alive = [e for e in entries if e["outcome"] != "killed"]
        lines.append(f"{name}: {len(entries) - len(alive)} of {len(entries)} killed")
        for e in alive:
            lines += [f"  {e['file']}:{e['line']}  ({e['outcome']}; {' '.join(e['tests']) or 'no test has it'})",
                      f"    - {e['before']}", f"    + {e['after']}"]
    return "\n".join(lines)


def parse() -> argparse.Namespace:
    line = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    line.add_argument("--area", action="append", help="edp, base, ... of areas.toml; may be repeated (default: all)")
    line.add_argument("--files", nargs="+", default=[], help="these only, relative to the sources")
    line.add_argument("--sample", type=int, default=300, help="mutants that count, of all areas in equal parts (default: 300)")
    line.add_argument("--seed", type=int, default=1, help="of the sample")
    line.add_argument("--jobs", "-j", type=int, default=1, help="mutants at a time")
    line.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release", help="a build with its tests")
    line.add_argument("--json", type=pathlib.Path, help="writes the figures there")
    line.add_argument("--resume", action="store_true", help="goes on with what the last run of the seed has found")
    line.add_argument("--survivors", action="store_true", help="with --resume: tries those again that survived")
    return line.parse_args()


def main() -> int:
    options = parse()
    work = ROOT / "build" / "mutation"
    work.mkdir(parents=True, exist_ok=True)
    try:
        find_universalmutator(work)
    except RuntimeError as e:
        sys.exit(f"error: {e}")
    from built import Built
    from mutants import files_of

    for left in work.glob("run-*"):
        if not pathlib.Path(f"/proc/{left.name[4:]}").exists():
            shutil.rmtree(left, ignore_errors=True)
    scratch = work / f"run-{os.getpid()}"
    areas = {n: a for n, a in read_areas().items() if not options.area or n in options.area}
    record = Record(work / f"seed-{options.seed}.jsonl", options.resume)
    try:
        run = Run(options, Built(options.build.resolve()), record, scratch)
        by_area = {}
        for name, area in areas.items():
            files = [f for f in files_of(ROOT, area) if not options.files or f in options.files]
            if files:
                by_area[name] = run.area(name, area, files, max(1, options.sample // len(areas)))
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    print(report(by_area))
    figures = scores(by_area)
    for key, value in figures.items():
        print(f"{key:32} {value:6.1f}")
    if options.json:
        options.json.write_text(json.dumps({"figures": figures, "seed": options.seed}, indent=2) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
