"""The package as a whole: its types, and what it says where OpenCL is missing."""

import inspect
import os
import re
import shutil
import subprocess
import sys
import typing
from pathlib import Path

import pytest

import vorocl
from vorocl import _vorocl


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


def test_the_stub_of_the_extension_module_is_up_to_date(tmp_path):
    made = tmp_path / "_vorocl.pyi"
    subprocess.run(
        [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "vorocl._vorocl", "-o", str(made)], check=True
    )
    assert made.read_text() == Path(vorocl.__file__).with_name("_vorocl.pyi").read_text()


def check_devices(*arguments, **environment):
    return subprocess.run(
        [sys.executable, "-m", "vorocl", *arguments], capture_output=True, text=True, env={**os.environ, **environment}
    )


def test_the_package_checks_the_devices_when_it_is_run():
    found = check_devices()
    listed = [device for device in vorocl.devices() if device.asked_for or "VOROCL_DEVICE" not in os.environ]
    assert found.returncode == 0, found.stdout + found.stderr
    assert all(device.name in found.stdout for device in listed)
    right = re.findall(r"^     (\d+) of (\d+) known diagrams are right$", found.stdout, re.MULTILINE)
    assert len(right) == len(listed) and all(count == of and int(of) >= 34 for count, of in right)

    none = check_devices("no such device")
    assert none.returncode == 1 and "error: no usable OpenCL device" in none.stderr and "known" not in none.stdout


def test_kernels_that_err_are_found_out(tmp_path):
    kernels = tmp_path / "kernels"
    shutil.copytree(Path(__file__).parents[2] / "kernels", kernels)
    jump_flooding = kernels / "flooding" / "jump_flooding.cl"
    jump_flooding.write_text(jump_flooding.read_text().replace("height, step), out", "height, 1), out"))
    found = check_devices(VOROCL_KERNEL_DIR=str(kernels))
    assert found.returncode == 1
    assert "wrong: jfa, euclidean\n" in found.stdout and "wrong: exact" not in found.stdout


def test_types_can_be_asked_for_at_run_time():
    asked = [getattr(vorocl, name) for name in vorocl.__all__]
    for value in asked:
        if inspect.isfunction(value):
            assert "return" in typing.get_type_hints(value)
        elif inspect.isclass(value) and value.__module__ != "vorocl._vorocl":
            typing.get_type_hints(value)
            for _, member in inspect.getmembers(value, inspect.isfunction):
                typing.get_type_hints(member)
    hints = typing.get_type_hints(vorocl.diagram)
    assert set(typing.get_args(hints["method"])) == {name for name, *_ in _vorocl.methods()}
    assert typing.get_args(hints["metric"]) == ("euclidean", "manhattan", "great-circle")


def test_all_that_is_public_is_documented():
    for name in vorocl.__all__:
        value = getattr(vorocl, name)
        if callable(value) and value.__module__ != "vorocl._vorocl":
            assert value.__doc__ and value.__doc__[0].isupper(), name


def loaded(library):
    """The file of a library that this process uses."""
    vorocl.Device()
    with open("/proc/self/maps") as maps:
        return next(line.split()[-1] for line in maps if re.search(rf"/lib{library}\b", line))


