"""The command line: arguments in, one command, exit status out."""

from __future__ import annotations

import argparse
import os
import re
import shlex
import sys
import warnings
from collections.abc import Sequence
from decimal import Decimal
from typing import NoReturn

from microslip.commands import (
    decay,
    dwell,
    explain,
    folds,
    follow,
    frc,
    grid,
    jumps,
    modes,
    plot,
    poles,
    precision,
    report,
    scenes,
    stress,
    sweep,
    tables,
    track,
    verify,
)
from microslip.errors import GivenError
from microslip.interruption import heeded, unmasked
from microslip_mechanics.errors import MicroslipError

COMMANDS = (
    frc,
    sweep,
    dwell,
    decay,
    verify,
    track,
    follow,
    folds,
    jumps,
    poles,
    modes,
    precision,
    grid,
    stress,
    tables,
    report,
    scenes,
    explain,
    plot,
)
"""in the order of the help"""
EPILOG = """\
start with: microslip frc two-blades
exit status: 0 done, 1 failed, not whole (what was computed is kept) or the solvers
disagree, 2 wrong scene, file or arguments, 130 interrupted (kept likewise)"""


def _plain(word: str) -> str:
    """Return a word; a negative number without exponent, or it would be an option."""
    number = re.fullmatch(r"-(\d+\.?\d*|\.\d+)[eE][-+]?\d{1,3}", word)
    return format(Decimal(word), "f") if number else word


def main(arguments: list[str] | None = None) -> int:
    """Run one command and return the exit status."""
    # Small matrices: threads of the linear algebra cost more than they bring.
    for library in ("OPENBLAS", "MKL", "OMP"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")
    given = sys.argv[1:] if arguments is None else arguments
    words = [_plain(word) for word in given]
    options, unknown = _parser().parse_known_args(words)
    if unknown:
        reason = f"{words[0]}: no such argument: {unknown[0]}"
        return _failed(f"{reason}: see microslip {words[0]} --help", 2)
    options.command = shlex.join(["microslip", *words])
    options.main = main  # for a command that runs others
    try:
        return _run(options)
    except BrokenPipeError:  # the reader of our output left, as `head` does
        _silence()
        return 1
    except OSError as error:  # a full disk, say
        _silence()
        return _failed(f"the output cannot be written: {error.strerror}", 1)


def _silence() -> None:
    """Let what is still to be printed go nowhere."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _run(options: argparse.Namespace) -> int:
    """Run a command; return the exit status, errors that are known made one line."""
    try:
        with warnings.catch_warnings(), heeded(), unmasked():
            # an overflow ends the command instead of running on with nonsense
            warnings.simplefilter("error", RuntimeWarning)
            status = int(options.run(options))
            sys.stdout.flush()
            return status
    except GivenError as error:
        return _failed(str(error), 2)
    except (MicroslipError, ValueError) as error:
        return _failed(str(error), 1)
    except (ArithmeticError, RuntimeWarning) as error:
        return _failed(f"numbers out of range ({error}): check the scene's values", 1)
    except MemoryError:
        return _failed("not enough memory: give a longer time step or less data", 1)
    except KeyboardInterrupt:
        return _failed("interrupted; files are written only where named above", 130)


def _failed(reason: str, status: int) -> int:
    """Print why in one line; return the status."""
    print("microslip:", " ".join(reason.split()), file=sys.stderr)
    return status


class _Parser(argparse.ArgumentParser):
    """Tell what is wrong with the arguments in one line."""

    def error(self, message: str) -> NoReturn:
        command = self.prog.removeprefix("microslip").strip()
        where = f"{command}: " if command else ""
        self.exit(_failed(f"{where}{message}: see {self.prog} --help", 2))


class _Command(_Parser):
    """Take options before, between and behind what has no name."""

    _mixed = False
    """whether options are already told from the rest, which calls this again"""

    def parse_known_args(  # type: ignore[override]
        self,
        args: Sequence[str] | None = None,
        namespace: argparse.Namespace | None = None,
    ) -> tuple[argparse.Namespace, list[str]]:
        """Return what is known of the arguments, and the others."""
        if self._mixed:
            return super().parse_known_args(args, namespace)
        self._mixed = True
        return self.parse_known_intermixed_args(args, namespace)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="microslip",
        description="Nonlinear forced response of structures with friction and "
        "contact, by harmonic balance and by time integration.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action=_Version, nargs=0, help="show the version")
    commands = parser.add_subparsers(
        required=True, metavar="COMMAND", parser_class=_Command
    )
    for command in COMMANDS:
        command.add(commands)
    return parser


class _Version(argparse.Action):
    """Look the version up only when it is asked for."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print the version and leave."""
        from importlib.metadata import version

        print(f"microslip {version('microslip')}")
        parser.exit()
