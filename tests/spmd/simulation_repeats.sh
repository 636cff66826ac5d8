#!/usr/bin/env bash
# Runs a simulation twice and compares all that it leaves, the history with its simulated times included.
# Usage: simulation_repeats.sh DIRECTORY COMMAND...   (the directory of a run is appended to the command)
set -eu
directory=$1
shift
rm -rf "$directory"
for run in one two; do
  mkdir -p "$directory/$run"
  "$@" "$directory/$run" > /dev/null 2>&1
done
grep -q '"finished":true' "$directory/one/RUN/common/manifest.json"
# run.json tells how long the preparation took on this computer.
diff -r --exclude=run.json "$directory/one" "$directory/two"
