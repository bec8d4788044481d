"""What stays on the device: seeds, diagrams, simulations; threads, OpenCL's own objects, and memory."""

import copy
import gc
import os
import pickle
import re
import sys
import threading

import numpy as np
import pyopencl
import pyopencl.array
import pytest
from oracles import brute_force, rounded

import vorocl

rng = np.random.default_rng(20)


def test_seeds_move_and_say_how_far():
    seeds = vorocl.Seeds([(1, 1), (30, 5), (np.nan, 0)], (20, 40), periodic=(True, False))
    assert len(seeds) == 3 and seeds.alive == 2
    assert seeds.move_to([(39, 1), (30, 9), (7, 7)]) == 4  # the first one moved by 2, round the border
    assert seeds.alive == 3
    np.testing.assert_array_equal(seeds.read(), rounded([(39, 1), (30, 9), (7, 7)]))
    with pytest.raises(vorocl.BadPoint):
        seeds.move_to([(1, 1), (1, 2.0**31)])
    np.testing.assert_array_equal(seeds.read(), rounded([(39, 1), (30, 9), (7, 7)]))
    assert seeds.move_to([(38, 1)]) == 1 and len(seeds) == 1


def test_a_diagram_is_filled_read_and_written():
    points = rng.uniform(0, 64, (20, 2))
    seeds, diagram = vorocl.Seeds(points, (64, 64)), vorocl.Diagram((64, 64))
    assert (diagram.read() == vorocl.NO_LABEL).all()
    report = diagram.fill(seeds, "jfa")
    assert report.waves == 6 and report.milliseconds > 0
    out = np.empty((64, 64), np.uint32)
    assert diagram.read(out) is out
    assert diagram.errors().wrong_percent < 2
    diagram.write(np.zeros((64, 64), np.int64))
    assert (diagram.read() == 0).all()


def test_a_diagram_remembers_its_seeds():
    points = rng.uniform(0, 64, (20, 2))
    seeds, diagram = vorocl.Seeds(points, (64, 64)), vorocl.Diagram((64, 64))
    diagram.fill(seeds, metric="manhattan")
    expected = vorocl.cells(points, (64, 64), metric="manhattan")
    seeds.move_to([(1, 1)])
    np.testing.assert_array_equal(diagram.cells(), expected)
    np.testing.assert_array_equal(diagram.distances(), vorocl.distances(points, (64, 64), metric="manhattan"))
    assert diagram.errors().wrong_pixels == 0
    labels = diagram.read()
    diagram.write(labels)
    for measure in diagram.cells, diagram.distances, diagram.adjacency, diagram.errors:
        with pytest.raises(vorocl.BadArgument, match="seeds"):
            measure()
    del seeds
    diagram.write(labels, vorocl.Seeds(points, (64, 64)), "manhattan")
    np.testing.assert_array_equal(diagram.cells(), expected)


def test_a_diagram_shows_what_its_seeds_are_on():
    points, bounds = rng.uniform(-1, 1, (20, 2)), (-1, -1, 1, 1)
    diagram = vorocl.Diagram((40, 50))
    diagram.fill(vorocl.Seeds(points, (40, 50), bounds=bounds, y_up=True))
    np.testing.assert_array_equal(diagram.read(), vorocl.diagram(points, (40, 50), bounds=bounds, y_up=True))
    pixels = (points + 1) * (25, 20)
    diagram.fill(vorocl.Seeds(pixels, (40, 50)))
    np.testing.assert_array_equal(diagram.read(), brute_force(pixels, (40, 50)))


def test_frames_of_a_simulation_are_right():
    points, velocity = rng.uniform(0, 96, (40, 2)), rng.normal(0, 2, (40, 2))
    exact = vorocl.Simulation((96, 96), periodic=(True, True))
    dynamic = vorocl.Simulation((96, 96), method="djfa", periodic=(True, True))
    for frame in range(12):
        now = points + frame * velocity
        if frame % 3 == 1:
            now[frame] = np.nan
        labels = exact.step(now).read()
        np.testing.assert_array_equal(labels, brute_force(now % 96, (96, 96), (True, True)))
        snapped = brute_force(now % 96, (96, 96), (True, True), snap=True)
        assert vorocl.similarity(dynamic.step(now).read(), snapped) > 97
        assert dynamic.report.waves > 0
        assert exact.diagram.cells()["area"].sum() == 96 * 96


