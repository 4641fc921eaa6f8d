"""The widgets in napari itself, which needs a screen: python widgets.py [PICTURE]

The result is in layers; with PICTURE, the window is drawn into that file.
"""

import sys
import warnings

import napari
import numpy as np
from heatpath_napari import library, widgets
from qtpy.QtCore import QTimer
from qtpy.QtWidgets import QApplication


def wait(widget):
    """Until the button that stops the work has nothing to stop."""
    while widget[-1].enabled:
        QApplication.processEvents()
    QApplication.processEvents()


def curve():
    rows, columns = np.indices((120, 160))
    distance = np.abs(rows - 60 - 25 * np.sin(columns / 20))
    noise = np.random.default_rng(1).normal(0, 12, rows.shape)
    return np.clip(60 + 140 * (distance < 3) + noise, 0, 255).astype("u1")


def results_are_layers(viewer, image, sources, ends):
    _, distance = viewer.window.add_plugin_dock_widget("heatpath-napari", "Distance")
    distance(image=image, sources=sources)
    wait(distance)
    found = viewer.layers[-1]
    expected = library.distance(image.data, sources.data, spacing=image.scale)
    assert found.data.tobytes() == expected.tobytes() and tuple(found.scale) == tuple(image.scale)

    _, path = viewer.window.add_plugin_dock_widget("heatpath-napari", "Path")
    path(image=image, sources=sources, ends=ends, estimator="eikonal", power=6)
    wait(path)
    found = viewer.layers[-1]
    options = {"spacing": image.scale, "estimator": "eikonal", "power": 6}
    (expected,) = library.paths(image.data, sources.data, ends.data, **options)
    assert np.array_equal(found.data[0], expected.points.astype("f4")) and list(found.shape_type) == ["path"]
    assert found.features["physical_length"][0] == expected.physical_length
    return distance


def work_can_be_cancelled(viewer, distance, image, sources):
    layers = len(viewer.layers)
    distance(image=image, sources=sources, iterations=10**9)
    QTimer.singleShot(0, distance[-1].native.click)
    wait(distance)
    assert len(viewer.layers) == layers


def points_are_in_the_world():
    """A layer that is turned, stretched and shifted, and points of one that is not."""
    pixels = curve()
    image = napari.layers.Image(pixels, scale=(2, 0.5), rotate=30, translate=(7, -3))
    world = napari.layers.Points([image.data_to_world((60, 2))])
    data, about, kind = widgets.distance_layer(image, world, estimator="eikonal")
    expected = library.distance(pixels, [(60, 2)], spacing=(2, 0.5), estimator="eikonal")
    assert kind == "image" and np.allclose(data, expected, atol=1e-5)
    again = napari.layers.Layer.create(data, about, kind)
    assert np.allclose(again.data_to_world((5, 6)), image.data_to_world((5, 6)))
    with warnings.catch_warnings(record=True) as told:
        paths = widgets.path_layer(image, world, world)[0]
    assert paths == [] and "lie on one" in str(told[0].message)
    coloured = napari.layers.Image(np.zeros((9, 9, 3)), rgb=True)
    try:
        widgets.distance_layer(coloured, world)
    except library.HeatpathError as error:
        assert "Split RGB" in str(error)
    else:
        raise AssertionError("colours must be refused")


points_are_in_the_world()
viewer = napari.Viewer(show=len(sys.argv) > 1)
image = viewer.add_image(curve(), name="curve", scale=(0.8, 0.8))
sources = viewer.add_points([(60, 2)], name="sources", scale=image.scale, face_color="red", size=5)
ends = viewer.add_points([(84, 150)], name="ends", scale=image.scale, size=5)
distance = results_are_layers(viewer, image, sources, ends)
work_can_be_cancelled(viewer, distance, image, sources)
if len(sys.argv) > 1:
    viewer.layers["curve: distance"].opacity = 0.5
    viewer.layers.move_multiple([1, 2], -1)
    viewer.window.resize(1150, 720)
    QApplication.processEvents()
    viewer.reset_view()
    viewer.screenshot(sys.argv[1], canvas_only=False)
viewer.close()
