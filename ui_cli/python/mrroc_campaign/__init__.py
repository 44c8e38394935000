"""Campaigns: many runs of a task with varied values, their statistics, comparisons, and a search for parameters.

On the command line `./run campaign --help`; docs/robustness.md tells how to use it. Workers import this package for
every run, so nothing is imported here."""
