"""The filters of the plugin, run by pvpython: pvpython filters.py PLUGIN GEODESIC_PLUGIN FOLDER

Reads volume.vtk and mesh.vtk in FOLDER and prints one line for each array of results: its name and
its numbers.
"""

import sys

from paraview import servermanager
from paraview.simple import *

plugin, geodesic, folder = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())
LoadPlugin(geodesic, remote=False, ns=globals())


def show(name, array):
    count = array.GetNumberOfTuples() * array.GetNumberOfComponents()
    width = array.GetNumberOfComponents()
    numbers = (array.GetComponent(i // width, i % width) for i in range(count))
    print(name, *map(repr, numbers))


def point(x, y, z):
    return PointSource(Center=[x, y, z], NumberOfPoints=1, Radius=0)


def points(array, source, name):
    show(name, servermanager.Fetch(source).GetPointData().GetArray(array))


def lines(source, name):
    result = servermanager.Fetch(source)
    show(name + ".points", result.GetPoints().GetData())
    for array in ["end", "source", "length", "distance"]:
        show(name + "." + array, result.GetCellData().GetArray(array))


def refuses(source, name):
    """A filter that fails has no result."""
    source.UpdatePipeline()
    print(name, source.GetDataInformation().GetNumberOfPoints())


def stops(source, name):
    """A filter that is told to stop on the way has no result either."""
    told = []

    def watch(algorithm, _):
        told.append(algorithm.GetProgress())
        algorithm.SetAbortExecute(algorithm.GetProgress() > 0.3)

    source.GetClientSideObject().AddObserver("ProgressEvent", watch)
    source.UpdatePipeline()
    print(name, source.GetDataInformation().GetNumberOfPoints(), *told)


volume = LegacyVTKReader(FileNames=[folder + "/volume.vtk"])
image = {"Input": volume, "Scalars": ["POINTS", "grey"]}
source, ends = point(4, 5.25, 7.5), AppendDatasets(Input=[point(19, 16, 30), point(1, 2, 2.5)])
points("Distance", HeatpathDistance(Sources=source, **image), "heat")
combined = {"Medium": "Combined", "Power": 2, "Contrast": 0.05, "UseRange": 1, "Range": [0, 200]}
points("Distance", HeatpathDistance(Sources=source, **image, **combined), "combined")
tubes = {"Medium": "Vesselness", "Scales": [1.5, 2], "Polarity": "Dark", "Estimator": "Heat method"}
points("Distance", HeatpathDistance(Sources=source, **image, **tubes), "tubes")
lines(HeatpathPath(Sources=source, Ends=ends, **image), "path")
lines(HeatpathPath(Sources=source, Ends=ends, **image, Estimator="Eikonal"), "eikonal")
# A slice is a picture, whichever way it stands.
plane = ExtractSubset(Input=volume, VOI=[7, 7, 0, 16, 0, 12])
flat = HeatpathDistance(Input=plane, Scalars=["POINTS", "grey"], Sources=point(7, 3, 5))
points("Distance", flat, "flat")
points("grey", plane, "flat_grey")
refuses(HeatpathDistance(Sources=point(99, 0, 0), **image), "outside")
stops(HeatpathDistance(Sources=source, **image), "stopped")

mesh = LegacyVTKReader(FileNames=[folder + "/mesh.vtk"])
# Point sources are floats: these are numbers that floats have.
seed, far = point(0.875, 0.125, 0.25), point(-0.75, 0.25, -0.375)
for method in ["Exact", "Eikonal", "Heat method"]:
    name = "mesh_" + method.split()[0].lower()
    points("Distance", HeatpathMeshDistance(Input=mesh, Sources=seed, Method=method), name)
lines(HeatpathMeshPath(Input=mesh, Sources=seed, Ends=far, Shorten=1), "mesh_path")
corner = point(*servermanager.Fetch(mesh).GetPoint(0))
points("Distance", HeatpathMeshDistance(Input=mesh, Sources=corner), "corner")
theirs = FastMarchingGeodesicDistanceFieldFromBinaryField(
    Input=mesh, SeedsNonZeroField=["POINTS", "seed"]
)
points("DistanceField", theirs, "theirs")
