"""The widgets of napari: layers in, layers out; the work is done in a thread."""

import warnings

import numpy as np
from magicgui import magic_factory
from magicgui.widgets import PushButton
from napari.layers import Image, Labels, Points
from napari.qt.threading import FunctionWorker, create_worker
from napari.types import LayerDataTuple

from . import library


def distance_layer(image, sources, progress=None, **options):
    """The distances from the points of a layer, as the data of an image layer."""
    scene = _scene(image, sources, options)
    distances = library.distance(**scene, progress=progress)
    reached = distances[np.isfinite(distances)]
    limits = [0, max(reached.max(initial=0), 1e-9)]
    about = {"name": f"{image.name}: distance", "colormap": "viridis", "contrast_limits": limits}
    return distances, about | _place(image), "image"


def path_layer(image, sources, ends, progress=None, **options):
    """The paths from the points of a layer to those of another, as the data of a shapes layer."""
    scene = _scene(image, sources, options)
    found = library.paths(**scene, ends=_points(ends, image), progress=progress)
    paths = [path for path in found if path.reaches_source and len(path.points) > 1]
    if len(paths) < len(found):
        warnings.warn(f"{len(found) - len(paths)} of {len(found)} ends reach no source, or lie on one")
    numbers = {name: [getattr(path, name) for path in paths] for name in ("physical_length", "distance")}
    looks = {"shape_type": "path", "edge_color": "red", "edge_width": 1}
    about = {"name": f"{image.name}: paths", "features": numbers} | looks | _place(image)
    return [path.points for path in paths], about, "shapes"


def _scene(image, sources, options):
    if image.rgb:
        raise library.HeatpathError("the image is coloured: choose Split RGB and one of its channels")
    pixels = np.asarray(image.data[0] if image.multiscale else image.data)
    if pixels.dtype not in library.TYPES:
        pixels = pixels.astype(float)
    return {"image": pixels, "sources": _points(sources, image), "spacing": _spacing(image)} | options


def _spacing(image):
    """How far the pixels of a layer are from each other in the world, without the rounding of transforms."""
    steps = np.eye(image.ndim)
    lengths = [np.linalg.norm(_world(image, step) - _world(image, 0 * step)) for step in steps]
    return [float(f"{length:.9g}") for length in lengths]


def _world(layer, point):
    return np.asarray(layer.data_to_world(point))


def _points(points, image):
    """The points of a layer as pixels of the image, rounded as well."""
    if points.ndim != image.ndim:
        raise library.HeatpathError(f"{points.name} has {points.ndim} axes, but {image.name} {image.ndim}")
    return [np.round(image.world_to_data(_world(points, point)), 9) for point in points.data]


def _walls(walls, image):
    """The labels that are not 0, which must lie where the image does."""
    labels = np.asarray(walls.data[0] if walls.multiscale else walls.data)
    corners = [np.zeros(labels.ndim), np.array(labels.shape) - 1]
    near = 0.5 * min(_spacing(image))
    if walls.ndim != image.ndim or any(np.abs(_world(walls, c) - _world(image, c)).max() > near for c in corners):
        raise library.HeatpathError(f"{walls.name} lies elsewhere than {image.name}")
    return labels != 0


def _place(image):
    return {name: getattr(image, name) for name in ("scale", "translate", "rotate", "shear", "affine")}


def _run(
    image: Image,
    sources: Points,
    ends: Points,
    medium: str = "conductivity",
    estimator: str = "normalized",
    power: float = 0,
    contrast: float = 0,
    scale: str = "",
    iterations: int = 0,
    walls: Labels | None = None,
) -> FunctionWorker[LayerDataTuple]:
    numbers = {"power": power, "contrast": contrast, "iterations": iterations}
    options = {name: number for name, number in numbers.items() if number}
    options |= {"medium": medium, "estimator": estimator}
    if scale:
        options["scale"] = [float(number) for number in scale.split(",")]
    if walls is not None:
        options["mask"] = _walls(walls, image)
    if ends is None:
        return _worker(distance_layer, image, sources, **options)
    return _worker(path_layer, image, sources, ends, **options)


def _worker(compute, *layers, **options):
    """A thread that computes until it is asked to quit."""

    def work():
        try:
            return compute(*layers, progress=lambda _: worker.abort_requested, **options)
        except library.Cancelled:
            return None  # nobody waits for it

    # `work` knows it when it runs.
    worker = create_worker(work, _start_thread=False, _progress={"desc": "heatpath"})
    return worker


def _add_cancel(widget):
    """A button that stops the work, which begins when the widget is called."""
    button = PushButton(text="Cancel", enabled=False)
    widget.append(button)

    workers = []

    def begin(worker):
        workers.append(worker)
        worker.finished.connect(lambda: end(worker))
        button.enabled = True
        worker.start()

    def end(worker):
        workers.remove(worker)
        button.enabled = bool(workers)

    button.clicked.connect(lambda: [worker.quit() for worker in workers])
    widget.called.connect(begin)


LOOKS = {
    "widget_init": _add_cancel,
    "medium": {"choices": [name for name in library.WORDS["medium"] if name != "given"]},
    "estimator": {"choices": list(library.WORDS["estimator"])},
    "power": {"tooltip": "How strongly unlike grey values, or weak tubes, are held back; 0: the usual"},
    "contrast": {"tooltip": "The change of grey value that holds heat back, or that of a full tube; 0: the usual"},
    "scale": {"tooltip": "Half widths of the tubes to look for, with commas, in pixels; none: the usual"},
    "iterations": {"tooltip": "Time steps of heat; 0: the usual", "max": 10**9},
    "walls": {"tooltip": "Labels whose zeros are walls"},
}
distance_widget = magic_factory(_run, call_button="Find distances", ends={"bind": None}, **LOOKS)
path_widget = magic_factory(_run, call_button="Find paths", **LOOKS)
