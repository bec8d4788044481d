"""A thousand wrong calls: each is refused by an exception with one line, and none crashes the interpreter."""

import random

import numpy as np
import pytest
from oracles import brute_force

import vorocl

RIGHT = np.array([(1, 1), (6, 2), (3, 5)], float)
LABELS = np.zeros((8, 10), np.uint32)


class Hostile:
    """Whatever is asked of it fails."""

    def __getattr__(self, name):
        raise ValueError(name)

    def __len__(self):
        raise ValueError("len")

    def __index__(self):
        raise TypeError("index")


def frozen(array):
    array.flags.writeable = False
    return array


NO_NUMBERS = [None, "x", b"x", object(), {}, {"a": 1}, [None], Hostile(), lambda: 0, ...]
FAR_BOUNDS = (20, 20, 30, 30)  # of the points
WRONG = {
    "points": NO_NUMBERS
    + [1, 1.5, [1, 2], [[1, 2, 3]], [[1], [2, 3]], [[[1, 2]]], np.zeros((2, 3)), np.zeros((3, 2), complex)]
    + [np.zeros((3, 2), "M8[s]"), np.array([["1", "2"]]), np.array([[1, None]], object), np.zeros((2, 2, 2))]
    + [[(np.inf, 1)], [(1, -np.inf)], [(-1, 0)], [(0, 8)], [(10, 0)], [(1e300, 0)], np.full((3, 2), 2**63, "u8")]
    + [np.broadcast_to(np.float64(1), (2**31, 2)), np.broadcast_to(np.int8(1), (2**62, 1)), np.zeros(2, "V16")],
    "grid": NO_NUMBERS + [5, (5,), (1, 2, 3), (0, 4, 5), (-1, 4, 5), (0, 5), (5, 0), (-1, 5), (32769, 1), (2**63, 1)]
    + [(-(2**70), 1), (32768, 32769), (1.5, 2), ("1", "2"), (None, None), np.zeros((2, 2))]
    + [(np.nan, 1), "ab", 10**400, (10**400, 1)],
    "method": [None, 1, "", "Exact", "exact ", "jfa+3", b"exact", "x" * 10**6, [], "\0", "ex\0act", Hostile()],
    "metric": [None, 2, "", "l2", "Euclidean", b"euclidean", "chebyshev", (), "\ud800", Hostile()],
    "bounds": NO_NUMBERS[1:]
    + [1, (1, 2), (0, 0, 1, 1, 1), (5, 0, 0, 10), (0, 5, 10, 0), (0, 0, np.nan, 1), (0, 0, np.inf, 1), "0,0,1,1"]
    + [(0, 0, 1e-320, 1), (0, 0, 1e308, 1), (None,) * 4, ("a", "b", "c", "d"), (10**400, 0, 0, 0), FAR_BOUNDS]
    + [(0, 0, 0, 0), (0, 0, 0, 1), (3, 2, 4, 2)],
    "periodic": NO_NUMBERS + [True, 1, (True,), (True, False, True), (1, 0), ("x", "y"), (None, None), "xy", np.nan],
    "outside": [None, "Count", "drop", 1, True, [], Hostile()],
    "units": ["px", "Data", 1, True, [], b"data", Hostile()],
    "snap": ["yes", 1, 0, np.zeros(2), [], Hostile()],
    "truth": [None, True, "True", "snap", b"true", [], Hostile()],
    "y_up": [None, 1, 0, "yes", [], np.zeros(2), Hostile()],
    "device": [1, "cpu", object(), vorocl.Device, vorocl.devices()[0], [], Hostile()],
    "out": NO_NUMBERS[1:]
    + [np.zeros((8, 10)), np.zeros((8, 10), np.int32), np.zeros((10, 8), np.uint32), np.zeros(80, np.uint32)]
    + [np.zeros((8, 20), np.uint32)[:, ::2], np.zeros((10, 8), np.uint32).T, frozen(np.zeros((8, 10), np.uint32))]
    + [np.zeros((8, 10), ">u4"), np.zeros((0, 10), np.uint32), np.zeros(321, "u1")[1:].view("u4").reshape(8, 10)]
    + [np.zeros((8, 10), np.uint32)[::-1], np.broadcast_to(np.uint32(0), (8, 10)), LABELS.tolist(), memoryview(LABELS)],
    "labels": NO_NUMBERS
    + [1, [1, 2], np.zeros((2, 2, 2, 2), int), np.zeros((0, 3), int), [[1], [1, 2]], np.array([["a"]])],
    "rounds": [-1, 2**31, 2**70, 1.5, "3", None, Hostile()],
    "density": NO_NUMBERS[1:]
    + [1, [1, 2], [[1], [1, 2]], np.zeros((10, 8)), np.zeros((8, 10)), np.full((8, 10), -1), np.full((8, 10), np.nan)]
    + [np.full((8, 10), 1e300)],
    "distance": [None, -1, -1e-300, np.nan, "far", [], object(), 10**400, Hostile()],
    "tilt": [np.nan, np.inf, "x", [], 1.0, 10**400, Hostile()],  # the axes are not periodic
    "max_displacement": [-1, np.nan, "x", [], 10**400, Hostile()],
}
WRONG["weights"] = NO_NUMBERS[1:] + [1, [1, 2], [1, 2, np.nan], [1, np.inf, 2], np.zeros((3, 1)), ["a"] * 3]
WRONG["weights"] += [[1j, 2, 3], np.ma.masked_equal([1, 2, 3], 2)]
WRONG["sampling"] = ["x", [], (1, 1001), (1, 1, 1), -1, 0, np.nan, np.inf, object(), {}, Hostile()]
WRONG["shape"] = WRONG["grid"]
WRONG["spacing"] = WRONG["sampling"]
WRONG["exact"] = WRONG["y_up"]
WRONG["input"] = NO_NUMBERS + [np.zeros((2, 2, 2, 2)), [[1], [1, 2]], np.array([["a", "b"]]), np.zeros((2, 2), "M8[s]")]
WRONG["label_image"] = WRONG["input"] + [np.zeros((2, 2), "V8")]
WRONG["mask"] = WRONG["labels"] + WRONG["label_image"]
WRONG["distances"] = NO_NUMBERS[1:] + [np.zeros((8, 10), "f4"), np.zeros((10, 8)), np.zeros(80), LABELS.tolist()]
WRONG["distances"] += [frozen(np.zeros((8, 10))), np.broadcast_to(0.0, (8, 10))]
WRONG["indices"] = WRONG["distances"]
WRONG["a"] = WRONG["labels"] + [np.zeros((3, 3), int), np.full((8, 10), -1), np.full((8, 10), 2**32), np.zeros((8, 10))]

