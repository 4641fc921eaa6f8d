"""The pictures in docs/paraview.md and docs/slicer.md: python render.py FOLDER

Draws what paraview.py and slicer.py have left in FOLDER; needs pyvista, and no window.
"""

import sys

import pyvista

folder = sys.argv[1]


def plotter():
    plot = pyvista.Plotter(off_screen=True, window_size=(1000, 800))
    plot.set_background("white")
    plot.enable_anti_aliasing("ssaa")
    return plot


def bar(title):
    return {"title": title, "color": "black", "n_labels": 3, "fmt": "%.1f", "width": 0.3,
            "position_x": 0.35, "position_y": 0.01, "height": 0.07}


def paraview():
    plot = plotter()
    surface = pyvista.read(folder + "/surface.vtp").compute_normals(split_vertices=False)
    paths = pyvista.read(folder + "/paths.vtp")
    plot.add_mesh(surface, scalars="Distance", clim=(0, 2.4), n_colors=24, smooth_shading=True,
                  ambient=0.25, scalar_bar_args=bar("Distance"))
    plot.add_mesh(paths.tube(radius=0.014), color="white", ambient=0.4)
    plot.add_mesh(pyvista.Sphere(radius=0.035, center=paths.points[-1]), color="red")
    plot.camera_position = [(0.6, -4.9, 1.1), (0, 0, -0.12), (0, 0, 1)]
    plot.screenshot(folder + "/paraview.jpg")


def slicer():
    plot = plotter()
    grid = pyvista.read(folder + "/vessels.nrrd")
    surface = grid.contour([95], scalars=grid.array_names[0]).smooth(n_iter=60)
    tree = pyvista.read(folder + "/tree.vtp")
    tubes = tree.tube(scalars="radius", absolute=True, radius_factor=1)
    plot.add_mesh(surface, color="#c05040", opacity=0.22, smooth_shading=True)
    plot.add_mesh(tubes, scalars="radius", cmap="viridis", scalar_bar_args=bar("Radius, mm"))
    plot.camera_position = [(27, -75, 75), (27, 25, 26), (0, 0, 1)]
    plot.screenshot(folder + "/slicer.jpg")


paraview()
slicer()
