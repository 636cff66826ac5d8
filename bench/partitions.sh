#!/usr/bin/env bash
# bench/partitions.sh [-b BUILD] RUN|SCENE.json...: measures the assignments on buildings, into bench/data/partitions.csv
# and partitions.png. A scene is prepared first (into BUILD/partitions/NAME); a RUN is taken as it is.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../build/release
if [ "${1:-}" = -b ]; then
  build=$2
  shift 2
fi
if [ $# -eq 0 ]; then
  sed -n '2,3s/^# //p' "$0" >&2
  exit 2
fi

runs=()
for building in "$@"; do
  if [ -d "$building" ]; then
    runs+=("$building")
  else
    run=$build/partitions/$(basename "$building" .json)
    "$build/bin/enfilade" prepare "$building" -o "$run"
    runs+=("$run")
  fi
done
"$build/bin/partition_study" "${runs[@]}" --no-seconds -o "$build/partitions.csv"
/usr/bin/python3 "$here/../notebooks/execute.py" "$here/../notebooks/partitions.ipynb" \
  --csv "$build/partitions.csv" --chart "$build/partitions.png"
mkdir -p "$here/data"
cp "$build/partitions.csv" "$build/partitions.png" "$here/data/"
