"""The bytes of a file that the user named."""

from __future__ import annotations

import errno
from pathlib import Path


def content(path: Path) -> bytes:
    """All bytes of a file or a pipe. Raises OSError, also for a device: some have no end."""
    refuse_device(path)
    return path.read_bytes()


def refuse_device(path: Path) -> None:
    """Raises OSError for a device such as /dev/zero."""
    if path.is_char_device() or path.is_block_device():
        raise OSError(errno.EINVAL, "it is a device, not a file", str(path))
