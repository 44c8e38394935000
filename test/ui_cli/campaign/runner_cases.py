"""The runner between its jobs and a scheduler that goes at the worst moment."""

import unittest

from distributed.comm.core import CommClosedError
from distributed.scheduler import KilledWorker

from mrroc_campaign.runner import Runner


class Future:
    """One that has ended, of a job whose result is `what`, or not to be had any more when that is an exception."""

    def __init__(self, key: str, what, status: str):
        self.key, self.status, self._what = key, status, what

    def add_done_callback(self, told):
        told(self)

    def result(self):
        if isinstance(self._what, BaseException):
            raise self._what
        return self._what

    def exception(self):
        return self.result()


class Client:
    """A scheduler's, which carries jobs out at once. gone: what the first result of a run raises, and its future's status."""

    status = "running"

    def __init__(self, gone: dict[int, tuple[BaseException, str]]):
        self._gone = gone

    def scheduler_info(self):
        return {"workers": {"w": {}}}

    def submit(self, _, job, key, pure):
        what, status = self._gone.pop(job["run"], ({"run": job["run"]}, "finished"))
        return Future(key, what, status)

    def close(self, timeout):
        pass


class Runners(unittest.TestCase):
    def test_result_that_is_gone_with_the_scheduler_is_made_anew_and_counted_once(self):
        gone = {3: (CommClosedError("closed"), "finished"), 5: (CommClosedError("closed"), "error")}
        runner, taken = Runner(lambda: Client(gone)), []
        lost = runner.run(({"task": "hop", "run": k} for k in range(8)), lambda r: taken.append(r["run"]) or True)
        self.assertEqual(lost, [])
        self.assertEqual(sorted(taken), list(range(8)))
        self.assertEqual(gone, {})

    def test_job_whose_workers_die_is_tried_again_and_then_taken_as_lost(self):
        died = KilledWorker("hop", None, 10)

        class Died(Future):
            def exception(self):
                return died

        class Deadly(Client):
            handed_out = 0

            def submit(self, _, job, key, pure):
                if job["run"] == 1:
                    self.handed_out += 1
                    return Died(key, died, "error")
                return super().submit(_, job, key, pure)

        client, taken = Deadly({}), []
        jobs = ({"task": "hop", "run": k} for k in range(3))
        lost = Runner(lambda: client).run(jobs, lambda r: taken.append(r) or True)
        self.assertEqual((lost, client.handed_out), ([1], 3))
        ended = {r["run"]: (r["success"], r["fault"]) for r in taken}
        self.assertEqual(ended[1], (False, "worker_lost"))
        self.assertEqual(sorted(ended), [0, 1, 2])

    def test_result_is_of_the_job_that_was_handed_out_whatever_it_says(self):
        class Confused(Client):
            def submit(self, _, job, key, pure):
                return Future(key, {"run": 7 - job["run"]} if job["run"] else [], "finished")

        taken = []
        jobs = ({"task": "hop", "run": k} for k in range(2))
        Runner(lambda: Confused({})).run(jobs, lambda r: taken.append(r) or True)
        self.assertEqual(sorted(r["run"] for r in taken), [0, 1])
