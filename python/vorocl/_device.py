"""The OpenCL device that everything else runs on."""

from __future__ import annotations

import atexit
import contextlib
import functools
import sys
import weakref
from typing import TYPE_CHECKING, Any, List, NamedTuple, NoReturn, Optional

from . import _vorocl
from ._arguments import to_text
from ._errors import BadArgument

if TYPE_CHECKING:
    from pyopencl import Buffer as Buffer, CommandQueue, Context
else:  # which need not be installed
    Buffer = CommandQueue = Context = Any


def is_of_pyopencl(value: object, type_name: str) -> bool:
    """Whether it is of this type of pyopencl's; nothing is where that was never imported."""
    module = sys.modules.get("pyopencl")
    return module is not None and isinstance(value, getattr(module, type_name))


class OnDevice:
    """What lives on a device, and cannot be pickled."""

    def __reduce__(self) -> NoReturn:
        name = f"vorocl.{type(self).__name__}"
        raise TypeError(f"a {name} cannot be pickled or copied: it is on a device; pass points or labels, and make it anew")


class Device(OnDevice):
    """An OpenCL device: a context, an in-order queue and the programs built for them.

    Several threads may use a device at once, each with a diagram of its own.

    Parameters
    ----------
    request : str, optional
        A part of a platform's or a device's name, in any case, or its indices "platform:device". Without one, the
        environment variable VOROCL_DEVICE decides, then an NVIDIA GPU is taken, another GPU, or a CPU, in this order.

    Raises
    ------
    DeviceError
        If there is no such device. The message lists what there is, or says what to install.

    Examples
    --------
    >>> import vorocl
    >>> device = vorocl.Device()
    >>> labels = vorocl.diagram([(1, 1), (6, 2)], (4, 8), device=device)
    """

    def __init__(self, request: str = "") -> None:
        self._device = _vorocl.Device.select(to_text(request, "request"))
        _made.add(self)

    @classmethod
    def from_pyopencl(cls, context: Context, queue: CommandQueue) -> Device:
        """The device of a context and a queue of pyopencl's, which work goes to in the order of the calls.

        Parameters
        ----------
        context : pyopencl.Context
        queue : pyopencl.CommandQueue
            An in-order queue of the context.

        Raises
        ------
        BadArgument
            If they are not of these types or do not belong together, or if the queue is out of order.
        """
        if not is_of_pyopencl(context, "Context") or not is_of_pyopencl(queue, "CommandQueue"):
            raise BadArgument("a device is made from a pyopencl.Context and a pyopencl.CommandQueue")
        device = cls.__new__(cls)
        device._device = _vorocl.Device.adopt(context.int_ptr, queue.int_ptr)
        _made.add(device)
        return device

    @property
    def name(self) -> str:
        """As its driver calls it."""
        return self._device.name

    @property
    def platform(self) -> str:
        """The name of its platform."""
        return self._device.platform

    @property
    def driver_version(self) -> str:
        """As its driver says it."""
        return self._device.driver_version

    def finish(self) -> None:
        """Wait until all that was enqueued is done."""
        self._device.finish()

    def __repr__(self) -> str:
        return f"<vorocl.Device {self.platform}: {self.name}>"


_made: weakref.WeakSet[Device] = weakref.WeakSet()


@atexit.register
def _finish_all() -> None:
    """Wait for what is enqueued: a driver's threads may not work, or compile, while the interpreter ends."""
    for device in list(_made):
        with contextlib.suppress(Exception):
            device.finish()


class DeviceDescription(NamedTuple):
    """What `devices` says of an OpenCL device of this machine."""

    platform_index: int
    device_index: int
    platform: str
    name: str
    type: str
    opencl_version: str
    driver_version: str
    compute_units: int
    global_memory: int
    max_allocation: int
    why_not: str
    selected: bool
    asked_for: bool
    reason: str


def devices(request: str = "") -> List[DeviceDescription]:
    """List all OpenCL devices of this machine.

    Parameters
    ----------
    request : str, optional
        As that of `Device`.

    Returns
    -------
    list of DeviceDescription
        Each with `platform_index`, `device_index`, `platform`, `name`, `type` ("GPU", "CPU" or "accelerator"),
        `opencl_version`, `driver_version`, `compute_units`, `global_memory` and `max_allocation` in bytes, `why_not`
        (why it cannot be used; empty if it can), `selected` (whether ``Device(request)`` would take it) and `reason`.
        Empty without any driver.

    Examples
    --------
    >>> import vorocl
    >>> [device.selected for device in vorocl.devices()].count(True)
    1
    """
    return [DeviceDescription(*found) for found in _vorocl.list_devices(to_text(request, "request"))]


@functools.lru_cache(maxsize=None)
def default_device() -> Device:
    """The device of calls that name none; chosen at the first of them."""
    return Device()


def to_device(device: Optional[Device]) -> Device:
    """The device, or the default one."""
    if device is None:
        return default_device()
    if not isinstance(device, Device):
        raise BadArgument(f"device must be a vorocl.Device; this is of type {type(device).__name__}")
    return device
