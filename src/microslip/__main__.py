"""python -m microslip, and the command microslip."""

from __future__ import annotations

import sys


def main() -> int:
    """Run one command and return the exit status; imports may be interrupted too."""
    try:
        from microslip.cli import main as run

        return run()
    except KeyboardInterrupt:
        sys.stderr.write("microslip: interrupted\n")
        return 130


if __name__ == "__main__":
    sys.exit(main())
