#!/usr/bin/env python3
"""The mutation tool on a tiny project whose mutants are known: which are killed, which do not count, and that nothing
that it did is left in the sources or the build."""

import hashlib
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

import built  # noqa: E402
import mutants  # noqa: E402
import mutation  # noqa: E402
import trial  # noqa: E402


def fingerprint(folder: pathlib.Path) -> str:
    digest = hashlib.sha256()
    for file in sorted(f for f in folder.rglob("*") if f.is_file()):
        digest.update(str(file).encode() + file.read_bytes() + str(file.stat().st_mtime_ns).encode())
    return digest.hexdigest()


class Tiny(unittest.TestCase):
    """One build for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="mutation_test."))
        cls.root = cls.folder / "tiny"
        shutil.copytree(HERE / "tiny", cls.root)
        build = cls.folder / "build"
        subprocess.run(["cmake", "-S", str(cls.root), "-B", str(build), "-G", "Ninja"], check=True, capture_output=True)
        subprocess.run(["ninja", "-C", str(build)], check=True, capture_output=True)
        cls.built = built.Built(build)
        trial.LEAST_TIMEOUT = 2.0

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def mutant(self, file: str, before: str, after: str) -> mutants.Mutant:
        lines = (self.root / file).read_text().splitlines()
        number = next(k for k, line in enumerate(lines, 1) if before in line)
        line = lines[number - 1]
        return mutants.Mutant(file, number, line, line.replace(before, after), "by hand")

    def outcome(self, file: str, before: str, after: str) -> trial.Result:
        scratch = self.folder / "scratch"
        scratch.mkdir(exist_ok=True)
        trials = trial.Trials(self.built, self.root, scratch)
        return trials.run(self.mutant(file, before, after), ["area_test"], {"area_test": 0.01})

    def test_an_error_that_a_test_notices_is_killed_by_it(self):
        result = self.outcome("base/area.cpp", "width * height", "width + height")
        self.assertEqual((result.outcome, result.by, result.counts), ("killed", "area_test", True))

    def test_an_error_in_a_header_is_tried_in_everything_that_includes_it(self):
        self.assertEqual(self.outcome("base/area.hpp", "x / 2", "x / 3").outcome, "killed")

    def test_an_error_that_nothing_shows_survives_and_counts(self):
        result = self.outcome("base/area.cpp", "k = 1", "k = 0")
        self.assertEqual((result.outcome, result.tests, result.counts), ("survived", ["area_test"], True))

    def test_what_compiles_to_the_same_does_not_count(self):
        result = self.outcome("base/area.cpp", "unused = 7", "unused = 8")
        self.assertEqual((result.outcome, result.counts), ("same", False))

    def test_what_does_not_compile_does_not_count(self):
        result = self.outcome("base/area.cpp", "return sum;", "return summ;")
        self.assertEqual((result.outcome, result.counts), ("invalid", False))

    def test_what_would_not_be_linked_does_not_count(self):
        result = self.outcome("base/area.cpp", "area(int width, int height)", "area(long width, int height)")
        self.assertEqual((result.outcome, result.counts), ("invalid", False))

    def test_a_header_with_which_another_program_does_not_compile_does_not_count(self):
        result = self.outcome("base/area.hpp", "kSide = 4", "kSide = 5")
        self.assertEqual((result.outcome, result.counts), ("invalid", False))

    def test_a_header_with_which_any_file_of_a_test_does_not_compile_does_not_count(self):
        few, most, limit = trial.FEW, trial.MOST, trial.CHECK_LIMIT
        try:
            trial.FEW = trial.MOST = 1  # area.cpp, which compiles; area_test.cpp does not
            self.assertEqual(self.outcome("base/area.hpp", "kDepth = 2", "kDepth = 3").outcome, "invalid")
            trial.CHECK_LIMIT = -1.0
            self.assertEqual(self.outcome("base/area.hpp", "kDepth = 2", "kDepth = 3").outcome, "survived")
        finally:
            trial.FEW, trial.MOST, trial.CHECK_LIMIT = few, most, limit

    def test_what_is_in_no_test_is_untried_and_counts_if_it_compiles(self):
        result = self.outcome("base/main.cpp", "side() - kSide", "side() + kSide")
        self.assertEqual((result.outcome, result.counts), ("untried", True))
        self.assertEqual(self.outcome("base/main.cpp", "side() - kSide", "side() - kSides").outcome, "invalid")

    def test_a_program_that_does_not_end_is_killed(self):
        self.assertEqual(self.outcome("base/area.cpp", "++k", "--k, sum = 0, k = 0").outcome, "killed")

    def test_neither_sources_nor_build_are_changed(self):
        before = fingerprint(self.root), fingerprint(self.folder / "build")
        self.outcome("base/area.cpp", "width * height", "width - height")
        self.outcome("base/area.hpp", "x / 2", "x * 2")
        self.assertEqual((fingerprint(self.root), fingerprint(self.folder / "build")), before)
        self.assertEqual([f for f in (self.folder / "scratch" / "overlay").rglob("*") if f.is_file()], [])

    def test_a_listed_equivalent_is_known_with_its_reason(self):
        file = self.folder / "equivalent.toml"
        file.write_text('[[mutant]]\nfile = "base/area.cpp"\nline = "if (x > most) return most;"\n'
                        'becomes = "if (x >= most) return most;"\nwhy = "most is x then"\n')
        listed = mutants.Equivalents(self.root, file)
        self.assertEqual(listed.why(self.mutant("base/area.cpp", "x > most", "x >= most")), "most is x then")
        self.assertIsNone(listed.why(self.mutant("base/area.cpp", "x > most", "x < most")))

    def test_a_counter_from_zero_that_stops_at_its_bound_is_equivalent_and_one_from_elsewhere_is_not(self):
        listed = mutants.Equivalents(self.root, HERE / "equivalent.toml")

        def why(begin, sign):
            before = f"for (int k = {begin}; k < n; ++k) {{"
            return listed.why(mutants.Mutant("any.cpp", 1, before, before.replace(" < ", f" {sign} "), "by hand"))

        self.assertIsNotNone(why("0", "!="))
        self.assertIsNone(why("1", "!="))
        self.assertIsNone(why("0", "<="))

    def test_what_is_added_to_a_number_that_has_just_been_made_is_equivalent(self):
        (self.root / "base" / "reply.hpp").write_text("struct Reply {\n  int number{};\n  int rate{50};\n  Other other{};\n};\n")
        for body, same in [("  Reply r;\n  r.number = x;", True),
                           ("  Reply r;\n  r.rate = y;\n  r.number = x;", True),
                           ("  answer_t r{};\n  r.number = x;", True),
                           ("  answer_t r;\n  r.number = x;", False),
                           ("  Reply r;\n  r.rate = x;", False),
                           ("  Reply r;\n  r.other = x;", False),
                           ("  Unknown r;\n  r.number = x;", False),
                           ("  Reply r;\n  r.number = y;\n  r.number = x;", False),
                           ("  Reply r;\n  fill(r);\n  r.number = x;", False),
                           ("  Reply r;\n  r.reset(x);\n  r.number = y;", False),
                           ("  Reply r;\n  r.other.reset(x);\n  r.number = y;", False),
                           ("  Reply r;\n  const auto add = [&] {\n  r.number = x;", False),
                           ("  Reply r;\n  const auto add = [=]() mutable {\n  r.number = x;", False),
                           ("  Reply r;\n  for (int y : all) {\n  r.number = x;", False),
                           ("  Reply r;\n}\nvoid g() {\n  r.number = x;", False),
                           ("  return r;\n  r.number = x;", False)]:
            text = "void f() {\n" + body + "\n}\n"
            (self.root / "base" / "made.cpp").write_text(text)
            before = text.split("\n")[-3]
            number = max(k for k, line in enumerate(text.split("\n"), 1) if line == before)
            listed = mutants.Equivalents(self.root, HERE / "equivalent.toml")
            made = mutants.Mutant("base/made.cpp", number, before, before.replace(" = ", "+= "), "by hand")
            self.assertEqual(listed.why(made) is not None, same, body)
            other = mutants.Mutant("base/made.cpp", number, before, before.replace(" = ", "-= "), "by hand")
            self.assertIsNone(listed.why(other), body)
        (self.root / "base" / "reply.hpp").unlink()
        (self.root / "base" / "made.cpp").unlink()

    def test_what_true_is_added_to_is_true(self):
        listed = mutants.Equivalents(self.root, HERE / "equivalent.toml")

        def why(before, after):
            return listed.why(mutants.Mutant("base/area.cpp", 1, before, after, "by hand"))

        self.assertIsNotNone(why("  taken_ = true;", "  taken_+= true;"))
        self.assertIsNone(why("  taken_ = true;", "  taken_ = false;"))
        self.assertIsNone(why("  taken_ = false;", "  taken_+= false;"))

    def test_a_listed_equivalent_is_told_from_an_equal_line_by_the_line_before(self):
        file = self.folder / "equivalent.toml"
        file.write_text('[[mutant]]\nfile = "base/area.cpp"\nline = "}"\nbehind = "return x;"\n'
                        'becomes = ["};", "} ;"]\nwhy = "the end of clipped()"\n')
        listed = mutants.Equivalents(self.root, file)
        lines = (self.root / "base/area.cpp").read_text().splitlines()
        known = [n for n, line in enumerate(lines, 1) if line == "}"
                 and listed.why(mutants.Mutant("base/area.cpp", n, "}", "} ;", "by hand"))]
        self.assertEqual(known, [lines.index("  return x;") + 2])


class Sample(unittest.TestCase):
    """The order of a seed, and the rules."""

    @classmethod
    def setUpClass(cls):
        try:
            mutation.find_universalmutator(mutation.ROOT / "build" / "mutation")
        except RuntimeError as e:
            raise unittest.SkipTest(str(e)) from e

    def draw(self, seed: str):
        return list(mutants.sample(HERE / "tiny", ["base/area.cpp", "base/area.hpp"], seed))

    def test_is_the_same_for_a_seed_and_another_for_another_seed(self):
        self.assertEqual(self.draw("1"), self.draw("1"))
        self.assertNotEqual(self.draw("1"), self.draw("2"))
        self.assertEqual({m.key for m in self.draw("1")}, {m.key for m in self.draw("2")})

    def test_has_boundaries_signs_and_removed_statements_and_no_comment(self):
        found = {(m.before.strip(), m.after.strip()) for m in self.draw("1")}
        self.assertIn(("if (x > most) return most;", "if (x >= most) return most;"), found)
        self.assertIn(("return width * height;", "return width + height;"), found)
        self.assertIn(("for (int k = 1; k <= n; ++k) sum += k;", "for (int k = 1; k <= n; ++k) sum -= k;"), found)
        self.assertIn(("int sum = 0;", "/*int sum = 0;*/"), found)
        for before, _ in found:
            self.assertFalse(before.startswith(("//", "#")), before)

    def test_has_the_lines_behind_a_brace_and_a_minus(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "corner.cpp"
            file.write_text("const int corner[]{-1, 2};\nint twice(int x) {\n  return x + x;\n}\n")
            found = mutants.mutants_of(file.parent, file.name)
        self.assertLessEqual({1, 3}, {m.number for m in found})
        self.assertIn(("const int corner[]{-1, 2};", "const int corner[]{-1, (2+1)};"), {(m.before, m.after) for m in found})

    def test_text_for_people_is_not_code(self):
        self.assertFalse(mutants.changes_code('  say("a + b");', '  say("a - b");'))
        self.assertFalse(mutants.changes_code("  x = 1;  // + 2", "  x = 1;  // - 2"))
        self.assertTrue(mutants.changes_code('  say("a", x + 1);', '  say("a", x - 1);'))

    def test_every_listed_equivalent_is_still_in_the_sources(self):
        listed = mutants.Equivalents(mutation.ROOT)
        for entry in listed.entries:
            self.assertEqual(len(listed.places(entry)), 1, f"{entry['file']}: {entry['line']}: say which, with `behind`")
            self.assertTrue(entry["why"], entry["line"])

    def test_every_file_of_an_area_and_every_test_program_is_there(self):
        programs = "".join(f.read_text() for f in (mutation.ROOT / "test").rglob("CMakeLists.txt"))
        for name, area in mutation.read_areas().items():
            self.assertTrue(mutants.files_of(mutation.ROOT, area), name)
            for test in area["tests"]:
                self.assertIn(f"mrroc_test({test} ", programs.replace("\n", " "))
            for pattern in area["sources"]:
                self.assertTrue(list(mutation.ROOT.glob(pattern)), pattern)


class Scores(unittest.TestCase):
    """What is made of outcomes."""

    def test_are_by_area_of_all_and_of_the_worst(self):
        def entries(*outcomes):
            return [{"outcome": o} for o in outcomes]

        figures = mutation.scores({"edp": entries("killed", "killed", "killed", "survived"),
                                   "vsp": entries("killed", "untried"), "base": []})
        self.assertEqual(figures, {"mutation_score_edp_pct": 75.0, "mutation_score_vsp_pct": 50.0,
                                   "mutation_score_worst_pct": 50.0, "mutation_score_pct": 66.7})


if __name__ == "__main__":
    unittest.main()
