"""Dask's scheduler and workers on this machine: they listen on 127.0.0.1 unless somebody says otherwise."""

import asyncio
import logging
import os
import re
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from contextlib import contextmanager, suppress
from pathlib import Path

import dask
from distributed import LocalCluster, Scheduler, Worker

from . import keys
from .errors import CampaignError, bad_usage
from .repeat import called

LOCAL = "127.0.0.1"
_PATIENCE_S = 60.0  # for a scheduler that is not there yet
# A run ends its worker only by chance. What Dask watches many times a second is of no use for runs of seconds, and
# takes their time.
_SETTINGS = {
    "distributed.scheduler.allowed-failures": 10,
    "distributed.scheduler.work-stealing": False,
    "distributed.worker.profile.enabled": False,
    "distributed.worker.profile.interval": "10s",
    "distributed.worker.profile.cycle": "100s",
    "distributed.comm.retry.count": 0,
    "distributed.admin.tick.interval": "2s",
    "distributed.admin.tick.limit": "1h",
    "distributed.admin.system-monitor.interval": "10s",
    "distributed.admin.system-monitor.disk": False,
    "distributed.worker.memory.monitor-interval": "10s",
    "distributed.scheduler.active-memory-manager.start": False,
}


def configure() -> None:
    """Dask's settings, the same for everybody who takes part."""
    dask.config.set(_SETTINGS)
    logging.disable(logging.CRITICAL)  # Dask tells what we tell in our own words


def cores() -> list[int]:
    """Cores that this process may use."""
    return sorted(os.sched_getaffinity(0))


class Workers:
    """Processes of one worker each, which are started again when they end."""

    def __init__(self, address: str, number: int, folder: Path, listen: str, key: Path | None):
        self._words = [
            sys.executable,
            "-m",
            "mrroc_campaign",
            "worker",
            address,
            "--single",
            "--folder",
            str(folder),
            "--listen",
            listen,
        ]
        self._words += ["--key-file", str(key)] if key else []
        # Where every core has its worker each stays on its own: a run's threads then need not wait for another core to wake.
        self._cores = cores() if number == len(cores()) else []
        self._ending = threading.Event()
        self._processes: dict[int, subprocess.Popen] = {}
        self._threads = [threading.Thread(target=self._keep, args=(k,), daemon=True) for k in range(number)]
        for thread in self._threads:
            thread.start()

    def wait(self) -> None:
        """Until somebody ends them."""
        while not self._ending.wait(1.0):
            pass

    def end(self) -> None:
        """Kills them, and with them the runs that they carry out."""
        self._ending.set()
        for process in list(self._processes.values()):
            process.kill()
        for thread in self._threads:
            thread.join()

    def _keep(self, k: int) -> None:
        package = str(Path(__file__).resolve().parents[1])
        path = os.pathsep.join([package, *filter(None, [os.environ.get("PYTHONPATH")])])
        environment = os.environ | {"PYTHONPATH": path, "PYTHONDONTWRITEBYTECODE": "1"}
        place = ["taskset", "--cpu-list", str(self._cores[k])] if self._cores else []
        while not self._ending.is_set():
            # In a session of its own: Ctrl-C comes to the one who asked, who ends all others. The kernel ends it with him.
            self._processes[k] = subprocess.Popen(
                ["setpriv", "--pdeathsig", "KILL", *place, *self._words],
                env=environment,
                start_new_session=True,
                stdin=subprocess.DEVNULL,
            )
            if self._ending.is_set():
                self._processes[k].kill()
            began = time.monotonic()
            self._processes[k].wait()
            if time.monotonic() - began < 2:
                self._ending.wait(1.0)  # not again and again what cannot start


@contextmanager
def local_cluster(number: int, folder: Path):
    """A scheduler and workers of this machine alone. Yields the cluster, which a Client takes."""
    configure()
    key = folder / "key"
    cluster = LocalCluster(
        n_workers=0, host=LOCAL, scheduler_port=0, dashboard_address=f"{LOCAL}:0", silence_logs=logging.CRITICAL,
        protocol="tls://", security=keys.make(key),
    )  # fmt: skip
    workers = Workers(cluster.scheduler_address, number, folder, LOCAL, key)
    try:
        yield cluster
    finally:
        workers.end()
        with suppress(Exception):
            cluster.close(timeout=5)


def await_scheduler(address: str, told: Callable[[str], None], patience_s: float = _PATIENCE_S) -> None:
    """Until somebody listens at tcp://HOST:PORT or tls://HOST:PORT. told: takes lines for a person."""
    place = re.fullmatch(r"(?:tcp|tls)://(?P<host>[^/\s]+):(?P<port>\d{1,5})", address)
    if not place or int(place["port"]) > 65535:
        raise bad_usage(f"{address}: write tcp://HOST:PORT, or with --key-file tls://HOST:PORT")
    told(f"waiting for the scheduler {address} ...")
    deadline = time.monotonic() + patience_s
    while True:
        try:
            socket.create_connection((place["host"].strip("[]"), int(place["port"])), timeout=5).close()
            return told("the scheduler is there; the workers take its runs until Ctrl-C")
        except (OSError, UnicodeError) as failed:  # a name of a host may be none
            if time.monotonic() > deadline:
                start = f"{called()} campaign scheduler --listen {place['host']} --port {place['port']}"
                raise CampaignError(
                    3, "no_scheduler", f"nobody listens at {address} ({failed}); start it there: {start}"
                ) from None
        time.sleep(0.5)


def serve_one(address: str, folder: Path, listen: str, key: Path | None) -> None:
    """One worker with one thread, until its scheduler is gone."""
    configure()
    security = keys.read(key)

    async def until_the_end() -> None:
        worker = Worker(
            address, nthreads=1, host=listen, local_directory=str(folder), memory_limit=None, death_timeout=30,
            dashboard_address=f"{LOCAL}:0", silence_logs=logging.CRITICAL, security=security,
        )  # fmt: skip
        async with worker:
            await worker.finished()

    with suppress(Exception):  # no scheduler: who keeps the workers starts another one
        asyncio.run(until_the_end())


def serve_scheduler(listen: str, port: int, key: Path | None) -> None:
    """A scheduler, until a signal comes. key: a file that is made if it is not there; none: nothing is encrypted."""
    configure()
    security = keys.make(key) if key and not key.exists() else keys.read(key)

    async def until_the_end() -> None:
        protocol = "tls://" if security else "tcp://"
        async with Scheduler(
            host=listen, port=port, protocol=protocol, security=security, dashboard_address=f"{LOCAL}:0"
        ) as scheduler:
            print(f"scheduler: {scheduler.address}", flush=True)
            await scheduler.finished()

    try:
        with suppress(KeyboardInterrupt):
            asyncio.run(until_the_end())
    except (OSError, RuntimeError) as failed:  # Dask wraps the one in the other
        raise bad_usage(f"nobody can listen on {listen}, port {port}: {failed.__cause__ or failed}") from None
