"""Files that one command writes at a time, where the system can keep others away."""

from __future__ import annotations

import errno
from typing import IO


def lock(file: IO[bytes], *, shared: bool = False) -> None:
    """Keep other commands from an open file until it is closed.

    If it is ``shared``, only those that do not share it.

    Raises
    ------
    OSError
        If another command is writing it.
    """
    try:
        import fcntl

        kind = fcntl.LOCK_SH if shared else fcntl.LOCK_EX
        fcntl.flock(file, kind | fcntl.LOCK_NB)
    except BlockingIOError:
        reason = "another command is writing it: wait for it, or give another name"
        raise OSError(errno.EWOULDBLOCK, reason) from None
    except (ImportError, OSError):  # a system, or a disk, that knows no locks
        pass
