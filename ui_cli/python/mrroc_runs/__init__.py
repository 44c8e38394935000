"""Reads the run folders of MRROC++ as numpy arrays: summary, configuration, tables, messages."""

from .run import Run, newest_run, open_run

__all__ = ["Run", "newest_run", "open_run"]
