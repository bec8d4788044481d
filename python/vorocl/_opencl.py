"""OpenCL's loader, libOpenCL: the machine's own, whose functions the extension module calls."""

import ctypes
import sys


def load_opencl() -> None:
    """Load it for all modules of the process; the extension module does not name it.

    Raises
    ------
    ImportError
        If there is none. The message says what to install.
    """
    if sys.platform in ("darwin", "win32"):  # there the extension module names it
        return
    try:
        ctypes.CDLL("libOpenCL.so.1", mode=ctypes.RTLD_GLOBAL)
    except OSError as error:
        raise ImportError(
            "VoroCL needs an OpenCL loader and a driver: NVIDIA's for its GPUs, or PoCL for the CPU (on Debian and "
            f"Ubuntu: apt-get install ocl-icd-libopencl1 pocl-opencl-icd): {error}"
        ) from None
