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

    def test_installed_package_needs_no_clone(self):
        lacking = [name for name in ("pip", "setuptools", "wheel") if importlib.util.find_spec(name) is None]
        if lacking:
            self.skipTest(f"not installed: {', '.join(lacking)}")
        clone, target = self.home / "clone", self.home / "installed"  # pip writes into the folder that it installs
        skip = shutil.ignore_patterns("__pycache__", "build", "*.egg-info")
        for part in ("ui_cli/python", "base/msg"):
            shutil.copytree(SOURCE / part, clone / part, ignore=skip)
        pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-build-isolation", "--no-deps"]
        subprocess.run([*pip, "--target", target, "./ui_cli/python"], check=True, cwd=clone)
        shutil.rmtree(clone)
        program = "import sys, mrroc_runs as m; print(m.__file__, len(m.open_run(sys.argv[1]).messages('arm1.reply')['step']))"
        env = {k: v for k, v in os.environ.items() if k != "MRROC_MSG"} | {"PYTHONPATH": str(target)}
        said = subprocess.run(
            [sys.executable, "-c", program, self.folder], check=True, cwd=self.home, env=env, stdout=subprocess.PIPE
        ).stdout.decode()
        self.assertEqual(said.split(), [str(target / "mrroc_runs/__init__.py"), str(self.run_.channels()["arm1.reply"])])

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
