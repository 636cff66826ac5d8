#!/usr/bin/env bash
# Kills a rank of a run with SIGKILL at random moments, most of them between two commits, going on with --resume each time; the committed iteration
# must never go back, and the last run must end with the right answer (which the program checks itself).
# Usage: kill_and_resume.sh KILLS SEED DIRECTORY MANIFEST COMMAND...   (COMMAND without --resume)
set -u
kills=$1 RANDOM=$2 directory=$3 manifest=$4
shift 4
rm -rf "$directory"
mkdir -p "$directory"

iteration() {  # of the manifest, 0 where there is none yet
  [ -f "$manifest" ] || { echo 0; return; }
  sed -n 's/.*"iteration":\([0-9]*\).*/\1/p' "$manifest"
}

advance() {  # until the run has committed something new, or has ended
  for _ in $(seq 500); do
    now=$(iteration)
    [ "${now:-0}" -gt "$last" ] && return
    kill -0 "$launcher" 2> /dev/null || return
    sleep 0.02
  done
}

resume=
last=0
killed=0
while [ "$killed" -lt "$kills" ]; do
  "$@" $resume > "$directory/log" 2>&1 &
  launcher=$!
  if [ $((killed % 3)) -eq 0 ]; then
    sleep "0.$(printf '%03d' $((RANDOM % 700 + 200)))"  # perhaps before there is anything to lose
  else
    advance
    sleep "0.$(printf '%03d' $((RANDOM % 150)))"
  fi
  mapfile -t ranks < <(pgrep -P "$launcher")
  if [ "${#ranks[@]}" -gt 0 ] && kill -9 "${ranks[RANDOM % ${#ranks[@]}]}" 2>/dev/null; then
    killed=$((killed + 1))
    # mpirun itself can hang on a rank that dies while it is being started.
    (sleep 20; kill -9 "$launcher") > /dev/null 2>&1 &  # a sleep left behind must not hold the test's output
    watch=$!
    wait "$launcher"
    ended=$?
    kill "$watch" 2> /dev/null
    if [ "$ended" -eq 0 ]; then
      # The rank had done its part already: the run ended well before it noticed.
      grep -q "ended after" "$directory/log" || { echo "a killed run ended with status 0"; exit 1; }
    fi
  elif ! wait "$launcher"; then
    echo "a run failed that was not killed:"; cat "$directory/log"; exit 1
  fi
  now=$(iteration)
  if [ -z "$now" ] || [ "$now" -lt "$last" ]; then
    echo "the committed iteration went from $last back to '$now'"; exit 1
  fi
  echo "killed in or after iteration $now"
  last=$now
  resume=--resume
  # Where the run is nearly done, kills would find nothing left to interrupt: begin again.
  if grep -q '"finished":true' "$manifest" 2>/dev/null; then resume= last=0; rm -f "$manifest"; fi
done
"$@" $resume || { echo "the last run, unharmed, failed"; exit 1; }
