#!/usr/bin/env bash
# bench/partitions.sh [-b BUILD] [-o DIRECTORY] RUN|SCENE.json...: measures the assignments on buildings, into partitions.csv and
# partitions.png of DIRECTORY (bench/data). A scene is prepared first (into BUILD/partitions/NAME); a RUN is taken as it is.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../build/release
out=$here/data
while getopts b:o: option; do
  case $option in
    b) build=$OPTARG ;;
    o) out=$OPTARG ;;
    *) set -- ; OPTIND=1; break ;;
  esac
done
shift $((OPTIND - 1))
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
    "$build/bin/enfilade" prepare "$building" -o "$run" --hierarchy clusters
    runs+=("$run")
  fi
done
"$build/bin/partition_study" "${runs[@]}" --no-seconds -o "$build/partitions.csv"
/usr/bin/python3 "$here/../notebooks/execute.py" "$here/../notebooks/partitions.ipynb" \
  --csv "$build/partitions.csv" --chart "$build/partitions.png"
mkdir -p "$out"
cp "$build/partitions.csv" "$build/partitions.png" "$out/"
