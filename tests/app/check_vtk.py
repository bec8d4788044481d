"""Runs the command and compares what VTK reads of its .vti and .pvd files with what NumPy reads of its .npy files."""
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLUnstructuredGridReader

WIDTH, HEIGHT = 61, 47


def check(condition, what):
    if not condition:
        sys.exit("check_vtk.py: " + what)


def read_image(path):
    reader = vtkXMLImageDataReader()
    check(reader.CanReadFile(str(path)), f"{path} is no file that VTK can read")
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def read_vti(path):
    """The name and the values of the cell data."""
    image = read_image(path)
    check(image.GetBounds() == (0, WIDTH, 0, HEIGHT, 0, 0), f"{path} has the bounds {image.GetBounds()}")
    array = image.GetCellData().GetScalars()
    values = vtk_to_numpy(array).reshape(HEIGHT, WIDTH)
    check(image.GetCell(WIDTH + 2).GetBounds() == (2, 3, 1, 2, 0, 0), f"{path} has its cells elsewhere")
    return array.GetName(), values


def check_same(vti, npy, name):
    found, values = read_vti(vti)
    expected = numpy.load(npy)
    check(found == name, f"{vti} holds {found}")
    check(values.dtype == expected.dtype, f"{vti} holds {values.dtype}, {npy} {expected.dtype}")
    check(numpy.array_equal(values, expected), f"{vti} and {npy} differ")


def check_volume(command, folder):
    """A volume lies where its data lies."""
    (folder / "p.csv").write_text("x,y,z\n1,2,3\n4,9,-0.5\n2,7,1\n")
    for extension in ("vti", "npy"):
        subprocess.run(
            [command, "cells", f"--points={folder}/p.csv", "--size", "10x20x12", "--bounds=0,0,-1,5,10,5", "--method", "jfa"] +
            [f"--{kind}={folder}/volume_{kind}.{extension}" for kind in ("labels", "distance")],
            check=True, stdout=subprocess.DEVNULL)
    for kind, array in (("labels", "label"), ("distance", "distance")):
        image = read_image(folder / f"volume_{kind}.vti")
        check(image.GetBounds() == (0, 5, 0, 10, -1, 5), f"the volume of {kind} has the bounds {image.GetBounds()}")
        check(image.GetCellData().GetScalars().GetName() == array, f"the volume of {kind} has another name")
        values = vtk_to_numpy(image.GetCellData().GetScalars()).reshape(12, 20, 10)
        check(numpy.array_equal(values, numpy.load(folder / f"volume_{kind}.npy")), f"the volumes of {kind} differ")


def check_polyhedra(command, folder):
    """VTK finds polyhedra whose faces enclose the volumes that their array has."""
    path = folder / "cells.vtu"
    numpy.save(folder / "p.npy", numpy.random.default_rng(5).uniform(0, 3, (200, 3)))
    subprocess.run([command, "cells", "--exact", f"--points={folder}/p.npy", "--periodic", "xyz", f"--polygons={path}",
                    "--bounds", "0,0,0,3,3,3"], check=True, stdout=subprocess.DEVNULL)
    reader = vtkXMLUnstructuredGridReader()
    check(reader.CanReadFile(str(path)), f"{path} is no file that VTK can read")
    reader.SetFileName(str(path))
    reader.Update()
    cells = reader.GetOutput()
    volumes, neighbours = (vtk_to_numpy(cells.GetCellData().GetArray(name)) for name in ("volume", "neighbours"))
    check(len(volumes) == 200 and abs(volumes.sum() - 27) < 1e-11, "the polyhedra do not fill the box")
    for i in range(200):
        cell = cells.GetCell(i)
        check(cell.GetCellType() == 42 and cell.GetNumberOfFaces() == neighbours[i], f"polyhedron {i} has other faces")
        enclosed = 0
        for face in range(cell.GetNumberOfFaces()):
            corners = vtk_to_numpy(cell.GetFace(face).GetPoints().GetData())
            for j in range(1, len(corners) - 1):
                enclosed += numpy.linalg.det(corners[[0, j, j + 1]]) / 6
        check(abs(enclosed - volumes[i]) < 1e-12, f"polyhedron {i} has another volume")


def main():
    command = sys.argv[1]
    seeds = ["--random", "40", "--size", f"{WIDTH}x{HEIGHT}"]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for extension in ("vti", "npy"):
            subprocess.run(
                [command, "cells", *seeds] + [f"--{kind}={folder}/{kind}.{extension}"
                                              for kind in ("labels", "distance", "border")],
                check=True, stdout=subprocess.DEVNULL)
            subprocess.run(
                [command, "simulate", *seeds, "--frames", "4", "--step-length", "3", "--method", "exact", "--every", "2",
                 f"--labels={folder}/frame_%03d.{extension}"],
                check=True, stdout=subprocess.DEVNULL)
        for kind, array in (("labels", "label"), ("distance", "distance"), ("border", "border")):
            check_same(folder / f"{kind}.vti", folder / f"{kind}.npy", array)
        entries = ElementTree.parse(folder / "frame.pvd").getroot().findall("Collection/DataSet")
        check([float(entry.get("timestep")) for entry in entries] == [0, 2, 4], "frame.pvd has other time steps")
        for entry in entries:
            path = folder / entry.get("file")
            check_same(path, path.with_suffix(".npy"), "label")
        check_volume(command, folder)
        check_polyhedra(command, folder)


main()