POINTS = ("points", "grid", "method", "metric", "bounds", "periodic", "tilt", "outside", "y_up", "snap", "weights", "device")
CALLS = {
    vorocl.diagram: POINTS + ("out",),
    vorocl.distances: POINTS + ("out", "units"),
    vorocl.cells: POINTS + ("units",),
    vorocl.areas: POINTS + ("units",),
    vorocl.adjacency: POINTS + ("units",),
    vorocl.vertices: POINTS + ("units",),
    vorocl.Grid: ("shape", "bounds", "periodic", "tilt", "y_up"),
    vorocl.exact_cells: ("points", "bounds", "periodic", "tilt", "outside", "weights", "device"),
    vorocl.relax: ("points", "grid", "rounds", "density", "exact", "method", "bounds", "periodic", "outside", "y_up", "snap", "device"),
    vorocl.from_mask: ("mask", "method", "metric", "periodic", "out", "device"),
    vorocl.expand_labels: ("label_image", "distance", "spacing", "device"),
    vorocl.distance_transform_edt: ("input", "sampling", "distances", "indices", "device"),
    vorocl.similarity: ("a", "b"),
    vorocl.errors: ("labels", "points", "metric", "bounds", "periodic", "tilt", "outside", "y_up", "truth", "device"),
    vorocl.Seeds: ("points", "grid", "bounds", "periodic", "tilt", "outside", "y_up", "snap", "weights", "device"),
    vorocl.Diagram: ("grid", "periodic", "device", "labels"),
    vorocl.Simulation: ("grid", "bounds", "periodic", "tilt", "outside", "y_up", "snap", "device"),
}
RIGHT_VALUES = {"points": RIGHT, "grid": (8, 10), "shape": (8, 10), **dict.fromkeys(("mask", "input", "label_image", "labels", "a", "b"), LABELS)}
RIGHT_VALUES["outside"] = "refuse"
# What is right for one call alone.
ALLOWED = {(vorocl.Diagram, "labels"): [None], (vorocl.Simulation, "bounds"): [FAR_BOUNDS], (vorocl.Grid, "bounds"): [FAR_BOUNDS]}


