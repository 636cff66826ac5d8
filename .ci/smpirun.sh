#!/usr/bin/env bash
# .ci/smpirun.sh RANKS PROGRAM ARGUMENTS...: runs a program on the first RANKS hosts of a simulated cluster.
# PLATFORM and HOSTFILE choose another cluster than platforms/office.xml.
set -euo pipefail
ranks=$1
shift
here=$(cd "$(dirname "$0")/.." && pwd)
platform=${PLATFORM:-$here/platforms/office.xml}
hostfile=${HOSTFILE:-$here/platforms/office-$ranks.hosts}
# For other numbers of ranks the largest host file there is: smpirun starts again at its top.
[ -n "${HOSTFILE:-}" ] || [ -e "$hostfile" ] || hostfile=$(ls "$here"/platforms/office-*.hosts | sort -V | tail -n 1)
exec smpirun -np "$ranks" -platform "$platform" -hostfile "$hostfile" \
  --log=root.thres:warning "$@"
