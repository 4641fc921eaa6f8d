"""Distances and paths on arrays of numpy, by the C library of heatpath.

Arrays are read where they are, whatever their strides. Axes and coordinates are in the order of numpy: (slice,)
row, column. The structs and numbers are those of include/heatpath.h. The library is `libheatpath.so.0` where the
system finds it, or the file named by `HEATPATH_LIBRARY`.
"""

import ctypes
import os
from ctypes import byref, c_double, c_int64, c_uint32, c_uint64, c_void_p
from functools import cache
from typing import NamedTuple

import numpy as np

TYPES = {np.dtype(name): i + 1 for i, name in enumerate("u1 i1 u2 i2 u4 i4 f4 f8".split())}
MEDIA = "uniform conductivity perona-malik combined edges given given-tensor tensor vesselness".split()
WORDS = {
    "medium": {name: i + 1 for i, name in enumerate(MEDIA) if name != "given-tensor"},
    "estimator": {"normalized": 1, "varadhan": 2, "eikonal": 3, "heat-method": 4},
    "solver": {"explicit": 0, "implicit": 1},
    "tensor": {"hessian": 0, "structure": 1, "gradient": 2},
    "polarity": {"bright": 1, "dark": 2, "both": 3},
    "edge_stop": {"exponential": 1, "rational": 2},
    "form": {"divergence": 1, "pointwise": 2},
}
NUMBERS = (
    "power floor contrast smooth iterations time step threads reference farthest anisotropy elongation "
    "normalize margin"
).split()
CANCELLED = 6
ENDED_SOURCE = 1


class HeatpathError(Exception):
    """What the library says is wrong."""


class Cancelled(HeatpathError):
    """The work was asked to stop."""


class Path(NamedTuple):
    """A minimal path."""

    points: np.ndarray  # from the end to the source, one a row
    reaches_source: bool
    length: float  # in pixels
    physical_length: float
    distance: float  # of the end from the sources
    cost: float  # the length in the metric of the medium: the distance, of a shortest path


def _struct(declarations):
    """A struct with fields as C declares them."""
    types = {"u32": c_uint32, "u64": c_uint64, "i64": c_int64, "f64": c_double, "pointer": c_void_p}
    types |= {f"{name}[3]": kind * 3 for name, kind in types.items()}
    fields = []
    for declaration in declarations.split(";"):
        kind, names = declaration.split(maxsplit=1)
        fields += [(name.strip(), types[kind]) for name in names.split(",")]
    return type("Struct", (ctypes.Structure,), {"_fields_": fields})


_Buffer = _struct(
    "u32 struct_size, type, dimension, reserved; pointer data; u64[3] size; i64[3] byte_stride; f64[3] spacing"
)
_Options = _struct(
    "u32 struct_size, medium; f64 power, floor, contrast; u32 edge_stop, form; f64 smooth, range_low,"
    "range_high; u64 iterations; f64 time, step; u32 estimator, threads; pointer progress, user;"
    "u32 solver, reserved; f64 reference; u64 memory; f64 farthest; pointer tensor_data; u64 tensor_count;"
    "u32 tensor, polarity; f64 anisotropy; pointer scales; u64 scale_count;"
    "f64 elongation, normalize, margin"
)
_PathInfo = _struct(
    "u32 struct_size, ending; i64 source; u64 point_count; f64 length, physical_length, distance, cost"
)
_Progress = ctypes.CFUNCTYPE(ctypes.c_int, c_double, c_void_p)


@cache
def _library():
    library = ctypes.CDLL(os.environ.get("HEATPATH_LIBRARY", "libheatpath.so.0"))
    library.hp_version_string.restype = library.hp_last_error_message.restype = ctypes.c_char_p
    version = library.hp_version_string().decode()
    if not version.startswith("0.1."):
        raise HeatpathError(f"libheatpath is version {version}, but 0.1 is needed")
    return library


def _check(status):
    if status:
        message = _library().hp_last_error_message().decode()
        raise (Cancelled if status == CANCELLED else HeatpathError)(message)


