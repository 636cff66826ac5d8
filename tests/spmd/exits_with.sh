#!/usr/bin/env bash
# exits_with.sh STATUS TEXT COMMAND...: the command ends with this exit status and says TEXT once, and no rank goes on.
status=$1 text=$2
shift 2
said=$("$@" 2>&1)
got=$?
count=$(grep -cF -- "$text" <<<"$said")
if [ "$got" -ne "$status" ] || [ "$count" -ne 1 ] || grep -q "went on after" <<<"$said"; then
  echo "$said"
  echo "exit status $got, wanted $status; said $count times: $text"
  exit 1
fi
