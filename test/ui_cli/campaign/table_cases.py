"""What becomes of a run's result, whatever it says: its row, its folder, its place on the page."""

import io
import json
import os
import shutil
import subprocess
import tarfile
from html.parser import HTMLParser
from pathlib import Path
from unittest import mock

from place import BIN, Place

from mrroc_campaign import job as jobs, page, program, report
from mrroc_campaign.plan import Plan, Row
from mrroc_campaign.results import WORKER_LOST, Results
from mrroc_campaign.told import checked

_DONE = {"success": True, "exit_status": 0, "outcome": "done"}
_FAILED = {"success": False, "exit_status": 1, "outcome": "fault", "fault": "slipped", "text": "it slipped"}


class Links(HTMLParser):
    """Elements and links of a page."""

    def __init__(self, text: str):
        super().__init__()
        self.elements, self.links, self.text = set(), [], ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.elements.add(tag)
        self.links += [v for k, v in attrs if k in ("href", "src")]

    def handle_data(self, data):
        self.text += data


class Tables(Place):
    def campaign(self, runs: int, **more) -> Results:
        """A campaign that has begun: task.force is varied."""
        more |= {"program": program.digest("hop", "one"), "folder": str(self.home)}
        plan = Plan("hop", f"1:{runs}", vary=["task.force=1:9"], **more)
        rows = [Row(k, k + 1, {"task.force": str(1.0 + k)}) for k in range(runs)]
        results = Results.create(self.home / "c", plan, rows, ["task.force"])
        (results.folder / "scratch").mkdir()
        return results

    def count(self, results: Results, run: int, told) -> dict:
        """What a worker tells of a run comes into the table. Returns its row."""
        self.assertTrue(results.add(results.planned()[run], checked(told, run)))
        return next(r for r in results.counted() if r["run"] == run)

    def archive(self, *names: str, size: int = 3) -> bytes:
        """A packed folder with files of these names, and all else that an archive may hold."""
        packed = io.BytesIO()
        with tarfile.open(fileobj=packed, mode="w:gz") as archive:
            for name in names:
                member = tarfile.TarInfo(name)
                member.size, member.mode = size, 0o6777
                archive.addfile(member, io.BytesIO(b"x" * size))
            for name, kind in (
                ("link", tarfile.SYMTYPE),
                ("hard", tarfile.LNKTYPE),
                ("fifo", tarfile.FIFOTYPE),
                ("device", tarfile.CHRTYPE),
            ):
                member = tarfile.TarInfo(name)
                member.type, member.linkname = kind, str(self.home / "secret")
                archive.addfile(member)
        return packed.getvalue()

    def test_archive_of_a_worker_writes_nothing_but_files_below_its_own_folder(self):
        results, outside = self.campaign(1), self.home / "outside"
        names = ("run/summary.json", f"/{outside}1", f"{outside}2", "../outside3", "run/../../../outside4", "./run/a")
        row = self.count(results, 0, _FAILED | {"packed": self.archive(*names)})
        kept = results.folder / row["folder"]
        self.assertEqual(row["folder"], "kept/000000")
        found = {str(p.relative_to(kept)): p for p in kept.rglob("*")}
        self.assertEqual(set(found), {"run", "run/summary.json", "run/a"})
        self.assertEqual(found["run/a"].stat().st_mode & 0o7777, 0o644)
        self.assertEqual(sorted(p.name for p in self.home.iterdir()), ["bin", "c"])

    def test_archive_that_is_damaged_or_too_large_is_left_out_and_its_run_counted(self):
        whole = self.archive("run/a", size=2000)
        clash = self.archive("run", "run/a")  # a file that is a folder, too
        results = self.campaign(4)
        for run, packed in enumerate((whole[: len(whole) // 2], b"no archive", clash)):
            self.assertEqual(self.count(results, run, _FAILED | {"packed": packed})["folder"], "")
        with mock.patch("mrroc_campaign.unpack.LARGEST_MB", 0.001):
            self.assertEqual(self.count(results, 3, _FAILED | {"packed": whole})["folder"], "")
        self.assertEqual(list((results.folder / "kept").iterdir()), [])

    def test_only_folders_of_the_campaigns_own_runs_are_taken_away(self):
        results, mine = self.campaign(6), self.home / "mine"
        mine.mkdir()
        (results.folder / "scratch" / "link").symlink_to(mine)
        scratch = results.folder / "scratch"
        for run, folder in enumerate((mine, scratch / "link", scratch / "none", f"{scratch}/{'x' * 300}", "\0", "")):
            self.assertEqual(self.count(results, run, _FAILED | {"folder": str(folder)})["folder"], "")
        self.assertTrue(mine.is_dir())

    def test_figures_that_are_no_numbers_are_not_measured_and_the_page_is_made(self):
        results = self.campaign(12)
        strange = ("9", None, float("nan"), float("inf"), -1e308, 10**400, {"a": 1}, [[1], "x", 2], True, 1e90)
        for run, x in enumerate(strange):
            row = self.count(results, run, _DONE | {"figures": {"x": x}, "bars": {"x": [x, None]}, "sim_s": x})
            number = {8: 1.0, 9: 1e90}.get(run)
            self.assertEqual((row["x"], row["sim_s"], row["success"]), (number, number, 1))
        self.assertEqual([results.counted()[7][f"x[{k}]"] for k in range(3)], [None, None, 2.0])
        self.assertIsInstance(self.count(results, 10, [1, 2]), dict)  # not even a result
        self.count(results, 11, {k: [k] for k in (*_FAILED, "figures", "bars", "log_hash", "host", "folder", "packed")})
        self.assertEqual([r["fault"] for r in results.counted()[10:]], ["unknown", "unknown"])
        report.write_page(results)

    def test_figures_may_be_named_as_columns_as_values_and_as_one_another(self):
        results = self.campaign(3)
        names = {"run": 1, "SEED": 2, "Task.Force": 3, "a": 4, "A": 5, 'q"; --': 6}
        no_names = {"\ud800": 7, "x\0": 8, "y[0]": 9, "": 10}
        row = self.count(results, 0, _DONE | {"figures": names | no_names, "bars": {"run": [0, 2]}})
        found = {"figure run": 1, "figure SEED": 2, "figure Task.Force": 3, "a": 4, 'q"; --': 6}
        self.assertEqual({k: row[k] for k in results.figures()}, found)
        self.assertEqual((row["run"], row["seed"], row["task.force"]), (0, 1, 1.0))
        self.assertEqual(self.count(results, 1, _DONE | {"figures": {"A": 5}})["a"], 5)
        self.assertIn("wanted 1 +- 1", page.of(results))

    def test_names_that_are_new_in_every_run_do_not_end_the_campaign(self):
        results = self.campaign(5)
        for run in range(5):
            self.count(results, run, _DONE | {"figures": {f"x{run}_{k}": 1.0 for k in range(600)}})
        self.assertEqual(len(results.figures()), 1000)
        self.assertEqual(len(results.counted()), 5)

    def test_page_shows_as_text_whatever_a_run_says(self):
        results, evil = self.campaign(14), "<script>x</script>"
        told = {k: evil for k in ("outcome", "fault", "text", "log_hash", "host", "left_at")}
        for run in range(14):
            bars = {evil: [0, 1], "plain": [run, run]}
            figures = {evil: float(run), "plain": 1.0, "odd": "\x1b[31m"}
            self.count(results, run, told | {"success": run > 4, "figures": figures, "bars": bars, "exit_status": 1})
        found = Links(page.of(results))
        self.assertNotIn("script", found.elements)
        self.assertIn(evil, found.text)
        self.assertEqual(found.links, [])

    def test_what_a_run_says_moves_no_terminal(self):
        results = self.campaign(1)
        row = self.count(results, 0, _FAILED | {"fault": "\x1b[2J", "text": "a\x1b[2Jb\n"})
        self.assertEqual((row["fault"], row["text"]), ("__2J", "a [2Jb "))
        self.assertTrue(all(line.isprintable() for line in report.lines(results)))

    def test_folder_that_was_left_elsewhere_is_told_and_no_link(self):
        results = self.campaign(2)
        self.count(results, 0, _FAILED | {"left_at": "host:/tmp/000000-1"})
        (results.folder / "scratch" / "1").mkdir()
        self.count(results, 1, _FAILED | {"folder": str(results.folder / "scratch" / "1")})
        found = Links(page.of(results))
        self.assertEqual(found.links, ["kept/000001/run/"])
        self.assertIn("host:/tmp/000000-1", found.text)

    def test_rate_and_faults_are_of_the_same_runs_while_earlier_ones_have_not_ended(self):
        results = self.campaign(9, stop_when=0.5)
        for run in (3, 4, 5, 6, 7, 8):
            self.count(results, run, _FAILED)
        self.assertEqual(report.lines(results)[0].split(";")[0], "0 of 9 runs")  # and not: enough for --stop-when
        self.assertIn("the first run of the plan has not ended", page.of(results))
        self.count(results, 0, _DONE)
        self.count(results, 1, _FAILED)
        text = Links(page.of(results)).text
        self.assertIn("1 of 2 runs ended as wanted", text)
        self.assertIn("slipped150.0 %", text)  # one run, 50.0 %, and not seven of two
        self.assertIn("6 runs that stand behind these", text)
        self.assertEqual(report.lines(results)[-1], "      1 slipped")

    def test_enough_is_told_when_the_interval_is_as_narrow_as_was_asked_for(self):
        results = self.campaign(300, stop_when=0.2)
        for run in range(60):
            self.count(results, run, _DONE)
            low, high = report.rate(results.plan, results.counted()).interval(run + 1)
            self.assertEqual("enough" in report.lines(results)[0], high - low <= 0.2)
        self.assertIn("enough", report.lines(results)[0])

    def test_lost_run_counts_as_failure_and_holds_nothing_up_until_it_is_carried_out(self):
        for stop_when in (0.0, 0.01):
            results = self.campaign(3, stop_when=stop_when)
            self.count(results, 0, {"fault": WORKER_LOST, "text": "gone"})
            self.count(results, 1, _DONE)
            found = report.rate(results.plan, results.counted())
            self.assertEqual((found.successes, found.runs, found.lost()), (1, 2, 1))
            self.assertIn("Of 1 runs the workers died", page.of(results))
            said = self.command("--resume", "c", "--workers", 1)
            self.assertIn("3 of 3 runs", said)
            self.assertEqual([r["success"] for r in self.counted("c")], [1, 1, 1])
            shutil.rmtree(self.home / "c")

    def execute(self, body: str) -> dict:
        """The result of a run whose program is a script; FOLDER is its run folder."""
        task = self.programs / "odd"
        task.write_text(f'#!/bin/sh\nfor word; do FOLDER=$word; done\nmkdir "$FOLDER"\n{body}\n')
        task.chmod(0o755)
        plan = Plan("odd", "1:1", keep="none", program=program.digest("odd", "one"), folder=str(self.home))
        return jobs.execute(jobs.job_of(plan, Row(0, 1, {}), str(self.home)))

    def test_output_that_is_no_text_does_not_hide_the_error(self):
        result = self.execute(r"printf 'a\377\n'; printf '\376\nerror: slipped: \377it; do\n' >&2; exit 1")
        self.assertEqual((result["fault"], result["text"]), ("slipped", "\ufffdit; do"))
        result = self.execute("yes | head -c 3000000; echo 'error: slipped: it' >&2; exit 1")
        self.assertEqual(result["fault"], "slipped")

    def test_run_without_a_summary_that_says_done_is_no_success(self):
        whole = json.dumps({"outcome": "done", "figures": {"x": 1}})
        for text, success in (
            (whole, True),
            (whole[:-3], False),
            (whole.replace("done", "fault"), False),
            ("[1]", False),
            ("[" * 200_000, False),
            (r'"\377"', False),
        ):
            (self.home / "summary").write_text(text)
            result = self.execute(f"cp {self.home}/summary $FOLDER/summary.json")
            self.assertEqual((result["success"], result["fault"]), (success, "" if success else "no_summary"))
        self.assertEqual(self.execute("exit 0")["fault"], "no_summary")

    def test_fingerprint_is_of_all_that_a_run_starts(self):
        names = ("simulator", "edp_arm", "ecp_hop", "vsp_eye")
        for name in (*names, "vsp_test", "other"):
            shutil.copy(self.programs / "hop", self.programs / name)
        before = {kind: program.digest("hop", kind) for kind in ("one", "separate")}
        changed = dict.fromkeys(names, {"separate"}) | {"vsp_test": set(), "other": set(), "hop": {"one", "separate"}}
        for name, kinds in changed.items():
            with (self.programs / name).open("a") as file:
                file.write("# another build\n")
            now = {kind: program.digest("hop", kind) for kind in before}
            self.assertEqual({k for k in now if now[k] != before[k]}, kinds, name)
            before = now

    def test_fingerprint_is_of_libraries_that_are_not_the_systems_too(self):
        told = subprocess.run(["ldd", BIN / "press"], capture_output=True, text=True, check=True).stdout
        library = next(line.split()[2] for line in told.splitlines() if "liblcm" in line)
        mine = Path(shutil.copy(library, self.home))
        shutil.copy(BIN / "press", self.programs)
        with mock.patch.dict(os.environ, LD_LIBRARY_PATH=str(self.home)):
            before = program.digest("press", "one")
            with mine.open("ab") as file:
                file.write(b" ")
            self.assertNotEqual(program.digest("press", "one"), before)

    def test_output_of_a_run_that_is_kept_tells_where_its_folder_is_now(self):
        results = self.campaign(1)
        (results.folder / "scratch" / "1").mkdir()
        (results.folder / "scratch" / "1" / "output.txt").write_text("run folder: scratch/1/run\n")
        row = self.count(results, 0, _FAILED | {"folder": str(results.folder / "scratch" / "1")})
        said = (results.folder / row["folder"] / "output.txt").read_text().splitlines()
        self.assertEqual(said[1:], [f"campaign: this run folder was moved to {results.folder}/kept/000000/run"])

    def test_bars_of_the_page_are_of_the_values_that_the_table_has(self):
        results = self.campaign(40)
        rows = [{"task.force": 0.0 if k < 30 else 1.0 + k % 2, "success": k % 3} for k in range(40)]
        drawn = []
        with mock.patch("mrroc_campaign.charts.rates", lambda groups, title: drawn.extend(groups) or ""):
            page._rates("task.force", rows)
        bars = [(name, failures, runs) for name, failures, runs, *_ in drawn]
        self.assertEqual(bars, [("0", 10, 30), ("1", 2, 5), ("2", 2, 5)])
        self.assertIn("No run has been counted", page.of(results))

    def test_what_is_not_allowed_is_told_as_such_and_not_as_a_full_disk(self):
        self.command("hop", "--seeds", "1:2", "--dir", "a")
        self.home.chmod(0o755)
        (self.home / "a" / ".lock").chmod(0o600)
        (self.home / "file").write_text("")
        nobody = ("setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups")
        cases = [
            (["hop", "--seeds", "1:2", "--dir", "file"], "file is a file; choose another --dir"),
            (["hop", "--seeds", "1:2", "--dir", "file/b"], "choose another folder with --dir"),
            (["hop", "--seeds", "1:2", "--dir", "/proc/none"], "choose another folder with --dir"),
            (["hop", "--seeds", "1:2", "--dir", "a"], "or go on with --resume a"),
        ]
        for words, told in cases:
            said = self.command(*words, status=2)
            self.assertIn(told, said)
            self.assertNotIn("make room", said)
        self.assertNotIn("--resume", self.command("hop", "--seeds", "1:2", "--dir", "bin", status=2))
        if os.geteuid() == 0:
            self.assertIn("a cannot be written", self.command("page", "a", status=2, before=nobody))
            (self.home / "a").chmod(0o700)
            new = ["hop", "--seeds", "1:2", "--dir", "a"]
            for words in (["page", "a"], ["--resume", "a"], ["compare", "a", "a"], new):
                self.assertIn("a cannot be read", self.command(*words, status=2, before=nobody))

    def test_comparison_with_a_campaign_that_has_no_runs_says_so(self):
        self.campaign(2)
        self.assertIn("c has no run that is counted yet", self.command("compare", "c", "c", status=2))

    def test_campaign_of_an_earlier_version_is_not_taken_up(self):
        results = self.campaign(2)
        results.keep_note("plan", results.plan.as_dict() | {"program": "0123456789abcdef"})
        self.assertIn("looked at the program hop alone", self.command("--resume", "c", status=2))
