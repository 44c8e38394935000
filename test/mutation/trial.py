"""Tries one mutant: compiles it, links the tests that have it in them, and runs them until one fails."""

from __future__ import annotations

import collections
import dataclasses
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time

from built import Built
from mutants import Mutant

TIMEOUT_FACTOR = 10  # times what the program takes without a mutant
LEAST_TIMEOUT = 20.0  # [s]
MEMORY = 6 << 30  # that a mutant may take [byte]
FILE_SIZE = 1 << 30  # [byte]; a test makes a file of half of that, with holes
FEW = 5  # objects that are compiled at first for a header
MOST = 10  # objects that are compiled, linked and run at all for one
CHECK_LIMIT = 180.0  # [s] for the look whether all others that use a header still compile


@dataclasses.dataclass
class Result:
    """What became of a mutant."""

    outcome: str  # killed, survived, invalid: does not compile, same: compiles to the same, untried: in no test
    by: str = ""  # killed: the test program
    tests: list[str] = dataclasses.field(default_factory=list)  # programs that ran
    seconds: float = 0

    @property
    def counts(self) -> bool:
        return self.outcome in ("killed", "survived", "untried")


class Trials:
    """Tries mutants in a folder of its own. Used by one thread.

    @param scratch  an empty folder; everything that mutants and their tests write is below it
    @param data     folders that tests may change, by environment variable"""

    def __init__(self, built: Built, root: pathlib.Path, scratch: pathlib.Path, data: dict[str, pathlib.Path] = {}):
        self.built = built
        self.root = root
        self.scratch = scratch
        self.data = data
        self.originals: dict[str, bytes] = {}

    def run(self, mutant: Mutant, tests: list[str], clean: dict[str, float]) -> Result:
        """@param clean  what each test takes without a mutant [s]; the quickest is run first"""
        begun = time.monotonic()
        result = self._run(mutant, sorted(tests, key=lambda t: clean[t]), clean)
        result.seconds = time.monotonic() - begun
        return result

    def _run(self, mutant: Mutant, tests: list[str], clean: dict[str, float]) -> Result:
        objects = [o for o in self.built.objects_of(self.root / mutant.file) if any(self.built.is_linked(o, t) for t in tests)]
        overlay = self.scratch / "overlay"
        changed = overlay / mutant.file
        changed.parent.mkdir(parents=True, exist_ok=True)
        try:
            compiled: dict[str, pathlib.Path | None] = {}  # None: it is the same as without the mutant
            result = Result("untried")
            if objects:
                result = self._compile_and_run(mutant, objects, overlay, tests, clean, compiled)
            if result.outcome in ("survived", "untried") and not self._others_compile(mutant, compiled, overlay):
                return Result("invalid")
            return result
        finally:
            changed.unlink(missing_ok=True)

    def _compile_and_run(self, mutant, objects, overlay, tests, clean, compiled) -> Result:
        # First those that name the header themselves, its own source before its neighbours; if nothing fails, all, unless they
        # are too many.
        objects = sorted(objects, key=lambda o: self._distance(o, mutant.file))
        direct = [o for o in objects if mutant.file.endswith(".cpp") or self._names(o, mutant.file)]
        rounds = [direct[:FEW] or objects[:FEW]]
        if len(rounds[0]) < len(objects):
            rounds.append(list(dict.fromkeys(direct + objects))[:MOST])
        result = Result("same")
        for wanted in rounds:
            for obj in wanted:
                if obj in compiled:
                    continue
                new = self.scratch / f"new{len(compiled)}.o"
                if not self._compile(obj, mutant, overlay, new, mutant.text(self.root)):
                    return Result("invalid")
                if mutant.file.endswith(".cpp") and not self.built.offers_the_same(obj, new):
                    return Result("invalid")  # it would not be linked: another function than the one that is called
                compiled[obj] = new if self._original(obj, mutant, overlay) != new.read_bytes() else None
            changed = {obj: new for obj, new in compiled.items() if new}
            if changed:
                result = self._tests(changed, tests, clean)
            if result.outcome == "killed":
                break
        return result

    def _others_compile(self, mutant, compiled, overlay) -> bool:
        """Whether everything else that has a mutant still compiles, such as a task's main program, which is in no test, or the
        many users of a header. It is only checked, not compiled, as long as there is time: first one of each folder."""
        sources = {self.built.source[o]: o for o in self.built.objects_of(self.root / mutant.file)}
        for obj in compiled:
            sources.pop(self.built.source[obj], None)
        turn = collections.Counter()
        turns: list[tuple[int, str]] = []
        for obj in sorted(sources.values(), key=lambda o: self._distance(o, mutant.file)):
            folder = self.built.source[obj].parent
            turns.append((turn[folder], obj))
            turn[folder] += 1
        end = time.monotonic() + CHECK_LIMIT
        own = self._write(mutant, overlay, mutant.text(self.root))
        for _, obj in sorted(turns, key=lambda t: t[0]):
            if time.monotonic() > end:
                break
            if not self.built.accepts(obj, overlay, own):
                return False
        return True

    def _original(self, obj: str, mutant: Mutant, overlay: pathlib.Path) -> bytes:
        """The object without a mutant: for a header the build's, else compiled in the same way, as a file may name itself."""
        if not mutant.file.endswith(".cpp"):
            return (self.built.folder / obj).read_bytes()
        if obj not in self.originals:
            old = self.scratch / "old.o"
            self._compile(obj, mutant, overlay, old, (self.root / mutant.file).read_text())
            self.originals[obj] = old.read_bytes()
        return self.originals[obj]

    def _distance(self, obj: str, header: str) -> int:
        source, header_path = self.built.source[obj], self.root / header
        return 0 if source.with_suffix("") == header_path.with_suffix("") else 1 if source.parent == header_path.parent else 2

    def _names(self, obj: str, header: str) -> bool:
        source = self.built.source[obj]
        return source.exists() and f'#include "{header}"' in source.read_text()

    def _compile(self, obj: str, mutant: Mutant, overlay: pathlib.Path, output: pathlib.Path, text: str) -> bool:
        return self.built.compile_to(obj, output, overlay, self._write(mutant, overlay, text))

    @staticmethod
    def _write(mutant: Mutant, overlay: pathlib.Path, text: str) -> pathlib.Path | None:
        """@return what is to be compiled instead of an object's own source; None: only a header of it is another"""
        changed = overlay / mutant.file
        changed.write_text(text)
        return changed if mutant.file.endswith(".cpp") else None

    def _tests(self, objects, tests, clean) -> Result:
        ran = []
        for test in tests:
            if not any(self.built.is_linked(o, test) for o in objects):
                continue
            program = self.scratch / test
            if not self.built.link_to(test, program, objects):
                return Result("invalid")
            ran.append(test)
            passed = run_test(program, self.scratch, max(LEAST_TIMEOUT, TIMEOUT_FACTOR * clean[test]), self.data)
            program.unlink()
            if not passed:
                return Result("killed", test, ran)
        return Result("survived" if ran else "untried", "", ran)


def run_test(program: pathlib.Path, scratch: pathlib.Path, timeout: float, data: dict[str, pathlib.Path]) -> bool:
    """Runs a test program to its end or its first failure. @param data: by environment variable, folders that tests may
    change: each run has copies of its own. @return whether all passed in time"""

    def limit():
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell lets what it starts in the background ignore it
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_SIZE, FILE_SIZE))

    folder = scratch / "run"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    environment = os.environ | {"TMPDIR": str(folder), "XDG_RUNTIME_DIR": str(folder), "HOME": str(folder)}
    for variable, source in data.items():
        if source.exists():
            shutil.copytree(source, folder / variable)
        environment[variable] = str(folder / variable)
    child = subprocess.Popen([str(program), "--gtest_fail_fast", "--gtest_brief=1", "--gtest_filter=-WallClock*"],
                             cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                             stderr=subprocess.DEVNULL, start_new_session=True, preexec_fn=limit)
    try:
        return child.wait(timeout) == 0
    except subprocess.TimeoutExpired:
        return False
    finally:
        # Also what the test has started and left.
        try:
            os.killpg(child.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        child.wait()
