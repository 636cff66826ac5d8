#!/bin/sh
# accuracy.sh [-b BUILD] [SCENE=POINTS ...]: sweeps accuracy against cost over the scenes of this repository that have
# references, and those named; leaves data/accuracy.json and data/accuracy.png here.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../build/release
if [ "${1:-}" = -b ]; then
  build=$2
  shift 2
fi
known=$here/../tests/accuracy/data
/usr/bin/python3 "$here/accuracy_sweep.py" "$build/bin/enfilade" -o "$build/accuracy.json" "$@" \
  "$known/room_block.json=$known/room_block.dense.json" "$known/two_rooms_door.json=$known/two_rooms_door.dense.json" \
  "$here/data/cornell.json=$here/data/cornell.ref.json" "$here/../scenes/duplex.json=$known/duplex.ref.json"
/usr/bin/python3 "$here/../notebooks/execute.py" "$here/../notebooks/accuracy.ipynb" \
  --csv "$build/accuracy.json" --chart "$build/accuracy.png"
mv "$build/accuracy.json" "$build/accuracy.png" "$here/data/"
