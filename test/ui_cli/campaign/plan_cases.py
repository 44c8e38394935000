"""What a campaign is going to run, and what it refuses to."""

import os
import random
import shutil
import socket
import subprocess
import sys

from place import Place

from mrroc_campaign import bars, plan as plans, vary
from mrroc_campaign.errors import CampaignError
from mrroc_campaign.plan import Plan
from mrroc_campaign.program import Parameter

KNOWN = {
    p.key: p
    for p in (
        Parameter("a.number", "4.0", "1 to 10", "N"), Parameter("a.count", "3", "1 to 9", ""), Parameter("a.word", '"none"', "none or some", ""),
        Parameter("a.list", "[0.0, 1.0]", "", ""), Parameter("a.flag", "true", "", ""),
    )
}  # fmt: skip


class Plans(Place):
    def test_plan_is_the_same_again_and_every_value_fills_its_range_evenly(self):
        cases = random.Random(1)
        for _ in range(30):
            runs, low = cases.randint(2, 60), cases.uniform(-5, 5)
            texts = [
                f"a.number={low!r}:{low + cases.uniform(0.1, 9)!r}",
                f"a.count=1:{cases.randint(2, 9)}",
                "a.word=none,some",
            ]
            varied = [vary.parse(t, KNOWN) for t in texts]
            plan = Plan("hop", f"1:{runs}", method=cases.choice(plans.METHODS), plan_seed=cases.randint(0, 999))
            rows = plans.rows(plan, varied)
            self.assertEqual(rows, plans.rows(plan, varied))
            self.assertEqual([r.run for r in rows], list(range(runs)))
            lowest, highest = varied[0].numbers
            places = sorted((float(r.settings["a.number"]) - lowest) / (highest - lowest) for r in rows)
            self.assertTrue(0 <= places[0] and places[-1] <= 1)
            if plan.method == "lhs":  # one in each of as many parts as there are runs
                for k, place in enumerate(places):
                    self.assertTrue(k / runs - 1e-9 <= place <= (k + 1) / runs + 1e-9)
            self.assertTrue(all(1 <= int(r.settings["a.count"]) <= varied[1].numbers[1] for r in rows))
            other = plans.rows(Plan("hop", f"1:{runs}", method=plan.method, plan_seed=plan.plan_seed + 1), varied)
            self.assertNotEqual([r.settings for r in rows], [r.settings for r in other])

    def test_whole_numbers_and_words_come_equally_often(self):
        varied = [
            vary.parse("a.count=2:5", KNOWN),
            vary.parse("a.word=none,some", KNOWN),
            vary.parse("a.list=[1, 2],[3],[4]", KNOWN),
        ]
        rows = plans.rows(Plan("hop", "1:120"), varied)
        for key, values in (("a.count", "2345"), ("a.word", ("none", "some")), ("a.list", ("[1, 2]", "[3]", "[4]"))):
            for value in values:
                self.assertEqual(sum(r.settings[key] == value for r in rows), 120 / len(values), (key, value))

    def test_a_value_that_stands_twice_comes_twice_as_often(self):
        rows = plans.rows(Plan("hop", "1:120"), [vary.parse("a.word=none,none,some", KNOWN)])
        self.assertEqual(sum(r.settings["a.word"] == "none" for r in rows), 80)

    def test_normal_values_have_their_mean_and_deviation(self):
        rows = plans.rows(Plan("hop", "1:400"), [vary.parse("a.number=normal(5,0.5)", KNOWN)])
        x = [float(r.settings["a.number"]) for r in rows]
        mean = sum(x) / len(x)
        self.assertAlmostEqual(mean, 5, delta=0.01)
        self.assertAlmostEqual((sum((v - mean) ** 2 for v in x) / len(x)) ** 0.5, 0.5, delta=0.02)

    def test_values_are_read_back_to_the_last_bit(self):
        variation, cases = vary.parse("a.number=1e-9:3e5", KNOWN), random.Random(2)
        for _ in range(200):
            text = variation.value(cases.random())
            self.assertEqual(repr(float(text)), text)

    def test_what_cannot_be_meant_is_refused(self):
        for text in (
            "a.number", "a.number=", "a.number=1", "a.number=2:1", "a.number=1:x", "a.number=nan:1", "a.number=normal(1,0)", "a.number=1,1",
            "a.count=1.5:3", "a.word=1:2", "a.word=none", "a.list=1:2", "a.list=normal(1,2)", "b=1:2",
        ):  # fmt: skip
            with self.assertRaises(CampaignError, msg=text):
                vary.parse(text, KNOWN)
        too_large = (f"{2**63}:{2**63 + 1}", "1,99999999999999999999")
        for text in ("", "1", "5:1", "1:99999999", "1,1", "a", "-1:3", *too_large):
            if text != "1":
                with self.assertRaises(CampaignError, msg=text):
                    plans.seeds_of(text)
        self.assertEqual(plans.seeds_of("3:5"), [3, 4, 5])

    def test_wrong_line_is_refused_in_one_line_before_anything_is_made(self):
        file = self.home / "plants.txt"
        file.write_text("# remark\n\n--vary task.force=1:80  # too far\n")
        for words, told in (
            (["--vary", "task.forc=1:2"], "did you mean 'task.force'?"),
            (["--vary", "task.force=1:80"], "out of its range: 1 to 10"),
            (["--vary", "sim.mode=plain,smooth"], "must be plain or rough"),
            (["--vary", "seed=1:2"], "use --seeds"),
            (["--vary", "robots.arm1.hardware=a,b"], "no input of a simulation"),
            (["--vary", "task.force=1:2", "--vary", "task.force=1:3"], "twice"),
            (["--stop-when", "2"], "--stop-when"),
            (["--resume", "nowhere"], "name two folders"),
            (["--", "--seed", "3"], "--seed is given to each run by the campaign"),
            (["--", "--wrong"], "unknown option --wrong"),
            (["--", "--parameters"], "--parameters makes no run; type: ./run hop --parameters"),
            (["--", "-h"], "-h makes no run"),
            (["--", "--check=a"], "--check makes no run"),
            (["--seeds", "5:6"], "--seeds is there twice, as 1:3 and as 5:6"),
            (["--workers", "0"], "'0' is no whole number above 0"),
            (["--stop-when", "0"], "'0' is no width of the interval"),
            (["--vary", "task.force=1:80"], "--vary task.force=1:80: "),
            (["--vary", "task.force=normal(4,100)"], "--vary task.force=normal(4,100): "),
            (["--vary", "task.force=normal(4)"], "write normal(M,S)"),
            (["--vary", "sim.mode=1:2"], "'sim.mode' takes words: plain or rough"),
            (["--vary", "task.force=2:8", "--", "--set", "task.force=6"], "both name 'task.force'"),
            (["--frobnicate"], "options of the task stand behind --"),
            (["--on", "here"], "--on here: write local"),
            (["@nowhere.txt"], "nowhere.txt"),
            ([f"@{file}"], f"{file}:3: --vary task.force=1:80: out of its range: 1 to 10"),
        ):  # fmt: skip
            said = self.command("hop", "--seeds", "1:3", "--dir", "c", *words, status=2).strip()
            self.assertEqual(len(said.splitlines()), 1, said)
            self.assertRegex(said, "^error: bad_(usage|configuration): ")
            self.assertIn(told, said)
            self.assertNotIn("--set task.force=1", said)  # nobody typed it
            self.assertFalse((self.home / "c").exists())
        self.assertIn("--seeds -3:3: write", self.command("hop", "--seeds", "-3:3", status=2))
        for word, meant in (("hopp", "hop"), ("cmpare", "compare"), ("schedular", "scheduler")):
            self.assertIn(f"no task named '{word}'", said := self.command(word, "A", "B", status=2))
            self.assertIn(f"did you mean '{meant}'?", said)

    def test_file_of_words_that_cannot_be_read_is_told_with_its_line(self):
        for text, told in (
            (b"--seeds 1:2\n--vary 'task", "words.txt:2: a quotation mark"),
            (b"\n\xff\xfe\n", "words.txt:2: this is no text"),
            (b"a\0b", "words.txt:1: this is no text"),
            (b"# begins\n@words.txt", "words.txt:2: @words.txt contains itself"),
            (b"@nowhere", "words.txt:1: @nowhere cannot be read"),
            (b"--seeds 1:2 --\n--strict", "words.txt:1: -- and options of the task stand on the line"),
        ):
            (self.home / "words.txt").write_bytes(text)
            said = self.command("hop", "@words.txt", status=2).strip()
            self.assertEqual(len(said.splitlines()), 1, said)
            self.assertIn(f"error: bad_usage: {told}", said)
        (self.home / "words.txt").write_text("--seeds 1:2 @more.txt\n")
        (self.home / "more.txt").write_text("--vary task.force=1:3 # remark\r\n--dir 'a b'\n")
        self.command("hop", "@words.txt", "--workers", 1)
        self.assertEqual(len(self.counted("a b")), 2)

    def test_task_that_waits_for_a_person_is_refused_unless_a_script_does_what_he_would(self):
        shutil.copy(self.programs / "hop", self.programs / "manual")
        line = ("manual", "--seeds", "1:2", "--dir", "c")
        self.assertIn("give it a script: -- --words FILE", self.command(*line, status=2))
        self.assertIn("unknown option --words", self.command(*line, "--", "--words", "a", status=2))  # as far as hop

    def test_what_is_no_task_no_folder_and_no_address_is_told_in_one_line(self):
        for name, text in (("talks", "#!/bin/sh\necho hello"), ("lists", "#!/bin/sh\necho '[1]'"), ("broken", "nothing")):
            (self.programs / name).write_text(text)
            (self.programs / name).chmod(0o755)
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            for words, told in (
                (["talks", "--seeds", "1:2"], "does not tell its parameters as a task does"),
                (["lists", "--seeds", "1:2"], "does not tell its parameters as a task does"),
                (["broken", "--seeds", "1:2"], "does not tell its parameters as a task does"),
                (["hop", "--seeds", "1:2", "--dir", self.programs / "hop"], "is a file; choose another --dir"),
                (["scheduler", "--port", 65536], "--port takes"),
                (["scheduler", "--port", taken.getsockname()[1]], "nobody can listen on 127.0.0.1"),
                (["scheduler", "--key-file", "nowhere/key"], "the key cannot be written"),
            ):
                said = self.command(*words, status=2).strip()
                self.assertEqual(len(said.splitlines()), 1, said)
                self.assertRegex(said, "^error: bad_usage: ")
                self.assertIn(told, said)

    def test_what_is_wanted_is_told_and_a_value_takes_its_share(self):
        for wanted, told, value, share in (
            ((3.5, 4.5), "4 +- 0.5", 4.25, 0.5),
            ((None, 0.001), "<= 0.001", 0.0005, 0.5),
            ((2, None), ">= 2", 4, 0.5),
            ((0, 0), "0", 1, None),
            ((None, 1e-320), "<= 9.99989e-321", 1e90, None),
            ((None, None), "", 1, None),
        ):
            self.assertEqual(bars.text(wanted), told)
            self.assertEqual(bars.share(value, wanted), share)

    def test_help_needs_no_packages_and_all_else_names_those_that_are_missing(self):
        lacking = "import sys; sys.modules.update(dict.fromkeys(('distributed', 'dask', 'scipy', 'numpy', 'optuna', 'tqdm')))\n"
        called = lacking + "from mrroc_campaign.command import main; sys.exit(main(sys.argv[1:]))"

        def run(*words: str) -> subprocess.CompletedProcess:
            path = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
            return subprocess.run([sys.executable, "-c", called, *words], env=path, capture_output=True, text=True)

        for command in ("", "press", "compare", "tune", "page", "scheduler", "worker"):
            with self.subTest(command):
                asked = run(*command.split(), "--help")
                self.assertEqual((asked.returncode, asked.stderr), (0, ""))
        for words in ("scheduler", "worker tcp://127.0.0.1:1", "compare a b", "hop --seeds 1:2"):
            with self.subTest(words):
                asked = run(*words.split())
                self.assertEqual(asked.returncode, 2, asked.stderr)
                self.assertIn("error: missing_packages: there is no Python module", asked.stderr)
                self.assertIn("apt-get install python3-distributed", asked.stderr)
