"""Campaigns that are carried out: whatever is killed, restarted or full, every run is counted once."""

import json
import os
import random
import re
import shlex
import signal
import socket
import subprocess
import time
from html.parser import HTMLParser

from place import BIN, Place, children, is_alive, kill

from mrroc_campaign import hosts
from mrroc_campaign.command import main
from mrroc_campaign.errors import CampaignError

_VARIED = ("--vary", "task.force=4:10", "--vary", "sim.mode=plain,rough", "--vary", "sim.steps=1:20")
_COLUMNS = {
    "run", "seed", "success", "outcome", "fault", "text", "exit_status", "log_hash", "sim_s", "wall_s", "host", "folder", "bars",
    "task.force", "sim.mode", "sim.steps", "height_m", "force_N[0]", "force_N[1]", "figure run",
}  # fmt: skip


def free_port() -> int:
    """One that nobody listens on."""
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Page(HTMLParser):
    """What a page loads from elsewhere, its text, and its tags that were not closed."""

    def __init__(self, text: str):
        super().__init__()
        self.loads, self.text, self._open = [], "", []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.loads += [v for k, v in attrs if k in ("src", "href") and not v.startswith("kept/")]
        if tag != "meta":
            self._open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.loads += [v for k, v in attrs if k in ("src", "href")]

    def handle_endtag(self, tag):
        assert self._open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data