def _buffer(array, spacing=None):
    if array.dtype == bool:
        array = array.view("u1")
    if array.dtype not in TYPES:
        raise HeatpathError(f"pixels are {array.dtype}, but can be {', '.join(map(str, TYPES))}")
    if array.ndim not in (2, 3):
        raise HeatpathError(f"the array has {array.ndim} axes, but pictures have 2 and volumes 3")
    if 0 in array.strides:  # to the library that means "without gaps"
        array = np.ascontiguousarray(array)
    buffer = _Buffer()
    _check(_library().hp_buffer_init(byref(buffer), c_uint32(ctypes.sizeof(buffer))))
    buffer.array = array  # lives as long
    buffer.type, buffer.dimension, buffer.data = TYPES[array.dtype], array.ndim, array.ctypes.data
    buffer.size[: array.ndim] = array.shape[::-1]
    buffer.byte_stride[: array.ndim] = array.strides[::-1]
    buffer.spacing[: array.ndim] = tuple(spacing if spacing is not None else [1] * array.ndim)[::-1]
    return buffer


def _points(points, dimension):
    """The two arguments for points."""
    points = np.asarray(points, dtype=float)
    if points.size and points.shape[-1] != dimension:
        raise HeatpathError(f"points are {points.shape}, but must have {dimension} coordinates each")
    points = points.reshape(-1, dimension)[:, ::-1].copy()
    return points.ctypes.data_as(c_void_p), c_uint64(len(points))


def _options(progress, given):
    options = _Options()
    _check(_library().hp_options_init(byref(options), c_uint32(ctypes.sizeof(options))))
    options.raised = []
    if progress:
        options.callback = _Progress(lambda finished, _: _stops(progress, finished, options.raised))
        options.progress = ctypes.cast(options.callback, c_void_p)
    for name, value in given.items():
        if name == "range":
            options.range_low, options.range_high = value
        elif name == "scale":
            options.array = np.array(value, dtype=float).reshape(-1)
            options.scales, options.scale_count = options.array.ctypes.data, len(options.array)
        elif name in WORDS:
            if value not in WORDS[name]:
                raise HeatpathError(f"{name} is {value!r}, but can be {', '.join(WORDS[name])}")
            setattr(options, name, WORDS[name][value])
        elif name in NUMBERS:
            setattr(options, name, value)
        else:
            raise TypeError(f"there is no option {name}")
    return options


def _stops(progress, finished, raised):
    """Whether `progress` wants the work to stop; what it raises must wait until the library has returned."""
    try:
        return bool(progress(finished))
    except BaseException as error:
        raised.append(error)
        return True


def _check_work(status, options):
    if options.raised:
        raise options.raised[0]
    _check(status)


def _scene(image, sources, spacing, mask, progress, options):
    """The arguments that all functions begin with, and the options."""
    buffer = _buffer(image, spacing)
    walls = byref(_buffer(mask)) if mask is not None else None
    return (byref(buffer), walls, *_points(sources, image.ndim)), _options(progress, options)


def distance(image, sources, *, spacing=None, mask=None, progress=None, **options):
    """The distance of each pixel from the nearest of `sources`; infinite where none is reached.

    `spacing` is the size of a pixel along each axis, 1 each by default, and pixels of `mask` that are 0 are
    walls. `progress` is called with the finished part, from 0 to 1, and stops the work by a true answer.
    `options` are those of the command `heatpath`, with `_` for `-`: see `WORDS` and `NUMBERS`, `range` and `scale`.
    """
    scene, options = _scene(image, sources, spacing, mask, progress, options)
    result = np.empty(image.shape)
    status = _library().hp_distance(*scene, byref(options), byref(_buffer(result)))
    _check_work(status, options)
    return result


def paths(image, sources, ends, *, spacing=None, mask=None, progress=None, **options):
    """The minimal `Path` from each of `ends` to one of `sources`; otherwise as `distance`."""
    scene, options = _scene(image, sources, spacing, mask, progress, options)
    handle = c_void_p()
    ends, count = _points(ends, image.ndim)
    status = _library().hp_paths_create(*scene, ends, count, byref(options), byref(handle))
    _check_work(status, options)
    try:
        return [_path(handle, i, image.ndim) for i in range(count.value)]
    finally:
        _library().hp_paths_free(handle)


def _path(handle, index, dimension):
    info = _PathInfo(struct_size=ctypes.sizeof(_PathInfo))
    _check(_library().hp_paths_info(handle, c_uint64(index), byref(info)))
    points = np.empty((info.point_count, dimension))
    place = points.ctypes.data_as(c_void_p)
    _check(_library().hp_paths_points(handle, c_uint64(index), place, c_uint64(info.point_count)))
    lengths = info.length, info.physical_length, info.distance, info.cost
    return Path(points[:, ::-1], info.ending == ENDED_SOURCE, *lengths)
