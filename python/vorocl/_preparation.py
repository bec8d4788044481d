"""Kernels compiled beforehand, in processes of their own."""

from __future__ import annotations

import os
import subprocess
import sys

from . import _vorocl
from ._device import Device
from ._errors import DeviceError


def prepare(request: str = "") -> int:
    """Compile the kernels of all methods and measures, once per user and device.

    The first call of a function waits some seconds for the driver's compiler. After this it does not, in this process
    and in later ones, unless its options are rare, such as those of spaced grids. The work is done by one process per
    processor, because a driver compiles in one thread at a time. It takes some minutes of a processor, and some seconds
    if all is there.

    With PoCL the programs are kept as binaries in ``$XDG_CACHE_HOME/vorocl/binaries``, or
    ``~/.cache/vorocl/binaries``, a folder of the user's alone; other drivers have caches of their own. The environment
    variable VOROCL_BINARY_CACHE=0 turns that off. ``vorocl prepare`` is the same as a command.

    Parameters
    ----------
    request : str, optional
        The device, as that of `Device`.

    Returns
    -------
    int
        How many binaries are kept.

    Raises
    ------
    DeviceError
        If there is no such device, or a process fails, such as one that cannot write the binaries. The message says why.

    Examples
    --------
    >>> import vorocl
    >>> binaries = vorocl.prepare()  # doctest: +SKIP
    """
    Device(request)  # raises where there is none
    count = min(os.cpu_count() or 1, _vorocl.most_preparation_parts())
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(path for path in sys.path if path))
    command = [sys.executable, "-c", f"from {__name__} import prepare_part; prepare_part()", request]
    parts = [
        subprocess.Popen(
            [*command, str(index), str(count)],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        for index in range(count)
    ]
    answers = [part.communicate() for part in parts]
    for part, (_, errors) in zip(parts, answers):
        if part.returncode != 0:
            raise DeviceError((errors.strip().splitlines() or [f"a process ended with {part.returncode}"])[-1])
    return sum(int(output) for output, _ in answers)


def prepare_part() -> None:
    """What one process does: the device, the part and how many there are stand on its command line."""
    try:
        print(_vorocl.prepare_programs(_vorocl.Device.select(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3])))
    except Exception as error:
        sys.exit(str(error))