def test_seeds_leave_the_window_and_come_back():
    points = rng.uniform(-40, 90, (50, 2))
    simulation = vorocl.Simulation((50, 60))
    for frame in range(5):
        points += rng.normal(0, 8, points.shape)
        labels = simulation.step(points).read()
        np.testing.assert_array_equal(labels, brute_force(points, (50, 60)))
        np.testing.assert_array_equal(simulation.seeds.read(), rounded(points))
    inside = rng.uniform(0, 50, (50, 2))
    np.testing.assert_array_equal(simulation.step(inside).read(), brute_force(inside, (50, 60)))


def test_a_simulation_tells_djfa_how_far_seeds_have_moved(monkeypatch):
    points = np.stack(np.meshgrid(*[np.arange(5, 200, 10)] * 2), -1).reshape(-1, 2)  # 10 pixels apart
    simulation = vorocl.Simulation((200, 200), method="djfa", periodic=(True, True))

    def waves(shift):
        simulation.step(points + (shift, 0))
        return simulation.report.waves

    # At first JFA; then from twice the distance of seeds on, or so that all steps cover how far they have moved.
    assert waves(0) == 8 and waves(1) == 6 and waves(51) == 7 and waves(61) == 6

    def fail(*arguments):
        raise KeyboardInterrupt

    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(simulation.diagram, "fill", fail)
        simulation.step(points + (101, 0))
    assert waves(111) == 7  # the labels, of two moves before, show how far their seeds have gone


def test_the_box_of_a_simulation_may_change():
    simulation = vorocl.Simulation((64, 64), bounds=(0, 0, 1, 1), periodic=(True, True))
    points = rng.uniform(0, 1, (40, 2))
    for frame, side in enumerate([1, 1.25, 0.5]):
        bounds = (-side, 0, 0, side) if frame else None  # the first frame has that of the simulation
        moved = (points * side - (side, 0)) if frame else points
        diagram = simulation.step(moved, bounds=bounds)
        box = bounds or (0, 0, 1, 1)
        np.testing.assert_array_equal(diagram.read(), vorocl.diagram(moved, (64, 64), bounds=box, periodic=(True, True)))
        np.testing.assert_allclose(diagram.areas().sum(), side**2)
    np.testing.assert_array_equal(simulation.step(moved).read(), diagram.read())  # the last box
    np.testing.assert_allclose(simulation.seeds.read(), moved, atol=0.51 * side / 64)

    seeds = vorocl.Seeds([(1, 1)], (64, 64))
    seeds.move_to([(0.25, 0.25)], bounds=(0, 0, 1, 1))
    np.testing.assert_allclose(seeds.read(), [(0.25, 0.25)], atol=0.51 / 64)
    assert seeds.read(units="pixels").tolist() == rounded([(16, 16)]).tolist()


def test_what_is_on_a_device_is_not_pickled():
    simulation = vorocl.Simulation((4, 4))
    for value in simulation, simulation.seeds, simulation.diagram, vorocl.Device():
        with pytest.raises(TypeError, match="cannot be pickled or copied: it is on a device") as refused:
            pickle.dumps(value)
        assert str(refused.value).count("\n") == 0
        with pytest.raises(TypeError, match=type(value).__name__):
            copy.deepcopy(value)
    relaxed = vorocl.relax([(0, 0), (1, 0)], (4, 8))
    assert pickle.loads(pickle.dumps(relaxed)).converged


def test_objects_say_what_they_are():
    simulation = vorocl.Simulation((5, 6))
    simulation.step([(1, 1), (2, 3)])
    assert repr(simulation) == "<vorocl.Simulation of 2 points, method exact, of the shape (5, 6)>"
    assert re.search(r"\bReport\(milliseconds=[\d.e-]+, waves=0, host_milliseconds=[\d.e-]+\)$", repr(simulation.report))


# --- threads ---


def test_other_threads_run_while_the_device_works():
    seeds, diagram = vorocl.Seeds([(0, 0)], (1024, 1024)), vorocl.Diagram((1024, 1024))
    diagram.fill(seeds, "standard-flooding")
    diagram.read()
    started, finished = threading.Event(), threading.Event()

    def work():
        started.set()
        diagram.fill(seeds, "standard-flooding")  # a thousand waves, for which it waits
        finished.set()

    thread, interval = threading.Thread(target=work), sys.getswitchinterval()
    sys.setswitchinterval(1000)  # no thread is made to give way: only a call that lets go does
    try:
        thread.start()
        started.wait()
        ran_meanwhile = not finished.is_set()
        thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert ran_meanwhile


