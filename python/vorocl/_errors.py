"""The exceptions of the package, one for each kind of what can go wrong."""

from __future__ import annotations

from typing import Any, Tuple


class Error(Exception):
    """What went wrong and what to do about it, in one line. All other exceptions of the package are of this one."""


class BadArgument(Error, ValueError):
    """An argument is out of its range or of the wrong type, or two do not fit together. Nothing was done."""


class BadPoint(BadArgument):
    """A point cannot be a seed's: it is infinite, too far away, or outside where such points are refused.

    Attributes
    ----------
    row : int
        The row of `points`.
    value : tuple of float
        Its x and y, as they were given. The message has z, too.
    """

    def __init__(self, message: str, row: int, value: Tuple[float, float]) -> None:
        super().__init__(message)
        self.row = row
        self.value = value

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (str(self), self.row, self.value)


class DeviceError(Error, RuntimeError):
    """There is no such device, or OpenCL or its driver failed."""


class DeviceMemoryError(DeviceError, MemoryError):
    """The device has too little memory."""


class HostMemoryError(Error, MemoryError):
    """The host has too little memory."""


class KernelBuildError(DeviceError):
    """A kernel could not be built; the message holds the compiler's log."""


class FileError(Error, OSError):
    """A file cannot be read or written: one of VOROCL_KERNEL_DIR or VOROCL_DUMP_DIR, or a binary that `prepare` keeps."""
