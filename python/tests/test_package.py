"""The package as a whole: its types, and what it says where OpenCL is missing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import vorocl


def run(code, **environment):
    return subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env={**os.environ, **environment}
    )


def test_mypy_accepts_the_package_and_those_who_use_it(tmp_path):
    user = tmp_path / "user.py"
    user.write_text(
        "import numpy as np\n"
        "import vorocl\n"
        "labels = vorocl.diagram(np.zeros((3, 2)), (4, 5), periodic=(True, False))\n"
        "reveal_type(labels)\n"
        "reveal_type(vorocl.Diagram((4, 5)).fill(vorocl.Seeds([(1, 2)], (4, 5))).milliseconds)\n"
        "vorocl.diagram([(1, 2)], 5)\n"
    )
    mypy = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path)]
    found = subprocess.run([*mypy, str(user)], capture_output=True, text=True)
    assert "uint32" in found.stdout or "unsignedinteger" in found.stdout, found.stdout
    assert 'Revealed type is "float"' in found.stdout or 'Revealed type is "builtins.float"' in found.stdout
    assert "user.py:6: error" in found.stdout and found.stdout.count("error:") == 1
    whole = subprocess.run([*mypy, "-p", "vorocl"], capture_output=True, text=True)
    assert whole.returncode == 0, whole.stdout + whole.stderr


def test_all_that_is_public_is_documented():
    for name in vorocl.__all__:
        value = getattr(vorocl, name)
        if callable(value) and value.__module__ != "vorocl._vorocl":
            assert value.__doc__ and value.__doc__[0].isupper(), name


def test_the_first_call_says_which_driver_to_install():
    found = run("import vorocl; print(vorocl.devices()); vorocl.diagram([], (3, 3))", OCL_ICD_VENDORS="/nonexistent")
    assert found.stdout == "[]\n"
    assert "DeviceError: no OpenCL platform was found; install a driver" in found.stderr


def test_the_import_says_which_loader_to_install(tmp_path):
    (tmp_path / "libOpenCL.so.1").write_text("no library")  # found first, and of no use
    found = run("import vorocl", LD_LIBRARY_PATH=str(tmp_path))
    assert "ImportError: VoroCL needs an OpenCL loader and a driver" in found.stderr
    assert "apt-get install" in found.stderr.splitlines()[-1]


def test_the_wheel_needs_the_loader_alone():
    module = Path(vorocl.__file__).parent.glob("_vorocl*.so")
    found = subprocess.run(["ldd", str(next(module))], capture_output=True, text=True)
    if found.returncode != 0:
        pytest.skip("no ldd")
    libraries = {line.split()[0].split(".so")[0] for line in found.stdout.splitlines()}
    system = {"linux-vdso", "libOpenCL", "libstdc++", "libm", "libgcc_s", "libc", "libdl", "libpthread"}
    assert all(name in system or "ld-linux" in name for name in libraries), libraries
