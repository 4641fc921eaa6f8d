"""The data of the picture in docs/paraview.md: pvpython paraview.py PLUGIN FOLDER"""

import sys

from paraview.simple import *

plugin, folder = sys.argv[1:]
LoadPlugin(plugin, remote=False, ns=globals())


def points(*places):
    return AppendDatasets(
        Input=[PointSource(Center=place, NumberOfPoints=1, Radius=0) for place in places]
    )


sphere = Sphere(Radius=1, ThetaResolution=260, PhiResolution=260)
dents = "0.16*sin(5*coordsX)*cos(4*coordsY+1)+0.1*sin(6*coordsZ)"
dented = Calculator(Input=sphere, ResultArrayName="dents", Function=dents)
surface = WarpByScalar(Input=dented, Scalars=["POINTS", "dents"], ScaleFactor=1)
source = points((0.2, -0.9, 0.75))
ends = points((-1, -0.6, -0.5), (1.1, -0.3, -0.3), (0.3, -0.9, -0.8))
SaveData(folder + "/surface.vtp", HeatpathMeshDistance(Input=surface, Sources=source))
path = HeatpathMeshPath(Input=surface, Sources=source, Ends=ends, Method="Exact", Shorten=1)
SaveData(folder + "/paths.vtp", path)
