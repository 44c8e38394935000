"""What a campaign counts together."""

import os
import shutil
import subprocess
from pathlib import Path
from unittest import mock

from place import BIN, Place

from mrroc_campaign import program
from mrroc_campaign.plan import Plan, Row
from mrroc_campaign.results import Results


class Tables(Place):
    def campaign(self, runs: int, **more) -> Results:
        """A campaign that has begun: task.force is varied."""
        plan = Plan("hop", f"1:{runs}", vary=["task.force=1:9"], program=program.digest("hop", "one"), folder=str(self.home), **more)
        rows = [Row(k, k + 1, {"task.force": str(1.0 + k)}) for k in range(runs)]
        results = Results.create(self.home / "c", plan, rows, ["task.force"])
        (results.folder / "scratch").mkdir()
        return results

    def test_fingerprint_is_of_all_that_a_run_starts(self):
        names = ("simulator", "edp_arm", "ecp_hop", "vsp_eye")
        for name in (*names, "vsp_test", "other"):
            shutil.copy(self.programs / "hop", self.programs / name)
        before = {kind: program.digest("hop", kind) for kind in ("one", "separate")}
        for name, kinds in (*((n, {"separate"}) for n in names), ("vsp_test", set()), ("other", set()), ("hop", {"one", "separate"})):
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

    def test_campaign_of_an_earlier_version_is_not_taken_up(self):
        results = self.campaign(2)
        results.keep_note("plan", results.plan.as_dict() | {"program": "0123456789abcdef"})
        self.assertIn("looked at the program hop alone", self.command("--resume", "c", status=2))
