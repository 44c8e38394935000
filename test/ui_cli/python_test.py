"""The Python reader of run folders, on a run of the task press. Usage: python_test.py SOURCE_DIR BIN_DIR"""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import numpy as np
except ImportError:
    print("skipped: numpy is not installed (python3-numpy)")
    sys.exit(77)

SOURCE, BIN = Path(sys.argv[1]), Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "ui_cli" / "python"))
import mrroc_runs  # noqa: E402
from mrroc_runs import lcm_types  # noqa: E402


class Reader(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = Path(tempfile.mkdtemp(prefix="mrroc_runs."))
        cls.folder = cls.home / "runs" / "press-1"
        subprocess.run(
            [BIN / "press", "--processes", "one", "--run-dir", cls.folder], check=True, stdout=subprocess.DEVNULL
        )
        cls.run_ = mrroc_runs.open_run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.home)

    def test_tables_and_messages_agree(self):
        arm, report = self.run_.arm(1), self.run_.messages("arm1.report")
        force = dict(zip(report["header.stamp"], report["F_a"][:, 2], strict=True))
        together = [(row, force[i]) for i, row in zip(arm["i"].astype(int), arm["Fz"], strict=True) if i in force]
        self.assertGreater(len(together), 400)
        for row, logged in together:
            self.assertAlmostEqual(row, logged, places=3)

    def test_every_channel_can_be_read(self):
        for channel, count in self.run_.channels().items():
            for name, values in self.run_.messages(channel).items():
                self.assertEqual(len(values), count, f"{channel} {name}")
                self.assertTrue(values.dtype.isnative)

    def test_figures_can_be_computed_anew(self):
        arm = self.run_.arm(1)
        settled = arm["Fz"][(arm["m"] == 2) & (arm["t"] > arm["t"][arm["m"] == 2].max() - 1.0)]
        self.assertAlmostEqual(float(np.mean(settled)), self.run_.summary["figures"]["approach_settled_N"], places=3)

    def test_configuration_and_log_are_there(self):
        self.assertEqual(self.run_.config["robots"]["order"], ["arm1"])
        self.assertTrue(any(line["process"] == "mp" for line in self.run_.log()))

    def test_newest_run_is_found(self):
        self.assertEqual(mrroc_runs.newest_run(self.home / "runs", "press").folder, self.folder)
        with self.assertRaises(FileNotFoundError):
            mrroc_runs.newest_run(self.home / "runs", "drawing")

    def test_what_is_no_run_folder_is_refused(self):
        with self.assertRaises(FileNotFoundError):
            mrroc_runs.open_run(self.home)

    def test_unknown_channel_names_those_that_are(self):
        with self.assertRaisesRegex(KeyError, "arm1.reply"):
            self.run_.messages("arm9.reply")

    def test_messages_of_other_definitions_are_refused(self):
        other = self.home / "msg"
        shutil.copytree(SOURCE / "base" / "msg", other)
        reply = other / "effector_reply_t.lcm"
        reply.write_text(reply.read_text().replace("int64_t step", "int64_t stage"))
        with self.assertRaisesRegex(ValueError, "another version"):
            mrroc_runs.open_run(self.folder, other).messages("arm1.reply")

    def test_fields_without_a_fixed_size_are_refused(self):
        with self.assertRaises(ValueError):
            lcm_types.parse("struct a_t {\n int32_t n;\n double x[n];\n}")

    def test_reads_messages_where_pip_has_installed_it(self):
        for needed in ("pip", "setuptools", "wheel"):
            if importlib.util.find_spec(needed) is None:
                self.skipTest(f"{needed} is not installed (python3-{needed})")
        clone, place = self.home / "clone", self.home / "installed"
        for part in ("ui_cli/python", "base/msg"):  # pip leaves its own files beside what it installs
            shutil.copytree(SOURCE / part, clone / part, symlinks=True)
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps"]
        subprocess.run([*pip, "--target", place, clone / "ui_cli" / "python"], check=True)
        shutil.rmtree(clone)
        script = (
            "import mrroc_runs, sys; run = mrroc_runs.open_run(sys.argv[1]); "
            "print(mrroc_runs.__file__, len(run.messages('arm1.reply')['F_a']))"
        )
        elsewhere = {k: v for k, v in os.environ.items() if k != "MRROC_MSG"} | {"PYTHONPATH": str(place)}
        ask = [sys.executable, "-c", script, self.folder]
        told = subprocess.run(ask, cwd=place, env=elsewhere, check=True, capture_output=True, text=True).stdout.split()
        self.assertTrue(Path(told[0]).is_relative_to(place), told[0])
        self.assertEqual(int(told[1]), self.run_.channels()["arm1.reply"])

    def test_message_that_came_late_stands_where_it_was_sent(self):
        late = self.home / "late"
        shutil.copytree(self.folder, late)
        log, channel = late / "events.lcmlog", "arm1.reply"
        data = log.read_bytes()
        events, at = [], 0
        for event in mrroc_runs.lcm_log.events(log):
            size = 28 + len(event.channel) + len(event.data)
            events.append((event.channel.split(".", 1)[1], data[at : at + size]))
            at += size
        of_channel = [k for k, (name, _) in enumerate(events) if name == channel]
        events.append(events.pop(of_channel[5]))
        log.write_bytes(b"".join(event for _, event in events))
        run = mrroc_runs.open_run(late)
        for field, values in self.run_.messages(channel).items():
            np.testing.assert_array_equal(run.messages(channel)[field], values, field)

    def test_example_works_from_any_folder_with_the_run_that_is_named_or_the_newest(self):
        example = [sys.executable, SOURCE / "ui_cli" / "python" / "example.py"]

        def ask(words, folder):
            return subprocess.run([*example, *words], cwd=folder, capture_output=True, text=True)

        named = ask([self.folder], "/")
        self.assertEqual(named.returncode, 0, named.stderr)
        self.assertIn("approach_settled_N", named.stdout)
        self.assertIn("arm1.reply", named.stdout)
        self.assertEqual(ask([], self.home).stdout, ask(["runs/press-1"], self.home).stdout)
        for words, folder, told in (([], "/", "there is no run in /runs"), ([self.home], "/", "is no run folder")):
            none = ask(words, folder)
            self.assertEqual(none.returncode, 2)
            self.assertIn(told, none.stderr)
            self.assertTrue(none.stderr.strip().endswith("name a run folder: example.py RUN"), none.stderr)

    def test_log_that_was_cut_off_gives_what_is_whole(self):
        cut = self.home / "cut"
        shutil.copytree(self.folder, cut)
        log = cut / "events.lcmlog"
        size = log.stat().st_size
        os.truncate(log, size - 7)
        whole, part = self.run_.channels(), mrroc_runs.open_run(cut).channels()
        self.assertEqual(sum(whole.values()), sum(part.values()) + 1)
        with log.open("r+b") as file:
            file.write(b"xxxx")
        with self.assertRaises(ValueError):
            mrroc_runs.open_run(cut).channels()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
