"""Processes that are made from one which has used the device."""

import multiprocessing

import numpy as np
import pytest

import vorocl

POINTS = np.array([(1, 1), (6, 2), (3, 5)], float)
SECONDS = 120


@pytest.mark.parametrize("method", ["spawn", "forkserver"])
def test_new_processes_have_devices_of_their_own(method):
    expected = vorocl.diagram(POINTS, (8, 10))
    with multiprocessing.get_context(method).Pool(1) as pool:
        assert (pool.apply_async(vorocl.diagram, (POINTS, (8, 10))).get(SECONDS) == expected).all()


def test_a_fork_is_refused_at_once():
    vorocl.diagram(POINTS, (8, 10))
    with multiprocessing.get_context("fork").Pool(1) as pool:
        with pytest.raises(vorocl.DeviceError, match="spawn or forkserver"):
            pool.apply_async(vorocl.diagram, (POINTS, (8, 10))).get(SECONDS)