def refused(call, *arguments, **named):
    try:
        result = call(*arguments, **named)
    except (vorocl.Error, TypeError) as error:
        assert "\n" not in str(error) and len(str(error)) > 10, repr(error)
        return
    raise AssertionError(f"{call} takes {arguments!r:.200} {named!r:.200} and gives {result!r:.200}")


def wrong_calls():
    for call, names in CALLS.items():
        required = {name: RIGHT_VALUES[name] for name in names if name in RIGHT_VALUES}
        if call is vorocl.Diagram:
            del required["labels"]
        if call is vorocl.exact_cells:
            required["bounds"] = (0, 0, 9.5, 7.5)  # ends are inside
        for name in names:
            for value in WRONG["a" if name == "b" else name]:
                if any(value is allowed for allowed in ALLOWED.get((call, name), [])):
                    continue
                yield call, {**required, name: value}


def test_a_thousand_wrong_calls():
    calls = list(wrong_calls())
    seeds, diagram = vorocl.Seeds(RIGHT, (8, 10), outside="refuse"), vorocl.Diagram((8, 10))
    simulation = vorocl.Simulation((8, 10), outside="refuse")
    for points in WRONG["points"]:
        calls += [(seeds.move_to, {"points": points}), (simulation.step, {"points": points})]
    for weights in WRONG["weights"]:
        calls += [(call, {"points": RIGHT, "weights": weights}) for call in (seeds.move_to, simulation.step)]
    for value in NO_NUMBERS + [1, RIGHT, diagram, vorocl.Seeds]:
        calls += [(diagram.fill, {"seeds": value})]
        if value is not None:
            calls += [(diagram.write, {"labels": LABELS, "seeds": value})]
    calls += [(diagram.write, {"labels": LABELS, "seeds": seeds, "metric": value}) for value in WRONG["metric"]]
    for name in "method", "metric", "max_displacement":
        fixed = {"seeds": seeds, "method": "djfa"}
        calls += [(diagram.fill, {**fixed, name: value}) for value in WRONG[name]]
    calls += [(diagram.read, {"out": value}) for value in WRONG["out"]]
    calls += [(diagram.write, {"labels": value}) for value in WRONG["labels"] + [np.zeros((3, 3), int)]]
    calls += [(vorocl.Device, {"request": value}) for value in NO_NUMBERS[:1] + NO_NUMBERS[2:] + ["none like this"]]
    calls += [(diagram.errors, {"truth": value}) for value in WRONG["truth"] if value is not None]
    calls += [(call, {}) for call in CALLS] + [(call, {"nonsense": 1}) for call in CALLS]
    assert len(calls) >= 1000
    random.Random(1).shuffle(calls)
    for call, arguments in calls:
        refused(call, **arguments)
    np.testing.assert_array_equal(vorocl.diagram(RIGHT, (8, 10)), brute_force(RIGHT, (8, 10)))
    diagram.fill(seeds)
    np.testing.assert_array_equal(diagram.read(), brute_force(RIGHT, (8, 10)))


def test_seeds_of_another_grid_are_refused():
    diagram = vorocl.Diagram((8, 10))
    for seeds in vorocl.Seeds(RIGHT, (10, 8)), vorocl.Seeds(RIGHT, (8, 10), periodic=(True, False)):
        with pytest.raises(vorocl.BadArgument, match="grid"):
            diagram.fill(seeds)
        with pytest.raises(vorocl.BadArgument, match="grid"):
            diagram.write(LABELS, seeds)
        for measure in diagram.distances, diagram.cells, diagram.adjacency, diagram.errors:
            with pytest.raises(vorocl.BadArgument, match="seeds"):
                measure()
