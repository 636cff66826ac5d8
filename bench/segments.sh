#!/usr/bin/env bash
# bench/segments.sh [-b BUILD] [-n SEGMENTS] [SCENE.json...]: holds G_cluster of the scenes, and of ten generated buildings at odd angles, against
# random segments (100 million each). Prints cells, clusters, pairs, the ratio to the pairs seen, and the pairs missed; status 1 where one is.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
build=$here/../build/release
segments=100000000
while getopts b:n: option; do
  case $option in
    b) build=$OPTARG ;;
    n) segments=$OPTARG ;;
    *) sed -n '2,3s/^# //p' "$0" >&2; exit 2 ;;
  esac
done
shift $((OPTIND - 1))

work=$build/segments
mkdir -p "$work"
status=0

check() {
  echo "== $(basename "$1" .json)"
  run=$work/$(basename "$1" .json)
  "$build/bin/enfilade" prepare "$1" -o "$run" --no-pictures --hierarchy clusters 2> "$run.warnings" | grep -E 'cells|clusters|visible pairs|time to'
  "$build/bin/segment_check" "$run" --segments "$segments" --a-pair 128 --most-a-pair 1024 || status=1
}

for scene in "$@"; do check "$scene"; done
# Wings that turn by angles of no simple fraction, stairs, fire doors, windows of every kind, furniture.
windows=(open closed none)
for k in 1 2 3 4 5 6 7 8 9 10; do
  scene=$work/odd$k.json
  "$build/bin/enfilade" generate --wings "$((2 + k % 3)),$((6 + k % 4)):$((14 * k - 73)).7,$((2 + k % 2))" --floors $((1 + k % 3)) \
    --stairs $((k % 2 + 1)) --fire-doors $((k % 3)) --windows "${windows[$((k % 3))]}" --rotate "$((7 * k)).3" --seed "$k" \
    --furniture lamp=12,desk=8,chair=8,shelf=6,cupboard=4,table=2 -o "$scene" > /dev/null
  check "$scene"
done
exit $status
