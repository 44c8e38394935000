"""Carries out jobs on Dask. Whatever happens to workers and scheduler, every job's result is taken once; that of a job
which ends its workers again and again is that it was lost."""

import queue
import time
import uuid
from collections import Counter, deque
from collections.abc import Callable, Iterable
from concurrent.futures import CancelledError
from contextlib import suppress

from distributed import Client
from distributed.scheduler import KilledWorker

from .errors import CampaignError, HostFailed
from .job import execute
from .results import WORKER_LOST
from .told import checked, printable

_ATTEMPTS = 3  # of a job whose workers died, ten of them each time
_LOOK_S = 2.0  # between two looks at how many workers there are
_PATIENCE_S = 600.0  # for a scheduler that is gone


class Runner:
    """Jobs on one scheduler. connect: makes a client; raises OSError (or a TimeoutError) when there is no scheduler."""

    def __init__(self, connect: Callable[[], Client], told: Callable[[str], None] = lambda text: None):
        self._connect, self._told = connect, told
        self._client: Client | None = None
        self._ended: queue.SimpleQueue = queue.SimpleQueue()
        self._running: dict[str, tuple[dict, object]] = {}
        self._limit, self._looked = 0, -_LOOK_S

    def run(self, jobs: Iterable[dict], take: Callable[[dict], bool]) -> list[int]:
        """Carries out jobs. take: gets each result, as checked() makes it, in this thread; False ends all. Returns the
        numbers of lost jobs, whose results have the fault worker_lost."""
        waiting, more, killed, lost = deque(), iter(jobs), Counter(), []
        try:
            while True:
                self._hand_out(waiting, more)
                if not self._running:
                    return lost
                job, future = self._next(waiting)
                if job is None:
                    continue
                result, failed = self._outcome(future)
                if failed is not None:
                    result = self._judge(failed, job, killed, lost)
                if result is None:
                    waiting.append(job)
                elif not take(checked(result, job["run"])):
                    return lost
        finally:
            self._running.clear()  # nobody waits for these any more, so the scheduler forgets them

    def close(self) -> None:
        """Leaves the scheduler."""
        if self._client is not None:
            with suppress(Exception):  # a client of a scheduler that is gone raises all kinds
                self._client.close(timeout=2)
            self._client = None

    def _hand_out(self, waiting: deque, more) -> None:
        """Every worker has a job and the next one beside it."""
        if self._client is None or self._client.status != "running":
            self._come_back(waiting)
        if time.monotonic() > self._looked + _LOOK_S:
            self._looked = time.monotonic()
            self._limit = 2 * max(1, len(self._client.scheduler_info().get("workers", {}))) + 1
        while len(self._running) < self._limit:
            job = waiting.popleft() if waiting else next(more, None)
            if job is None:
                return
            key = f"{job['task']}-{job['run']}-{uuid.uuid4().hex[:8]}"
            future = self._client.submit(execute, job, key=key, pure=False)
            self._running[key] = job, future
            future.add_done_callback(self._ended.put)

    def _next(self, waiting: deque) -> tuple[dict | None, object]:
        try:
            future = self._ended.get(timeout=0.5)
        except queue.Empty:
            if self._client.status != "running":
                self._come_back(waiting)
            return None, None
        job, _ = self._running.pop(future.key, (None, None))
        return job, future

    @staticmethod
    def _outcome(future) -> tuple[dict | None, BaseException | None]:
        """A job's result, or why it failed; neither if it was cancelled or is gone with the scheduler, which may go
        between its word that a job has ended and the result."""
        try:
            if future.status == "finished":
                return future.result(), None
            return None, future.exception() if future.status == "error" else None
        except (OSError, CancelledError):
            return None, None

    @staticmethod
    def _judge(failed: BaseException, job: dict, killed: Counter, lost: list[int]) -> dict | None:
        """The result of a job that is lost; None: it is tried once more."""
        if isinstance(failed, HostFailed):
            raise CampaignError(
                3, "host_failed", f"run {job['run']} could not be carried out, and is not counted: {printable(str(failed))}"
            )
        if not isinstance(failed, KilledWorker):
            raise CampaignError(
                3, "host_failed", f"run {job['run']} could not be carried out: {type(failed).__name__}: {printable(str(failed))}"
            )
        killed[job["run"]] += 1
        if killed[job["run"]] < _ATTEMPTS:
            return None
        lost.append(job["run"])
        return {"fault": WORKER_LOST, "text": "the workers that carried it out died, again and again"}

    def _come_back(self, waiting: deque) -> None:
        """Connects, for the first time or again. What was running is handed out anew: only results that were taken
        count."""
        again = self._client is not None
        self.close()
        waiting.extendleft(job for job, _ in reversed(self._running.values()))
        self._running.clear()
        deadline = time.monotonic() + (_PATIENCE_S if again else 0)
        if again:
            self._told("the scheduler is gone; waiting for it")
        while True:
            try:
                self._client = self._connect()
                return
            except (OSError, TimeoutError) as failed:
                if time.monotonic() > deadline:
                    raise CampaignError(3, "no_scheduler", f"the scheduler is not reached: {failed}") from None
            time.sleep(1.0)
