"""python -m microslip, and the command microslip."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Run one command and return the exit status; imports may be interrupted too.

    What ends a job, as batch systems do when its time is over, interrupts it.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        from microslip.cli import main as run

        return run()
    except KeyboardInterrupt:
        sys.stderr.write("microslip: interrupted\n")
        return 130


if __name__ == "__main__":
    sys.exit(main())
