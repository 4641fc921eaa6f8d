"""The C library of heatpath through ctypes; the structs are those of include/heatpath.h."""

import ctypes
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from ctypes import byref, c_double, c_int32, c_int64, c_uint32, c_uint64, c_void_p
from pathlib import Path
from typing import TypeVar

import numpy as np

ABI_VERSION = 0
OK = 0
UNSUPPORTED = 9
F64 = 8
MEDIUM_UNIFORM = 1
MEDIUM_CONDUCTIVITY = 2
MEDIUM_GIVEN = 6
SOLVER_IMPLICIT = 1
NORMALIZED = 1
EIKONAL = 3

Struct = TypeVar("Struct", bound=ctypes.Structure)


class Buffer(ctypes.Structure):
    """hp_buffer."""

    _fields_ = (
        ("struct_size", c_uint32),
        ("type", c_uint32),
        ("dimension", c_uint32),
        ("reserved", c_uint32),
        ("data", c_void_p),
        ("size", c_uint64 * 3),
        ("byte_stride", c_int64 * 3),
        ("spacing", c_double * 3),
    )


class Options(ctypes.Structure):
    """hp_options."""

    _fields_ = (
        ("struct_size", c_uint32),
        ("medium", c_uint32),
        ("power", c_double),
        ("floor", c_double),
        ("contrast", c_double),
        ("edge_stop", c_uint32),
        ("form", c_uint32),
        ("smoothing", c_double),
        ("range_low", c_double),
        ("range_high", c_double),
        ("iterations", c_uint64),
        ("time", c_double),
        ("step", c_double),
        ("estimator", c_uint32),
        ("threads", c_uint32),
        ("progress", c_void_p),
        ("user", c_void_p),
        ("solver", c_uint32),
        ("reserved", c_uint32),
        ("reference", c_double),
        ("memory", c_uint64),
        ("farthest", c_double),
        ("tensor", c_void_p),
        ("tensor_count", c_uint64),
    )


class Library:
    """libheatpath, loaded into this process."""

    def __init__(self, path: Path) -> None:
        """Load the library at `path` and declare what is called."""
        self._library = ctypes.CDLL(str(path.resolve()))
        for name in ("version_string", "last_error_message", "status_name"):
            self._function(name).restype = ctypes.c_char_p
        self._function("distance").argtypes = (
            *(c_void_p, c_void_p, c_void_p),
            *(c_uint64, c_void_p, c_void_p),
        )
        self._function("solver_create").argtypes = (c_void_p,) * 4
        self._function("solver_free").argtypes = (c_void_p,)
        self._function("solver_free").restype = None
        self._function("solver_distances").argtypes = (
            *(c_void_p, c_void_p, c_uint64),
            *(c_void_p, c_void_p, c_int64),
        )
        if self._function("abi_version")() != ABI_VERSION:
            raise RuntimeError("libheatpath has another binary interface than this program")

    def version(self) -> str:
        """Return the version of the library."""
        return self._function("version_string")().decode()

    def distance(
        self,
        picture: np.ndarray,
        source: tuple[int, ...],
        medium: int,
        threads: int,
        estimator: int = NORMALIZED,
    ) -> np.ndarray:
        """Return the distance of every pixel from `source`, both in numpy's order of axes."""
        result = np.empty_like(picture)
        options = self._options(medium, threads)
        options.estimator = estimator
        self._check(
            self._function("distance")(
                byref(self._buffer(picture)),
                None,
                (c_double * len(source))(*reversed(source)),
                1,
                byref(options),
                byref(self._buffer(result)),
            )
        )
        return result

    @contextmanager
    def prepared(self, picture: np.ndarray, reference: float, threads: int) -> Iterator[c_void_p]:
        """Prepare implicit heat in the conductivity of `picture`, until the block ends."""
        options = self._options(MEDIUM_CONDUCTIVITY, threads)
        options.solver, options.reference = SOLVER_IMPLICIT, reference
        solver = c_void_p()
        create = self._function("solver_create")
        self._check(create(byref(self._buffer(picture)), None, byref(options), byref(solver)))
        try:
            yield solver
        finally:
            self._function("solver_free")(solver)

    def distances(
        self, solver: c_void_p, sources: np.ndarray, maps: np.ndarray, threads: int
    ) -> None:
        """Fill a map for each of `sources`, in numpy's order of axes."""
        if len(maps) != len(sources) or not maps.flags.c_contiguous:
            raise ValueError("there must be a map for each source, one after the other")
        points = np.ascontiguousarray(sources[:, ::-1], dtype=float)
        options = self._options(MEDIUM_CONDUCTIVITY, threads)
        self._check(
            self._function("solver_distances")(
                solver,
                points.ctypes.data,
                len(points),
                byref(options),
                byref(self._buffer(maps[0])),
                0,
            )
        )

    def _options(self, medium: int, threads: int) -> Options:
        options = self._initialised(Options, "options_init")
        options.medium, options.threads = medium, threads
        options.range_low, options.range_high = 0.0, 1.0
        return options

    def _buffer(self, array: np.ndarray) -> Buffer:
        buffer = self._initialised(Buffer, "buffer_init")
        buffer.type, buffer.dimension, buffer.data = F64, array.ndim, array.ctypes.data
        buffer.size[: array.ndim] = array.shape[::-1]
        return buffer

    def _initialised(self, struct: type[Struct], init: str) -> Struct:
        """Return a struct filled by the library, which refuses a size it does not know."""
        value = struct()
        self._check(self._function(init)(byref(value), c_uint32(ctypes.sizeof(struct))))
        if value.struct_size != ctypes.sizeof(struct):
            raise RuntimeError(f"{struct.__name__} differs from include/heatpath.h")
        return value

    def _check(self, status: int) -> None:
        if status == OK:
            return
        message = self._function("last_error_message")().decode()
        if status == UNSUPPORTED:
            raise NotImplementedError(f"not supported by this build: {message}")
        name = self._function("status_name")(c_int32(status)).decode()
        raise RuntimeError(f"{name}: {message}")

    def _function(self, name: str) -> Callable:
        return getattr(self._library, f"hp_{name}")