def install(site, package, library, target=None):
    """Make what a package of PyPI with a library leaves where it is installed; without a target the library is none."""
    information = site / f"{package.replace('-', '_')}-1.dist-info"
    information.mkdir(parents=True)
    (information / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {package}\nVersion: 1\n")
    (information / "RECORD").write_text(f"drivers/{library},,\n")
    (site / "drivers").mkdir(exist_ok=True)
    if target:
        (site / "drivers" / library).symlink_to(target)
    else:
        (site / "drivers" / library).write_text("no library")


def test_the_first_call_says_which_driver_to_install():
    found = run("import vorocl; print(vorocl.devices()); vorocl.diagram([], (3, 3))", OCL_ICD_VENDORS="/nonexistent")
    assert found.stdout.endswith("[]\n")
    assert "DeviceError: no OpenCL platform was found; install a driver" in found.stderr
    assert "without root: pip install intel-opencl-rt intel-cmplr-lib-rt" in found.stderr


def test_the_import_says_which_loader_to_install(tmp_path):
    (tmp_path / "libOpenCL.so.1").write_text("no library")  # found first, and of no use; so is that of a package
    install(tmp_path, "intel-opencl-rt", "libOpenCL.so.1")
    found = run("import vorocl", LD_LIBRARY_PATH=str(tmp_path), PYTHONPATH=str(tmp_path))
    assert "ImportError: VoroCL needs an OpenCL loader and a driver" in found.stderr
    assert "apt-get install" in found.stderr.splitlines()[-1]


def test_the_loader_of_a_package_is_taken_where_the_system_has_none(tmp_path):
    (tmp_path / "libOpenCL.so.1").write_text("no library")
    install(tmp_path, "intel-opencl-rt", "libOpenCL.so.1", loaded("OpenCL"))
    found = run("import vorocl; print(len(vorocl.devices()))", LD_LIBRARY_PATH=str(tmp_path), PYTHONPATH=str(tmp_path))
    assert found.stdout == f"{len(vorocl.devices())}\n", found.stderr


def test_drivers_of_packages_are_found_where_the_system_has_none(tmp_path):
    site, vendors = tmp_path / "site", tmp_path / "vendors"
    vendors.mkdir()
    (vendors / "intel-cpu.icd").write_text("/opt/anaconda1anaconda2/lib/libintelocl.so")  # as that of Intel's package
    install(site, "pocl-binary-distribution", "libpocl-21062cec.so")
    caches = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    environment = dict(
        OCL_ICD_VENDORS=str(vendors),
        PYTHONPATH=str(site),
        VOROCL_DEVICE="",
        XDG_CACHE_HOME=str(tmp_path / "cache"),
        POCL_CACHE_DIR=os.environ.get("POCL_CACHE_DIR") or str(caches / "pocl" / "kcache"),  # with what is compiled
    )
    skipped = "RuntimeWarning: the OpenCL driver of pocl-binary-distribution is skipped: no OpenCL driver could start"

    none = run("import vorocl; vorocl.Device()", **environment)
    assert skipped in none.stderr and "RuntimeWarning: no OpenCL driver works; without " in none.stderr
    assert "DeviceError" in none.stderr

    install(site, "intel-opencl-rt", "libintelocl.so", loaded("(pocl|intelocl|nvidia-opencl)"))
    found = check_devices(**environment)
    assert found.returncode == 0 and skipped in found.stderr, found.stdout + found.stderr
    assert found.stdout.startswith("skipped: the driver of pocl-binary-distribution: no OpenCL driver could start")
    assert "known diagrams are right" in found.stdout and "wrong:" not in found.stdout
    again = run("import vorocl; print(vorocl.diagram([(1, 1), (6, 2)], (1, 8)))", **environment)
    assert again.stdout == "[[0 0 0 0 1 1 1 1]]\n" and again.stderr == ""


def test_a_driver_of_the_system_is_left_alone(tmp_path):
    install(tmp_path, "pocl-binary-distribution", "libpocl-21062cec.so")
    found = run("import os, vorocl; print(os.environ.get('OCL_ICD_VENDORS'))", PYTHONPATH=str(tmp_path))
    assert found.stdout == f"{os.environ.get('OCL_ICD_VENDORS')}\n" and found.stderr == ""


def test_the_package_says_its_version():
    source = (Path(__file__).parents[2] / "CMakeLists.txt").read_text()
    assert f"project(VoroCL VERSION {vorocl.__version__}" in source


def test_the_extension_module_names_no_library_but_the_system_s():
    found = subprocess.run(["ldd", _vorocl.__file__], capture_output=True, text=True)
    if found.returncode != 0:
        pytest.skip("no ldd")
    libraries = {line.split()[0].split(".so")[0] for line in found.stdout.splitlines()}
    system = {"linux-vdso", "libstdc++", "libm", "libgcc_s", "libc", "libdl", "libpthread"}
    assert all(name in system or "ld-linux" in name for name in libraries), libraries
