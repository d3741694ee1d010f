"""python -m microslip."""

from __future__ import annotations

import sys

from microslip.cli import main

if __name__ == "__main__":
    sys.exit(main())
