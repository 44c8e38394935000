"""Makes the mutants of source files with universalmutator's rules and those of plausible.rules, and draws samples."""

from __future__ import annotations

import contextlib
import dataclasses
import fnmatch
import hashlib
import io
import pathlib
import random
import re
import tomllib
from collections.abc import Iterator

from fresh import Fresh

APART = "{\u200b-"
HERE = pathlib.Path(__file__).resolve().parent
BUILT_IN = ["universal.rules", "c_like.rules", "cpp.rules"]
# Of universalmutator's rules: what nobody writes by mistake, or what changes text for people only.
IMPLAUSIBLE = re.compile(r'^(".\+" ==>|\\\+= ==> =\+|-= ==> =-|while ==> if|.*==> .*%|% ==>|.*break;|.*continue;'
                         r"|.*DO_NOT_MUTATE|accumulate|inner_product|front_inserter|back_inserter"
                         r"|\(\[\^&\]\)&|\(\[\^\|\]\)\\\|)")
# Lines whose mutants are not errors of the program: declarations of other things, and what is there for speed only.
NOT_CODE = re.compile(r"^\s*(#|namespace\b|using\b|template\b|}|public:|private:|protected:|///?|.*\.reserve\()"
                      r"|static_assert|\[\[nodiscard\]\]\s*$|^\s*(class|struct|enum class) [\w:]+( final)?;|= default;|= delete;")

# A counter that grows by one from zero meets its bound: there `<` and `!=` are the same.
COUNTED = re.compile(r"for \((?:auto|int|std::size_t|std::int64_t|unsigned) (\w+)(?:\{\}| = 0); \1 < ([^;]+); \+\+\1\)")


@dataclasses.dataclass(frozen=True)
class Mutant:
    """One changed line of a file."""

    file: str  # relative to the sources
    number: int  # of the line, from 1 on
    before: str  # the line as it is, without the line's end
    after: str
    rule: str

    @property
    def key(self) -> str:
        """Stays the same when other lines of the file change."""
        text = "\0".join([self.file, self.before.strip(), self.after.strip()])
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def diff(self) -> str:
        return f"{self.file}:{self.number}\n- {self.before.strip()}\n+ {self.after.strip()}"

    def text(self, root: pathlib.Path) -> str:
        """The file with the changed line."""
        lines = (root / self.file).read_text().split("\n")
        lines[self.number - 1] = self.after
        return "\n".join(lines)


def mutants_of(root: pathlib.Path, file: str) -> list[Mutant]:
    """All mutants of a file, in the order of its lines."""
    from universalmutator import mutator

    lines = (root / file).read_text().splitlines(keepends=True)
    # universalmutator takes `{-` for the beginning of a comment of Haskell, and leaves out all lines until `-}`.
    shown = [line.replace("{-", APART) for line in lines]
    rules = [*BUILT_IN, str(HERE / "plausible.rules")]
    with contextlib.redirect_stdout(io.StringIO()):
        found = mutator.mutants_regexp(shown, ruleFiles=rules, ignorePatterns=[], ignoreStringOnly=True)
    mutants = []
    for number, after, rule, _ in found:
        before, after = lines[number - 1], after.replace(APART, "{-")
        if NOT_CODE.search(before) or IMPLAUSIBLE.match(rule[0]) or not changes_code(before, after):
            continue
        mutants.append(Mutant(file, number, before.rstrip("\n"), after.rstrip("\n"), rule[0]))
    return mutants


def changes_code(before: str, after: str) -> bool:
    """Whether more than blanks, comments and what stands in quotes differs."""

    def code(line: str) -> str:
        line = re.sub(r'"(\\.|[^"\\])*"', '""', line)
        return re.sub(r"\s+", "", re.sub(r"//.*", "", line))

    return code(before) != code(after)


def files_of(root: pathlib.Path, area: dict) -> list[str]:
    """Files of an area, in alphabetical order."""
    files = {f.relative_to(root).as_posix() for pattern in area["sources"] for f in root.glob(pattern) if f.is_file()}
    keep = [f for f in files if f.endswith((".cpp", ".hpp"))]
    return sorted(f for f in keep if not any(fnmatch.fnmatch(f, p) for p in area.get("leave_out", [])))


def sample(root: pathlib.Path, files: list[str], seed: str) -> Iterator[Mutant]:
    """Mutants without end in the order of a seed: every line of code is as likely as any other, and comes once in a
    round; of its kinds of mutants, and of the mutants of that kind, each is as likely."""
    chance = random.Random(seed)
    by_line: dict[tuple[str, int], list[Mutant]] = {}
    for file in files:
        for m in mutants_of(root, file):
            by_line.setdefault((m.file, m.number), []).append(m)
    while by_line:
        for line in chance.sample(sorted(by_line), len(by_line)):
            left = by_line[line]
            rule = chance.choice(sorted({m.rule for m in left}))
            chosen = chance.choice([m for m in left if m.rule == rule])
            left.remove(chosen)
            if not left:
                del by_line[line]
            yield chosen


class Equivalents:
    """The list of mutants that do the same as the program."""

    def __init__(self, root: pathlib.Path, file: pathlib.Path = HERE / "equivalent.toml"):
        self.root = root
        self.fresh = Fresh(root)
        with open(file, "rb") as f:
            self.entries = tomllib.load(f).get("mutant", [])

    def places(self, entry: dict) -> list[int]:
        """Numbers of the lines that an entry means."""
        lines = ["", *(line.strip() for line in (self.root / entry["file"]).read_text().splitlines())]
        behind = entry.get("behind")
        return [
            n
            for n in range(1, len(lines))
            if lines[n] == entry["line"] and (behind is None or lines[n - 1] == behind)
        ]

    def finds_zero(self, mutant: Mutant) -> bool:
        return self.fresh.is_same((self.root / mutant.file).read_text().splitlines(), mutant.number)

    def why(self, mutant: Mutant) -> str | None:
        """The reason, or None for a mutant that counts."""
        counted = COUNTED.search(mutant.before)
        if counted and mutant.after == mutant.before.replace(counted[0], counted[0].replace(" < ", " != ", 1)):
            return "a counter that grows by one from zero meets its bound"
        if mutant.before.endswith(" = true;") and mutant.after == mutant.before[: -len(" = true;")] + "+= true;":
            return "what true is added to is true"
        if mutant.after == mutant.before.replace(" = ", "+= ", 1) and self.finds_zero(mutant):
            return "what has just been made is zero"
        for e in self.entries:
            becomes = e["becomes"] if isinstance(e["becomes"], list) else [e["becomes"]]
            if e["file"] == mutant.file and mutant.after.strip() in becomes and mutant.number in self.places(e):
                return e["why"]
        return None
