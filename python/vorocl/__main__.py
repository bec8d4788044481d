"""The devices that there are, and whether they are right: python -m vorocl [DEVICE]."""

import argparse
import sys

from . import _vorocl
from ._device import Device, devices
from ._errors import DeviceError
from ._opencl import skipped_drivers


def main() -> int:
    """List the devices, and check those that can be used; 1 if one is wrong or there is none."""
    parser = argparse.ArgumentParser(
        prog="python -m vorocl",
        description="List the OpenCL devices, and make small diagrams whose labels are known on those that can be used.",
    )
    parser.add_argument(
        "device",
        nargs="?",
        default="",
        help='check this one alone: a part of its name, or "platform:device"; without it, that of VOROCL_DEVICE, or all',
    )
    request = parser.parse_args().device
    all_answers, status = _vorocl.count_known_answers(), 0
    try:
        chosen = Device(request)  # or the reason why there is none
    except DeviceError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    for package, trouble in skipped_drivers().items():
        print(f"skipped: the driver of {package}: {trouble}")
    listed = devices(request)
    one_is_asked_for = any(found.asked_for for found in listed)
    for found in listed:
        index = f"{found.platform_index}:{found.device_index}"
        print(f"{index}  {found.name} ({found.platform}, driver {found.driver_version})")
        if found.selected:
            print(f"     selected: {found.reason}")
        if found.why_not:
            print(f"     cannot be used: {found.why_not}")
        elif found.asked_for or not one_is_asked_for:
            wrong = _vorocl.wrong_answers((chosen if found.selected else Device(index))._device, "")
            for answer in wrong:
                print(f"     wrong: {answer}")
            print(f"     {all_answers - len(wrong)} of {all_answers} known diagrams are right")
            status = 1 if wrong else status
    return status


if __name__ == "__main__":
    sys.exit(main())
