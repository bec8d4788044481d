"""Reads the labels that vorocl tiles writes with Zarr and GDAL: check_planes.py COMMAND"""

import os
import subprocess
import sys
import tempfile

import numpy
import zarr
from osgeo import gdal

gdal.UseExceptions()
command = os.path.abspath(sys.argv[1])


def run(*arguments):
    result = subprocess.run([command, *arguments], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


def check_labels(size, tile):
    seeds = ["--random", "300", "--size", size]
    run("render", *seeds, "--labels", "whole.npy")
    whole = numpy.load("whole.npy")
    for name in "a.npy", f"{size}.zarr", "a.tif":
        run("tiles", *seeds, "--tile", str(tile), "--labels", name)
    assert numpy.array_equal(numpy.load("a.npy"), whole)
    array = zarr.open(f"{size}.zarr", "r")
    assert array.dtype == numpy.uint32 and array.fill_value == 2**32 - 1
    assert array.chunks == tuple(min(tile, side) for side in whole.shape)
    assert array.nchunks_initialized == array.nchunks
    assert numpy.array_equal(array[:], whole)
    image = gdal.Open("a.tif")
    band = image.GetRasterBand(1)
    assert band.DataType == gdal.GDT_UInt32
    assert band.GetBlockSize() == [min(tile, (side + 15) // 16 * 16) for side in reversed(whole.shape)]
    assert image.GetMetadata("IMAGE_STRUCTURE")["COMPRESSION"] == "DEFLATE"
    assert numpy.array_equal(image.ReadAsArray(), whole)


def check_place(options, crs, transform, corner):
    run("tiles", "--points", "p.csv", "--tile", "32", "--labels", "g.tif", "--crs", f"EPSG:{crs}", *options)
    image = gdal.Open("g.tif")
    assert numpy.allclose(image.GetGeoTransform(), transform, rtol=1e-12), image.GetGeoTransform()
    assert image.GetSpatialRef().GetAuthorityCode(None) == str(crs), image.GetProjection()
    assert image.GetMetadataItem("AREA_OR_POINT") == "Area"
    assert image.GetRasterBand(1).GetNoDataValue() == 0xFFFFFFFF
    assert image.ReadAsArray()[0, 0] == corner


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    check_labels("300x200", 64)
    check_labels("128x128", 64)
    check_labels("30x20", 64)
    check_labels("400x1", 64)

    with open("p.csv", "w", encoding="ascii") as file:
        file.write("x,y\n500010,5000010\n500090,5000060\n")
    unknown = [command, "tiles", "--points", "p.csv", "--size", "9x9", "--bounds", "0,0,1,1", "--labels", "g.tif"]
    result = subprocess.run([*unknown, "--crs", "EPSG:1025"], capture_output=True, text=True)
    assert result.returncode == 2 and len(result.stderr.splitlines()) == 1, result.stderr  # PROJ prints nothing
    utm = ["--bounds", "500000,5000000,500100,5000070", "--size", "200x140"]
    check_place([*utm, "--y-up"], 32632, (500000, 0.5, 0, 5000070, 0, -0.5), 0)
    check_place(utm, 32632, (500000, 0.5, 0, 5000000, 0, 0.5), 0)
    # A part of it, whose corner is in the other cell.
    part = ["--only", "150,20,200,120"]
    check_place([*utm, *part, "--y-up"], 32632, (500075, 0.5, 0, 5000060, 0, -0.5), 1)
    check_place([*utm, *part], 32632, (500075, 0.5, 0, 5000010, 0, 0.5), 1)
    with open("p.csv", "w", encoding="ascii") as file:
        file.write("x,y\n10,10\n-100,-50\n")
    world = ["--bounds=-180,-90,180,90", "--size", "360x180", "--periodic", "x", "--y-up"]
    check_place(world, 4326, (-180, 1, 0, 90, 0, -1), 1)
