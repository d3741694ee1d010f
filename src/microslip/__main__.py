"""python -m microslip, and the command microslip."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path


def main() -> int:
    """Run one command and return the exit status; imports may be interrupted too.

    What ends a job, as batch systems do when its time is over, interrupts it.
    """
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    _open_streams()
    try:
        from microslip.cli import main as run

        return run()
    except KeyboardInterrupt:
        sys.stderr.write("microslip: interrupted\n")
        return 130


def _open_streams() -> None:
    """Let output go nowhere where whoever began this has closed it, as daemons do.

    A file of results would be opened in its place otherwise.
    """
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            nowhere = Path(os.devnull).open(mode, encoding="utf-8")  # noqa: SIM115
            setattr(sys, name, nowhere)


if __name__ == "__main__":
    sys.exit(main())
