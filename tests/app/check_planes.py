"""Reads what vorocl tiles, and others of masks, write with Zarr and GDAL: check_planes.py COMMAND"""

import os
import subprocess
import sys
import tempfile

import numpy
import zarr
from osgeo import gdal, osr

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


def check_mask(system, transform, palette=False, point=False):
    """The mask's georeference, of its own kind, is that of all that is made of it, and of a part shifted."""
    height, width = 20, 40
    mask = gdal.GetDriverByName("GTiff").Create("mask.tif", width, height, 1, gdal.GDT_Byte)
    mask.SetGeoTransform(transform)
    mask.SetProjection(system)
    if point:
        mask.SetMetadataItem("AREA_OR_POINT", "Point")
    if palette:
        colors = gdal.ColorTable()
        colors.SetColorEntry(0, (0, 0, 0, 255))
        colors.SetColorEntry(1, (255, 0, 0, 255))
        mask.GetRasterBand(1).SetColorTable(colors)
    pixels = numpy.zeros((height, width), numpy.uint8)
    pixels[3, 5] = pixels[12, 33] = 1
    mask.GetRasterBand(1).WriteArray(pixels)
    mask = None
    run("tiles", "--mask", "mask.tif", "--tile", "16", "--labels", "l.tif", "--distance", "d.tif")
    run("render", "--mask", "mask.tif", "--labels", "r.tif")
    run("cells", "--mask", "mask.tif", "--distance", "c.tif")
    run("relax", "--mask", "mask.tif", "--rounds", "1", "--labels", "x.tif")
    x, y = 11, 7
    run("tiles", "--mask", "mask.tif", "--only", f"{x},{y},30,15", "--tile", "16", "--labels", "p.tif")
    x0, dx, rx, y0, ry, dy = transform
    shifted = (x0 + x * dx + y * rx, dx, rx, y0 + x * ry + y * dy, ry, dy)
    wanted = gdal.Open("mask.tif")
    for name in "l.tif", "d.tif", "r.tif", "c.tif", "x.tif", "p.tif":
        image = gdal.Open(name)
        place = shifted if name == "p.tif" else transform
        assert numpy.allclose(image.GetGeoTransform(), place, rtol=1e-12), (name, image.GetGeoTransform())
        assert image.GetProjection() == wanted.GetProjection(), (name, image.GetProjection())
        assert image.GetMetadataItem("AREA_OR_POINT") == wanted.GetMetadataItem("AREA_OR_POINT"), name
    whole, part = gdal.Open("l.tif"), gdal.Open("p.tif")
    assert whole.GetRasterBand(1).GetNoDataValue() == 0xFFFFFFFF
    assert numpy.array_equal(part.ReadAsArray(), whole.ReadAsArray()[y:15, x:30])


def check_masks():
    utm, own = osr.SpatialReference(), osr.SpatialReference()
    utm.ImportFromEPSG(32632)
    own.ImportFromProj4("+proj=laea +lat_0=12.5 +lon_0=7.25 +ellps=GRS80 +units=m")  # which the EPSG does not have
    north_up = (500000, 30, 0, 5000000, 0, -30)
    check_mask(utm.ExportToWkt(), north_up)
    check_mask(utm.ExportToWkt(), north_up, palette=True)
    check_mask(utm.ExportToWkt(), north_up, point=True)
    check_mask(own.ExportToWkt(), (1000.5, 24, 7, 2000, 7, -24))  # turned
    check_mask("", (3, 0.5, 0, 9, 0, -0.5))  # of no system


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    check_labels("300x200", 64)
    check_labels("128x128", 64)
    check_labels("30x20", 64)
    check_labels("400x1", 64)
    check_masks()

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
