#!/bin/sh
# campaign TASK [options]: many runs of a task, by the Python package that is installed with the programs.
here=$(dirname "$(readlink -f "$0")")
PYTHONPATH=$here/../python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}
export PYTHONPATH
exec /usr/bin/python3 -m mrroc_campaign "$@"
