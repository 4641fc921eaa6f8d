"""heatpath on arrays of numpy, bit for bit as the command: python library.py COMMAND FOLDER

Needs numpy alone, heatpath_napari in PYTHONPATH, and the library in HEATPATH_LIBRARY.
"""

import csv
import subprocess
import sys
from pathlib import Path

import numpy as np
from heatpath_napari import library

COMMAND, FOLDER = sys.argv[1], Path(sys.argv[2])


def tube(*shape):
    """A bright tube that winds through a picture or volume."""
    *rest, rows, x = np.indices(shape)
    across = (rows - shape[-2] / 2 - 4 * np.sin(0.25 * x)) ** 2
    if rest:
        across = across + (rest[0] - shape[0] / 2 - 3 * np.cos(0.2 * x)) ** 2
    return 20 + 200 * np.exp(-across / 6)


def command(words, pixels, output):
    np.save(FOLDER / "input.npy", pixels)
    arguments = [COMMAND, *words.split(), "--quiet", "--force", "-o", str(FOLDER / output)]
    subprocess.run([*arguments, str(FOLDER / "input.npy")], check=True)
    return FOLDER / output


def read(words):
    """The points and options in the words of the command, as the library takes them."""
    given = {"source": [], "end": []}
    for name, value in zip(words.split()[::2], words.split()[1::2]):
        name = name.removeprefix("--").replace("-", "_")
        if name in ("source", "end"):
            given[name].append(numbers(value)[::-1])
        else:
            given[name] = value if name in library.WORDS else numbers(value)
    if "spacing" in given:
        given["spacing"] = given["spacing"][::-1]
    return {name: value for name, value in given.items() if value != []}


def numbers(text):
    values = [float(number) if "." in number else int(number) for number in text.split(",")]
    return values if len(values) > 1 else values[0]


def same_distances(words, pixels):
    expected = np.load(command(f"distance {words}", np.ascontiguousarray(pixels), "distance.npy"))
    options = read(words)
    found = library.distance(pixels, options.pop("source"), **options)
    assert found.dtype == expected.dtype and found.tobytes() == expected.tobytes(), words
    assert np.isfinite(found).any()


def same_paths(words, pixels):
    file = command(f"path {words}", np.ascontiguousarray(pixels), "path.csv")
    rows = list(csv.reader(file.read_text().splitlines()))[1:]
    options = read(words)
    paths = library.paths(pixels, options.pop("source"), options.pop("end"), **options)
    assert all(path.reaches_source and len(path.points) > 10 for path in paths)
    points = [(str(i), *point[::-1]) for i, path in enumerate(paths) for point in path.points]
    expected = [(row[0], *map(float, row[2 : 2 + pixels.ndim])) for row in rows]
    assert points == expected, words


MEDIA = (
    "uniform",
    "conductivity --power 4 --floor 0.01",
    "perona-malik --contrast 0.05 --edge-stop rational --form pointwise",
    "combined --power 4 --range 10,200 --iterations 300 --edge-stop exponential --form divergence",
    "edges --smooth 1.5 --normalize 8",
    "tensor --tensor structure --anisotropy 0.8",
    "tensor --tensor gradient --scale 1.5",
    "tensor --tensor hessian --polarity both",
    "vesselness --polarity dark --elongation 2",
    "vesselness --scale 1.5,2 --polarity bright",
)
METHODS = (
    "--estimator normalized --solver explicit --step 0.1",
    "--estimator varadhan",
    "--estimator heat-method",
    "--estimator eikonal --farthest 40",
    "--solver implicit --time 4.0",
)


def results_are_those_of_the_command():
    picture, volume = tube(40, 60), tube(16, 20, 24)
    for kind in "u1", "u2", "i2", "f4", "f8":
        same_distances("--source 3,20 --source 50,7", picture.astype(kind))
    for medium in MEDIA:
        same_distances(f"--medium {medium} --source 3,20", picture)
    for method in METHODS:
        same_distances(f"{method} --source 3,20", picture)
    same_paths("--power 4 --source 3,20 --end 40,20 --end 30,22.5", picture)
    words = "--medium vesselness --scale 1.5,2 --spacing 0.5,1,1.5 --source 1,11,10.5"
    same_distances(words, volume)
    same_paths(f"{words} --end 22,8,7", volume)


def strides_are_read_where_they_are():
    large = np.zeros((80, 60, 3))
    view = large[::-2, :, 1]
    view[:] = tube(40, 60)
    assert library._buffer(view).data == view.ctypes.data
    same_distances("--source 3,20", view)
    same_distances("--source 20,3", view.T)
    same_distances("--source 3,4", np.broadcast_to(view[20], (9, 60)))


def masks_are_walls():
    mask = np.ones((40, 60), bool)
    mask[:, 30] = False
    found = library.distance(tube(40, 60), [(20, 3)], mask=mask, medium="uniform", estimator="eikonal")
    assert np.isinf(found[:, 30:]).all() and abs(found[20, 23] - 20) < 1e-9


def refusal(*arguments, kind=library.HeatpathError, **options):
    try:
        library.distance(*arguments, **options)
    except kind as error:
        return str(error)
    raise AssertionError("this must be refused")


def mistakes_are_told():
    picture = tube(40, 60)
    assert "outside" in refusal(picture, [(20, 90)])
    assert "vesselness" in refusal(picture, [(20, 3)], medium="vessels")
    assert "int64" in refusal(picture.astype("i8"), [(20, 3)])
    assert "4 axes" in refusal(np.zeros((2, 2, 2, 2)), [(0, 0, 0, 0)])
    assert "no option" in refusal(picture, [(20, 3)], kind=TypeError, powder=3)
    assert "2 coordinates" in refusal(picture, [(1, 2, 3), (4, 5, 6)])


def work_can_be_stopped():
    told = []
    refusal(
        tube(40, 60),
        [(20, 3)],
        iterations=10**9,
        kind=library.Cancelled,
        progress=lambda finished: told.append(finished) or len(told) == 3,
    )
    assert len(told) == 3 and told == sorted(told)

    def broken(_):
        raise ZeroDivisionError("for this test")

    assert "this test" in refusal(tube(40, 60), [(20, 3)], kind=ZeroDivisionError, progress=broken)


results_are_those_of_the_command()
strides_are_read_where_they_are()
masks_are_walls()
mistakes_are_told()
work_can_be_stopped()
