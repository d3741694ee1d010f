"""The error of what a user has given: the command line ends with status 2."""

from __future__ import annotations

from microslip_mechanics.errors import MicroslipError


class GivenError(MicroslipError):
    """A scene, an argument or a file that cannot be used: which, and what to do."""
