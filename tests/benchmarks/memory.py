"""Memory of long sweeps of model A: python tests/benchmarks/memory.py [SECONDS ...].

Each sweep is the command itself in a process of its own, as rows and as an envelope,
picture included. It prints the largest resident memory and the size of the file; CPU
seconds are this machine's, on this day.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

MOST = 500.0
"""MB that a sweep may take"""


def main() -> None:
    """Print a row for each duration and kind of output."""
    durations = [float(word) for word in sys.argv[1:]] or [10.0, 100.0]
    print("duration [s]  output    memory [MB]  file [MB]  CPU [s]")
    worst = 0.0
    for duration in durations:
        for output in ("rows", "envelope"):
            memory, size, seconds = _swept(duration, output)
            print(
                f"{duration:12g}  {output:8s} {memory:12.0f} {size:10.1f}"
                f" {seconds:8.1f}",
                flush=True,
            )
            worst = max(worst, memory)
    sys.exit(0 if worst < MOST else 1)


def _swept(duration: float, output: str) -> tuple[float, float, float]:
    """Return memory [MB], size of the file [MB] and CPU time [s] of a sweep."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long"
        words = [
            *("-m", "microslip", "sweep", "two-blades", "--set", "model=A"),
            *("--set", f"sweep.end={duration - 2.0}"),
            *("--set", f"sweep.duration={duration}", "-o", str(path)),
            *(["--envelope"] if output == "envelope" else []),
        ]
        with subprocess.Popen(
            [sys.executable, *words], stdout=subprocess.DEVNULL
        ) as sweep:
            _, status, used = os.wait4(sweep.pid, 0)
            sweep.returncode = os.waitstatus_to_exitcode(status)
        if sweep.returncode:
            sys.exit(sweep.returncode)
        size = path.with_suffix(".nc").stat().st_size
    return used.ru_maxrss / 1024.0, size / 1e6, used.ru_utime + used.ru_stime


if __name__ == "__main__":
    main()
