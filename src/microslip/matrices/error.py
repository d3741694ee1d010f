"""What a file of a matrix cannot mean, in one line."""

from __future__ import annotations

from pathlib import Path

from microslip_mechanics.errors import MicroslipError


class MatrixFileError(MicroslipError):
    """A file that gives no matrix; the text says where, why and how to mend it."""

    def __init__(self, path: Path, cause: str, line: int | None = None) -> None:
        """Take the file, the cause with its remedy, and the line if there is one."""
        place = "" if line is None else f", line {line}"
        super().__init__(f"{path}{place}: {cause}")

    @classmethod
    def unreadable(cls, path: Path, error: OSError) -> MatrixFileError:
        """Return what is said of a file that cannot be opened."""
        return cls(path, f"cannot be read ({error.strerror}): check the name")
