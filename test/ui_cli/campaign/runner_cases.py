"""The runner between its jobs and a scheduler that goes at the worst moment."""

import unittest

from distributed.comm.core import CommClosedError

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
