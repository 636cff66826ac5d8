"""What the robustness programs share: running enfilade, judging how it ended, and small RUNs to try it on."""
import json
import os
import re
import signal
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
ROOM = ROOT / "tests/cli/room.json"
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")

LIBRARY_WORDS = re.compile(r"json\.exception|std::|check failed|\.cpp|\.hpp|assert", re.IGNORECASE)
CRASH_WORDS = re.compile(r"terminate called|Sanitizer")  # whoever says so: smpirun and mpirun say more than the program does


class Outcome:
    """How a command ended: its status (negative: by a signal; None: not within its time) and what it said."""

    def __init__(self, status, error):
        self.status, self.error = status, error
        self.lines = [line for line in error.splitlines() if line.startswith("enfilade: error: ")]

    def fault(self):
        """What is wrong with the way the command ended; None where it is 0, or 1 or 2 with one line that says what to do."""
        if self.status is None:
            return "hangs"
        if self.status not in (0, 1, 2):
            return f"crashes ({self.status}): {self.error[-300:]}"
        if self.status == 0:
            return "an error with exit status 0" if self.lines else None
        if len(self.lines) != 1:
            return f"{len(self.lines)} lines of error: {self.error[-500:]}"
        if LIBRARY_WORDS.search(self.lines[0]) or CRASH_WORDS.search(self.error):
            return f"words of a library: {self.error[-500:]}"
        return None if "; " in self.lines[0] else f"no remedy: {self.lines[0]}"


def run(command, timeout_s=30, env=None):
    process = subprocess.Popen([str(c) for c in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                               errors="replace", start_new_session=True, env=dict(os.environ, **(env or {})))
    try:
        _, error = process.communicate(timeout=timeout_s)
        return Outcome(process.returncode, error)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        _, error = process.communicate()
        return Outcome(None, error)


def solve(program, scene, directory, *options, ranks=1, timeout_s=120, env=None):
    """One rank: as a user starts it; more: by mpirun."""
    launcher = ["mpirun", "--oversubscribe", "-n", ranks] if ranks > 1 else []
    exports = [part for name in (env or {}) for part in ("-x", name)] if ranks > 1 else []
    return run([*launcher, *exports, program, "solve", scene, "-o", directory, "--no-pictures", "--quiet", *options],
               timeout_s, env)


def answers(directory):
    return [probe["E"] for probe in json.loads((Path(directory) / "probes.json").read_text())["probes"]]
