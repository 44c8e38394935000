#!/bin/sh
# mrroc NAME [options]: runs one of the installed programs.
programs=$(dirname "$(readlink -f "$0")")/../lib/mrroc
if [ $# -eq 0 ] || [ "$1" = --help ] || [ "$1" = -h ]; then
  echo "Usage: mrroc NAME [options]; --help after the name lists its options"
  echo "Names:"
  find "$programs/" -maxdepth 1 -type f -printf '  %f\n' | sort
  exit 0
fi
name=$1
shift
case $name in
  */* | .*) found=false ;;
  *) if [ -f "$programs/$name" ] && [ -x "$programs/$name" ]; then found=true; else found=false; fi ;;
esac
if [ "$found" = false ]; then
  echo "error: bad_usage: there is no program named $name; mrroc --help lists them" >&2
  exit 2
fi
MRROC_CALLED=mrroc # what hints tell to type
export MRROC_CALLED
exec "$programs/$name" "$@"