class Campaigns(Place):
    def test_results_are_the_same_whoever_carries_them_out_and_in_which_order(self):
        said = self.command("hop", "--seeds", "1:24", *_VARIED, "--dir", "a", "--workers", 2)
        self.assertIn("24 of 24 runs", said)
        self.command("hop", "--seeds", "1:24", *_VARIED, "--dir", "b", "--workers", 1)
        a, b = self.counted("a"), self.counted("b")
        for x, y in zip(a, b, strict=True):
            for name in ("wall_s", "host"):
                x.pop(name), y.pop(name)
        self.assertEqual(a, b)
        self.assertEqual({*self.counted("a")[0]}, _COLUMNS)
        for r in a:
            slipped = r["task.force"] > 7 and r["sim.mode"] == "rough"
            self.assertEqual(
                (r["success"], r["fault"], r["height_m"] is None), (0, "slipped", True) if slipped else (1, "", False)
            )
            self.assertEqual(r["force_N[1]"], 2 * r["task.force"])
            self.assertEqual(json.loads(r["bars"]), {"height_m": [None, 0.1]})
        self.assertIn("slipped", said)
        # The folders of failed runs are kept, and no others.
        kept = sorted(p.name for p in (self.home / "a" / "kept").iterdir())
        self.assertEqual(kept, [f"{r['run']:06d}" for r in a if not r["success"]])
        self.assertTrue(all((self.home / "a" / "kept" / name / "run" / "summary.json").is_file() for name in kept))
        self.assertFalse((self.home / "a" / "scratch").exists())

    def test_page_needs_nothing_else_and_each_of_its_lines_repeats_its_failure_bit_for_bit(self):
        self.command("hop", "--seeds", "1:30", *_VARIED, "--dir", "a")
        text = (self.home / "a" / "page.html").read_text()
        page = Page(text)
        self.assertEqual(page.loads, [])
        self.assertNotIn("<b>it</b> slipped", text)  # what a run says is text
        self.assertIn("<b>it</b> slipped", page.text)
        failed = [r for r in self.counted("a") if not r["success"]]
        self.assertTrue(failed)
        lines = re.findall(r"\./run hop --seed[^<]*?(?=[0-9a-f]{16}kept)", page.text)
        self.assertEqual(len(lines), len(failed))
        for line, r in zip(lines, failed, strict=True):
            words = shlex.split(line)
            again = self.home / f"again-{r['run']}"
            subprocess.run([self.programs / "hop", *words[2:], "--run-dir", again], capture_output=True, check=False)
            self.assertEqual(json.loads((again / "summary.json").read_text())["log_hash"], r["log_hash"])

    def test_line_of_the_page_repeats_a_run_of_press_bit_for_bit(self):
        os.environ["MRROC_PROGRAMS"], self.programs = str(BIN), BIN
        varied = (
            "--vary",
            "task.force=2:2.7",
            "--vary",
            "sim.paper.stiffness=20000:800000",
            "--vary",
            "sim.sensor.force_noise=0.9:1",
        )
        for folder, outcome, options in (("a", "done", ()), ("b", "fault", ("--", "--max-time", "4"))):
            self.command("press", "--seeds", "7:8", *varied, "--dir", folder, *options)
            rows, text = self.counted(folder), Page((self.home / folder / "page.html").read_text()).text
            self.assertEqual([(r["outcome"], r["success"]) for r in rows], [(outcome, 0)] * 2)
            for r in rows:
                line = shlex.split(re.search(rf"\./run press --seed {r['seed']} [^<]*?(?={r['log_hash']})", text)[0])
                again = self.home / f"again-{folder}-{r['run']}"
                subprocess.run([BIN / "press", *line[2:], "--run-dir", again], capture_output=True, check=False)
                compare = [BIN / "ui_cli", "log", "compare", self.home / folder / r["folder"] / "run", again, "--json"]
                found = json.loads(subprocess.run(compare, capture_output=True, check=False).stdout)
                self.assertGreater(found["compared"], 1000)
                self.assertEqual(found["differences"], 0)
                if outcome == "done":
                    kept = self.home / folder / r["folder"] / "run"
                    pictures = [{p.name for p in (f / "plots").glob("*.png")} for f in (again, kept)]
                    self.assertEqual(*pictures)  # drawn behind the run, for its folder is kept
                    self.assertEqual(json.loads((again / "summary.json").read_text())["log_hash"], r["log_hash"])

    def test_workers_that_are_killed_at_random_moments_lose_nothing_and_count_nothing_twice(self):
        line = ("hop", "--seeds", "1:60", *_VARIED, "--workers", 2)
        self.command(*line, "--dir", "calm", "--", "--set", "sim.sleep=0.02")
        cases = random.Random(11)
        process, kills = self.start(*line, "--dir", "rough", "--", "--set", "sim.sleep=0.02"), 0
        self.await_runs("rough", 2, process)
        while process.poll() is None:
            if workers := children(process.pid, "worker"):
                kill([cases.choice(workers)])
                kills += 1
            time.sleep(cases.uniform(0.5, 2.5))
        said = "\n".join(process.communicate())
        self.assertEqual(process.returncode, 0, said)
        self.assertGreater(kills, 0)
        self.assertEqual(self.hashes("rough"), self.hashes("calm"))

    def test_campaign_that_is_killed_at_random_moments_goes_on_where_it_was(self):
        line = ("hop", "--seeds", "1:40", *_VARIED, "--workers", 2)
        self.command(*line, "--dir", "calm")
        cases, words = random.Random(12), (*line, "--dir", "rough")
        for _ in range(4):
            process = self.start(*words)
            words = ("--resume", "rough")
            self.await_runs("rough", 1 + (len(self.counted("rough")) if (self.home / "rough").exists() else 0), process)
            time.sleep(cases.uniform(0, 0.4))
            before = process.poll() is None
            kill([process.pid])
            process.communicate()
            self.assertTrue(before or process.returncode == 0)
        self.command("--resume", "rough")
        self.assertEqual(self.hashes("rough"), self.hashes("calm"))
        deadline = time.monotonic() + 10
        while is_alive(str(self.home)) and time.monotonic() < deadline:
            time.sleep(0.1)
        self.assertFalse(is_alive(str(self.home)), "a worker or a run has outlived its campaign")
        before = self.counted("rough")
        self.command(*line, "--resume", "rough")  # nothing is left to do
        others = (("hop", "--seeds", "1:41"), ("--stop-when", "0.3"), ("--timeout", "9"), ("--processes", "separate"))
        for words in others:
            self.assertIn("rough began as: ", self.command(*words, "--resume", "rough", status=2))
        self.assertEqual(self.counted("rough"), before)

    def test_interrupted_campaign_ends_its_runs_and_tells_the_line_that_goes_on(self):
        process = self.start("hop", "--seeds", "1:30", "--dir", "c d", "--workers", 2, "--", "--set", "sim.sleep=0.2")
        self.await_runs("c d", 3, process)
        os.killpg(process.pid, signal.SIGINT)
        said = "\n".join(process.communicate(timeout=400))
        self.assertEqual(process.returncode, 130, said)
        self.assertFalse(is_alive(str(self.home)))
        again = shlex.split(re.search(r"to go on: \./run campaign (.*)", said)[1])
        self.assertEqual(again, ["--resume", "c d"])
        kept = self.hashes("c d")
        self.assertTrue(3 <= len(kept) < 30)
        self.command(*again)
        self.assertEqual(len(self.hashes("c d")), 30)
        self.assertTrue(set(kept) <= set(self.hashes("c d")))

    def test_full_disk_ends_the_campaign_with_one_clear_error_and_loses_nothing(self):
        self.command("hop", "--seeds", "1:80", "--dir", "calm")
        # No file of the campaign may become larger than this, as if the disk were full.
        small = ("sh", "-c", 'ulimit -f 48; exec "$@"', "_")
        said = self.command("hop", "--seeds", "1:80", "--dir", "full", status=3, before=small)
        self.assertIn("error: cannot_write: full cannot be written", said)
        self.assertIn("to go on: ./run campaign --resume full", said)
        kept = self.hashes("full")
        self.assertTrue(0 < len(kept) < 80)
        self.command("--resume", "full")
        self.assertEqual(self.hashes("full"), self.hashes("calm"))
        self.assertTrue(set(kept) <= set(self.hashes("full")))

    def test_scheduler_that_is_killed_and_started_again_loses_nothing(self):
        self.command("hop", "--seeds", "1:60", *_VARIED, "--dir", "calm")
        port = free_port()
        address, key = f"tls://127.0.0.1:{port}", ("--key-file", "hop.key")
        scheduler = self.start("scheduler", "--port", port, *key)
        while not (self.home / "hop.key").exists():
            time.sleep(0.02)
        self.start("worker", address, "--workers", 2, *key)
        process = self.start(
            "hop", "--seeds", "1:60", *_VARIED, "--dir", "rough", "--on", address, *key, "--", "--set", "sim.sleep=0.05"
        )
        for number in (3, 15):
            self.await_runs("rough", number, process)
            kill([scheduler.pid])
            time.sleep(0.5)
            scheduler = self.start("scheduler", "--port", port, *key)
        said = "\n".join(process.communicate(timeout=400))
        self.assertEqual(process.returncode, 0, said)
        self.assertEqual([run for run, _ in self.hashes("rough")], list(range(60)))
        # What a worker elsewhere keeps of a failed run comes to the one who asked.
        failed = [r for r in self.counted("rough") if not r["success"]]
        self.assertTrue(failed)
        for r in failed:
            self.assertTrue((self.home / "rough" / r["folder"] / "run" / "summary.json").is_file())

    def test_nobody_listens_to_the_network(self):
        process = self.start("hop", "--seeds", "1:9", "--dir", "a", "--workers", 2, "--", "--set", "sim.sleep=1")
        self.await_runs("a", 1, process)
        pids = [process.pid, *children(process.pid, "worker")]
        inodes = set()
        for pid in pids:
            for link in os.listdir(f"/proc/{pid}/fd"):
                try:
                    inodes.add(os.readlink(f"/proc/{pid}/fd/{link}"))
                except OSError:
                    pass
        listening = []
        for table in ("tcp", "tcp6"):
            with open(f"/proc/net/{table}") as file:
                rows = [line.split() for line in file.readlines()[1:]]
            listening += [r[1] for r in rows if r[3] == "0A" and f"socket:[{r[9]}]" in inodes]
        self.assertGreater(len(listening), 0)
        self.assertEqual({a.split(":")[0] for a in listening}, {"0100007F"}, listening)

    def test_who_has_no_key_gives_no_work(self):
        port, other = free_port(), free_port()
        self.start("scheduler", "--port", port, "--key-file", "a.key")
        self.start("scheduler", "--port", other, "--key-file", "b.key")
        while not all((self.home / f"{k}.key").exists() for k in "ab"):
            time.sleep(0.02)
        self.assertEqual((self.home / "a.key").stat().st_mode & 0o777, 0o600)
        for where in ((f"tls://127.0.0.1:{port}", "--key-file", "b.key"), (f"tcp://127.0.0.1:{port}",)):
            said = self.command("hop", "--seeds", "1:2", "--dir", where[0][:3], "--on", *where, status=3)
            self.assertIn("no_scheduler", said)
        said = self.command(
            "hop", "--seeds", "1:2", "--dir", "c", "--on", f"tls://127.0.0.1:{port}", "--key-file", "hop", status=2
        )
        self.assertIn("is no key of a scheduler", said)

    def test_campaign_ends_when_its_interval_is_narrow_enough(self):
        said = self.command("hop", "--seeds", "1:400", "--dir", "a", "--stop-when", "0.25")
        self.assertIn("enough for --stop-when", said)
        number = len(self.counted("a"))
        self.assertTrue(5 < number < 60, number)
        low, high = map(float, re.search(r"\(([\d.]+) to ([\d.]+) %", said).groups())
        self.assertLessEqual(high - low, 25.1)
        self.command("--resume", "a")
        self.assertEqual(len(self.counted("a")), number)

    def test_run_that_takes_too_long_is_ended_and_counted_as_such(self):
        self.command("hop", "--seeds", "1:3", "--dir", "a", "--timeout", "0.5", "--", "--set", "sim.sleep=60")
        self.assertEqual([(r["fault"], r["exit_status"]) for r in self.counted("a")], [("wall_time", None)] * 3)
        self.assertFalse(is_alive(str(self.home)))

    def test_runs_of_another_build_are_not_counted_together(self):
        self.command("hop", "--seeds", "1:3", "--dir", "a")
        with (self.programs / "hop").open("a") as file:
            file.write("# another build\n")
        self.assertIn("has changed since a began", self.command("--resume", "a", status=2))

    def test_folder_that_is_in_use_or_holds_something_is_refused(self):
        process = self.start("hop", "--seeds", "1:50", "--dir", "a", "--workers", 1, "--", "--set", "sim.sleep=0.3")
        self.await_runs("a", 1, process)
        self.assertIn("another process is carrying out", self.command("--resume", "a", status=2))
        self.assertIn("is not an empty folder", self.command("hop", "--seeds", "1:3", "--dir", "a", status=2))
        self.assertIn("is no folder of a campaign", self.command("--resume", "bin", status=2))

    def test_comparison_pairs_runs_by_seed(self):
        for folder, seeds, gain in (("a", "1:20", 0.35), ("b", "5:24", 0.5), ("c", "100:101", 0.5)):
            self.command("hop", "--seeds", seeds, "--dir", folder, "--", "--set", f"task.gain={gain}")
        found = json.loads(self.command("compare", "a", "b", "--json"))
        self.assertEqual(found["pairs"], 16)
        height = next(f for f in found["figures"] if f["figure"] == "height_m")
        self.assertAlmostEqual(height["difference"], 0.2**2 - 0.05**2)
        self.assertLess(height["p"], 1e-3)
        self.assertIn("16 pairs", self.command("compare", "a", "b"))
        self.assertIn("no seed in common", self.command("compare", "a", "c", status=2))

    def test_search_finds_the_best_value_and_goes_on_where_it_was_ended(self):
        line = ("tune", "hop", "--for", "height_m", "--over", "task.gain=0:1", "--seeds", "1:2", "--trials", 20)
        self.command(*line, "--dir", "calm")
        process = self.start(*line, "--dir", "rough")
        self.await_runs("rough", 9, process)
        os.killpg(process.pid, signal.SIGINT)
        process.communicate(timeout=400)
        said = self.command(*line, "--dir", "rough", "--resume")
        self.assertEqual(self.hashes("rough"), self.hashes("calm"))
        best = float(re.search(r"best .*task\.gain=([\d.]+)", said)[1])
        self.assertAlmostEqual(best, 0.3, delta=0.08)
        self.assertEqual(self.counted("calm")[0]["task.gain"], 0.5)  # the default is tried first
        self.assertIn("campaign compare runs/before runs/after", said)
        # Its runs are no campaign: what was proposed has no success rate.
        self.assertIn("calm is a search", self.command("--resume", "calm", status=2))
        self.command("page", "calm")
        text = Page((self.home / "calm" / "page.html").read_text()).text
        self.assertIn("A search for the smallest height_m over task.gain", text)
        self.assertNotIn("true rate", text)
        said = self.command("tune", "hop", "--for", "heigth_m", "--over", "task.gain=0:1", status=2)
        self.assertIn("there is no figure 'heigth_m'; did you mean 'height_m'?", said)
        self.assertNotIn("to go on", said)  # the same line would be as wrong

    def test_search_calls_default_what_is_the_default(self):
        line = ("tune", "hop", "--for", "height_m", "--seeds", "1:1")
        said = self.command(*line, "--over", "task.gain=0.6:0.9", "--trials", 2)
        self.assertIn("nearest to the default (0.5) height_m", said)
        self.assertIn("campaign compare", said)
        said = self.command(*line, "--over", "task.gain=0.5:0.9", "--trials", 3)
        self.assertIn("  default  height_m", said)
        self.assertIn("the default is the best that was found", said)
        self.assertNotIn("campaign compare", said)

    def test_worker_tells_what_it_waits_for_and_what_to_do_when_nobody_is_there(self):
        told, address = [], f"tcp://127.0.0.1:{free_port()}"
        with self.assertRaises(CampaignError) as refused:
            hosts.await_scheduler(address, told.append, 0.1)
        self.assertEqual(told, [f"waiting for the scheduler {address} ..."])
        self.assertEqual((refused.exception.status, refused.exception.code), (3, "no_scheduler"))
        self.assertIn("campaign scheduler --listen 127.0.0.1 --port", str(refused.exception))
        self.assertIn("write tcp://HOST:PORT", self.command("worker", "tcp://a:99999", status=2))

    def test_help_needs_no_task(self):
        self.assertEqual(main(["--help"]), 0)
        for command in ("compare", "tune", "page", "scheduler", "worker"):
            self.assertIn(f"campaign {command}", self.command(command, "--help"))