def test_threads_have_diagrams_of_their_own():
    shapes = [(70, 90), (90, 70), (70, 90), (33, 40)]
    points = [rng.uniform(0, shape[::-1], (30, 2)) for shape in shapes]
    expected = [brute_force(*arguments) for arguments in zip(points, shapes)]
    wrong = []

    def work(index):
        out = np.empty(shapes[index], np.uint32)
        for _ in range(50):
            vorocl.diagram(points[index], shapes[index], out=out)
            if not np.array_equal(out, expected[index]):
                wrong.append(index)

    threads = [threading.Thread(target=work, args=(index,)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_threads_that_share_a_diagram_take_turns():
    seeds, diagram = vorocl.Seeds([(3, 3)], (40, 40)), vorocl.Diagram((40, 40))

    def work():
        for _ in range(100):
            seeds.move_to(rng.uniform(0, 40, (int(rng.integers(1, 50)), 2)))
            diagram.fill(seeds)
            diagram.read()
            diagram.cells()

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    seeds.move_to([(3, 3)])
    diagram.fill(seeds)
    assert (diagram.read() == 0).all()


# --- pyopencl ---


@pytest.fixture(scope="module")
def opencl():
    selected = next(device for device in vorocl.devices() if device.selected)
    platform = pyopencl.get_platforms()[selected.platform_index]
    context = pyopencl.Context([platform.get_devices()[selected.device_index]])
    return context, pyopencl.CommandQueue(context)


def test_labels_are_a_buffer_of_pyopencl(opencl):
    context, queue = opencl
    device = vorocl.Device.from_pyopencl(*opencl)
    points = rng.uniform(0, (50, 40), (12, 2))
    seeds, diagram = vorocl.Seeds(points, (40, 50), device=device), vorocl.Diagram((40, 50), device=device)
    diagram.fill(seeds)
    program = pyopencl.Program(
        context, "kernel void add_one(global uint* labels) { labels[get_global_id(0)] += 1; }"
    ).build()
    program.add_one(queue, (2000,), None, diagram.buffer)  # in the same queue: behind the diagram
    np.testing.assert_array_equal(diagram.read(), brute_force(points, (40, 50)) + 1)
    buffer = diagram.buffer
    del diagram, seeds, device
    gc.collect()
    labels = np.empty((40, 50), np.uint32)
    pyopencl.enqueue_copy(queue, labels, buffer)
    np.testing.assert_array_equal(labels, brute_force(points, (40, 50)) + 1)


def test_labels_are_written_into_a_buffer_of_pyopencl(opencl):
    context, queue = opencl
    device = vorocl.Device.from_pyopencl(*opencl)
    points = rng.uniform(0, (50, 40), (12, 2))
    buffer = pyopencl.Buffer(context, pyopencl.mem_flags.READ_WRITE, 4 * 2000)
    diagram = vorocl.Diagram((40, 50), device=device, labels=buffer)
    diagram.fill(vorocl.Seeds(points, (40, 50), device=device))
    labels = np.empty((40, 50), np.uint32)
    pyopencl.enqueue_copy(queue, labels, buffer)
    np.testing.assert_array_equal(labels, brute_force(points, (40, 50)))
    assert diagram.buffer == buffer


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_simulation_of_pyopencl_keeps_its_points_on_the_device(opencl, dtype):
    context, queue = opencl
    device = vorocl.Device.from_pyopencl(*opencl)
    start = rng.uniform(0, 5, (30, 2)).astype(dtype)
    points = pyopencl.array.to_device(queue, start)
    box = {"bounds": (0, 0, 5, 5), "periodic": (True, True)}
    seeds = vorocl.Seeds(points, (40, 50), device=device, **box)
    diagram = vorocl.Diagram((40, 50), device=device, periodic=(True, True))
    number = "double" if dtype is np.float64 else "float"
    source = f"kernel void drift(global {number}2* points) {{ points[get_global_id(0)] += ({number}2)(0.75, -0.5); }}"
    drift = pyopencl.Kernel(pyopencl.Program(context, source).build(), "drift")
    for frame in range(1, 4):
        drift(queue, (30,), None, points.data)
        assert seeds.move_to(points) is None
        diagram.fill(seeds)
        moved = start.copy()
        for _ in range(frame):
            moved += np.array((0.75, -0.5), dtype)
        np.testing.assert_array_equal(diagram.read(), vorocl.diagram(moved, (40, 50), **box))
    volume = rng.uniform(0, 4, (9, 3))
    found = vorocl.Diagram((4, 4, 4), device=device)
    found.fill(vorocl.Seeds(pyopencl.array.to_device(queue, volume), (4, 4, 4), outside="refuse", device=device))
    np.testing.assert_array_equal(found.read(), vorocl.diagram(volume, (4, 4, 4)))


def test_points_on_the_device_that_do_not_fit_are_refused(opencl):
    context, queue = opencl
    device = vorocl.Device.from_pyopencl(*opencl)
    other = pyopencl.CommandQueue(pyopencl.Context(context.devices))
    right = np.ones((4, 2))
    wrong = [right.astype(int), np.ones((4, 3)), np.ones(4), np.ones((0, 2)), np.ones((2, 4)).T]
    arrays = [pyopencl.array.to_device(queue, array) for array in wrong]
    arrays += [pyopencl.array.to_device(queue, right)[1:], pyopencl.array.to_device(other, right)]
    seeds = vorocl.Seeds(right, (8, 10), device=device)
    for array in arrays:
        for call in lambda: vorocl.Seeds(array, (8, 10), device=device), lambda: seeds.move_to(array):
            with pytest.raises(vorocl.BadArgument):
                call()
    with pytest.raises(vorocl.BadArgument, match="make new Seeds"):
        seeds.move_to(pyopencl.array.to_device(queue, right), bounds=(0, 0, 1, 1))
    bad = pyopencl.array.to_device(queue, np.array([(1, 1), (np.nan, 2)]))
    with pytest.raises(vorocl.BadPoint, match="point 1"):
        vorocl.Seeds(bad, (8, 10), outside="refuse", device=device).read()


def test_foreign_objects_that_do_not_fit_are_refused(opencl):
    context, queue = opencl
    device = vorocl.Device.from_pyopencl(*opencl)
    other = pyopencl.Context(context.devices)
    out_of_order = pyopencl.command_queue_properties.OUT_OF_ORDER_EXEC_MODE_ENABLE
    small = pyopencl.Buffer(context, pyopencl.mem_flags.READ_WRITE, 7999)
    foreign = pyopencl.Buffer(other, pyopencl.mem_flags.READ_WRITE, 8000)
    unwritable = pyopencl.Buffer(context, pyopencl.mem_flags.READ_ONLY, 8000)
    for buffer in small, foreign, unwritable, np.empty(2000, np.uint32), 12345:
        with pytest.raises(vorocl.BadArgument):
            vorocl.Diagram((40, 50), device=device, labels=buffer)
    for wrong in (other, queue), (queue, context), (context, None), (1, 2):
        with pytest.raises(vorocl.BadArgument):
            vorocl.Device.from_pyopencl(*wrong)
    with pytest.raises(vorocl.BadArgument, match="in-order"):
        vorocl.Device.from_pyopencl(context, pyopencl.CommandQueue(context, properties=out_of_order))
    with pytest.raises(vorocl.BadArgument, match="different devices"):
        vorocl.Diagram((4, 4), device=device).fill(vorocl.Seeds([(1, 1)], (4, 4)))


def test_nothing_is_of_pyopencl_where_it_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyopencl", None)  # imports fail
    with pytest.raises(vorocl.BadArgument, match="pyopencl.Buffer.*ndarray"):
        vorocl.Diagram((4, 4), labels=np.empty(16, np.uint32))
    with pytest.raises(vorocl.BadArgument, match="pyopencl.Context"):
        vorocl.Device.from_pyopencl(1, 2)


# --- devices, errors, memory ---


def test_devices_are_listed_and_chosen_by_name():
    listed = vorocl.devices()
    chosen = [device for device in listed if device.selected]
    assert len(chosen) == 1 and chosen[0].compute_units > 0
    device = vorocl.Device(f"{chosen[0].platform_index}:{chosen[0].device_index}")
    assert (device.name, device.platform) == (chosen[0].name, chosen[0].platform)
    assert f"name={device.name!r}" in repr(chosen[0]) and device.name in repr(device)
    with pytest.raises(vorocl.DeviceError, match="no such thing.*there is"):
        vorocl.Device("no such thing")


def test_errors_can_be_pickled():
    with pytest.raises(vorocl.BadPoint) as caught:
        vorocl.diagram([(1, 1), (5, 1)], (4, 4), outside="refuse")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert (copy.row, copy.value, str(copy)) == (1, (5, 1), str(caught.value))


def resident_bytes():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def test_ten_thousand_calls_keep_no_memory():
    points, shapes = rng.uniform(0, 30, (25, 2)), [(30, 40), (40, 31)]

    def calls(count):
        for index in range(count):
            vorocl.diagram(points, shapes[index // 100 % 2])
            if index % 10 == 0:
                vorocl.cells(points, (30, 40))
                vorocl.adjacency(points, (30, 40))
                vorocl.diagram(points - 5, (30, 40))
                with pytest.raises(vorocl.BadPoint):
                    vorocl.diagram(points + 30, (30, 40), outside="refuse")
        gc.collect()

    calls(2000)
    before = resident_bytes()
    calls(10000)
    assert resident_bytes() - before < 8 * 2**20  # 840 bytes per call would be too many
