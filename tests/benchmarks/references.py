"""Table of the reference problems: run ``python tests/benchmarks/references.py``.

Known values, from publications and closed forms, beside microslip's own. Exit status 1
if one misses its tolerance.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).parents[1]))

from references.catalogue import findings


def main() -> int:
    """Print one row per quantity."""
    out, missed = sys.stdout.write, 0
    out("| system | quantity | known | microslip | error | tolerance | source |\n")
    out("|---|---|---|---|---|---|---|\n")
    for each in findings():
        missed += not each.holds
        out(
            f"| {each.system} | {each.quantity} | {each.known:.8g} | {each.found:.8g} "
            f"| {each.error:.1e} | {each.tolerance:g} | {each.source} |\n"
        )
        sys.stdout.flush()
    return int(missed > 0)


if __name__ == "__main__":
    sys.exit(main())
