"""What `prepare` refuses, at once; what it makes is tested with the command's."""

import os

import pytest

import vorocl


def test_a_device_that_is_not_there_is_refused():
    with pytest.raises(vorocl.DeviceError, match="nonesuch"):
        vorocl.prepare("nonesuch")
    with pytest.raises(vorocl.BadArgument):
        vorocl.prepare(5)


def test_what_stops_a_process_is_said(tmp_path, monkeypatch):
    if vorocl.Device().platform != "Portable Computing Language":
        return  # others keep binaries themselves
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "vorocl" / "binaries"
    os.makedirs(folder)
    os.chmod(folder, 0o755)
    with pytest.raises(vorocl.DeviceError, match="cannot keep binaries of programs in .*binaries"):
        vorocl.prepare()
    assert not list(folder.iterdir())
