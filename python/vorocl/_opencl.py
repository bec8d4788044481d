"""OpenCL's loader, libOpenCL, whose functions the extension module calls, and drivers: the machine's own, or else those
of PyPI's packages, which a user without root can install."""

import atexit
import contextlib
import ctypes
import hashlib
import os
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Dict, Iterator, List, Optional

# The packages and what their drivers' libraries are called. The first one that works is taken.
PACKAGES = {"pocl-binary-distribution": "libpocl", "intel-opencl-rt": "libintelocl"}
# What Intel's loader needs: it lies in the same folder, and is not looked for there. (pyopencl's loader, which has another
# name, crashes on Intel's driver.)
NEEDED_BY_LOADER = ("libintlc.so.5", "libimf.so", "libsvml.so", "libirng.so")
SECONDS = 600  # Intel's compiler takes up to a minute of a processor

# In a process of its own, because a driver that does not know the processor may end it.
CHECK = """
import os, sys, vorocl
from vorocl import _vorocl
try:
    wrong = _vorocl.wrong_answers(vorocl.Device("0:0")._device, "exact, euclidean")
    trouble = wrong[0] if ":" in "".join(wrong) else "a diagram is wrong" if wrong else ""
except vorocl.Error as error:
    trouble = str(error).splitlines()[0]
sys.stderr.write(trouble)
sys.stderr.flush()
os._exit(1 if trouble else 0)  # without what the driver does at the end
"""


def load_opencl() -> None:
    """Load it for all modules of the process; the extension module does not name it.

    Raises
    ------
    ImportError
        If there is none. The message says what to install.
    """
    if sys.platform in ("darwin", "win32"):  # there the extension module names it
        return
    if not has_driver_of_the_system():
        offer_drivers_of_packages()
    failure: Optional[OSError] = None
    for loader in loaders():
        try:
            ctypes.CDLL(loader, mode=ctypes.RTLD_GLOBAL)
            return
        except OSError as error:
            failure = failure or error
    raise ImportError(
        "VoroCL needs an OpenCL loader and a driver: NVIDIA's for its GPUs, or one for the CPU (without root: pip "
        "install intel-opencl-rt intel-cmplr-lib-rt; on Debian and Ubuntu: apt-get install ocl-icd-libopencl1 "
        f"pocl-opencl-icd): {failure}"
    )


def has_driver_of_the_system() -> bool:
    """Whether loaders are told of a driver. Intel's package tells them of a library that is not there."""
    if os.environ.get("OCL_ICD_FILENAMES"):
        return True
    named = os.environ.get("OCL_ICD_VENDORS")
    if named and not os.path.isdir(named):  # it can name a driver
        return True
    for folder in [named] if named else ["/etc/OpenCL/vendors", f"{sys.prefix}/etc/OpenCL/vendors"]:
        for told in Path(folder).glob("*.icd"):
            with contextlib.suppress(OSError):
                library = told.read_text(errors="replace").strip()
                if not os.path.isabs(library) or os.path.exists(library):
                    return True
    return False


def libraries_of(package: str, name: str) -> List[Path]:
    """The libraries of an installed package whose names begin so."""
    try:
        files = distribution(package).files or []
    except PackageNotFoundError:
        return []
    found = [Path(str(file.locate())) for file in files if re.fullmatch(rf"{name}[^.]*\.so[.\d]*", file.name)]
    return sorted(library.resolve() for library in found if library.exists())


def loaders() -> Iterator[str]:
    """The machine's own, and that of Intel's package."""
    yield "libOpenCL.so.1"
    for loader in libraries_of("intel-opencl-rt", "libOpenCL")[:1]:
        for name in NEEDED_BY_LOADER:
            with contextlib.suppress(OSError):
                ctypes.CDLL(str(loader.parent / name))
        yield str(loader)


def offer_drivers_of_packages() -> None:
    """Let loaders find the first driver of a package that works, and say so of drivers that do not.

    What was found out is kept in ``$XDG_CACHE_HOME/vorocl/drivers``, or ``~/.cache/vorocl/drivers``.
    """
    found = {package: libraries_of(package, name)[:1] for package, name in PACKAGES.items()}
    drivers = {package: library for package, libraries in found.items() for library in libraries}
    if not drivers:
        return
    folder = folder_of_checked(drivers)
    if not folder.exists():
        folder = check_drivers(drivers, folder)
    if any(folder.glob("*.icd")):
        os.environ["OCL_ICD_VENDORS"] = str(folder)
    else:
        warnings.warn(f"no OpenCL driver works; without {folder} they are tried again", RuntimeWarning, stacklevel=3)


def folder_of_checked(drivers: Dict[str, Path]) -> Path:
    """Where it is kept which of these drivers works on this processor."""
    cache = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    features = ""
    with contextlib.suppress(OSError), open("/proc/cpuinfo") as processors:
        features = next((line for line in processors if line.startswith("flags")), "")
    told = [f"{library} {library.stat().st_mtime_ns}" for library in drivers.values()]
    key = hashlib.sha256("\n".join([features, *told]).encode()).hexdigest()[:16]
    return Path(cache) / "vorocl" / "drivers" / key


def check_drivers(drivers: Dict[str, Path], folder: Path) -> Path:
    """Make the folder, or another one where it cannot be made, that tells loaders of the first driver that works."""
    try:
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(dir=folder.parent))
    except OSError:
        made = folder = Path(tempfile.mkdtemp())
        atexit.register(shutil.rmtree, made, ignore_errors=True)
    for package, library in drivers.items():
        told = made / f"{package}.icd"
        told.write_text(f"{library}\n")
        trouble = trouble_with_driver(made)
        if not trouble:
            break
        told.unlink()
        told.with_suffix(".skipped").write_text(trouble)
        warnings.warn(f"the OpenCL driver of {package} is skipped: {trouble}", RuntimeWarning, stacklevel=4)
    if made != folder:
        try:
            made.rename(folder)
        except OSError:  # another process was quicker
            shutil.rmtree(made, ignore_errors=True)
    return folder


def trouble_with_driver(folder: Path) -> str:
    """Why the driver that a folder tells of cannot be used; empty if it can."""
    environment = dict(os.environ, OCL_ICD_VENDORS=str(folder), VOROCL_DEVICE="")
    environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
    command = [sys.executable, "-c", CHECK]
    try:
        check = subprocess.run(
            command,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            timeout=SECONDS,
        )
    except subprocess.TimeoutExpired:
        return f"it builds programs for more than {SECONDS} s"
    if check.returncode == 0:
        return ""
    last_words = check.stderr.strip().rpartition("\n")[2]
    return last_words if check.returncode == 1 else f"it ends the process with {check.returncode}: {last_words}"


def skipped_drivers() -> Dict[str, str]:
    """The packages whose drivers are skipped in this process, and why."""
    folder = Path(os.environ.get("OCL_ICD_VENDORS", ""))
    return {skipped.stem: skipped.read_text() for skipped in sorted(folder.glob("*.skipped"))} if folder.name else {}
