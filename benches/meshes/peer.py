"""One program on one mesh, in a process of its own: peer.py PROGRAM MESH.off SOLVES OUTPUT.f64."""

import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

Solve = Callable[[], np.ndarray]
Prepare = Callable[[np.ndarray, np.ndarray], Solve]


def potpourri3d(points: np.ndarray, faces: np.ndarray) -> Solve:
    """The heat method of geometry-central."""
    import potpourri3d

    solver = potpourri3d.MeshHeatMethodDistanceSolver(points, faces)
    return lambda: solver.compute_distance(0)


def potpourri3d_fmm(points: np.ndarray, faces: np.ndarray) -> Solve:
    """Fast marching of geometry-central."""
    import potpourri3d

    solver = potpourri3d.MeshFastMarchingDistanceSolver(points, faces)
    return lambda: solver.compute_distance([[(0, [])]])


def libigl(points: np.ndarray, faces: np.ndarray) -> Solve:
    """The heat method of libigl, with its intrinsic Delaunay triangulation."""
    import igl

    data = igl.HeatGeodesicsData()
    data.use_intrinsic_delaunay = True
    igl.heat_geodesics_precompute(points, faces, data)
    return lambda: igl.heat_geodesics_solve(data, np.array([0]))


def pygeodesic(points: np.ndarray, faces: np.ndarray) -> Solve:
    """Exact distances by Kirsanov's windows."""
    from pygeodesic import geodesic

    algorithm = geodesic.PyGeodesicAlgorithmExact(points, faces)
    return lambda: algorithm.geodesicDistances(np.array([0]), None)[0]


PROGRAMS: dict[str, Prepare] = {
    "potpourri3d": potpourri3d,
    "potpourri3d-fmm": potpourri3d_fmm,
    "libigl": libigl,
    "pygeodesic": pygeodesic,
}


def read_off(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return the points and triangles of a file that heatpath has written."""
    lines = path.read_text().split("\n")
    count, faces, _ = (int(word) for word in lines[1].split())
    points = np.array([line.split() for line in lines[2 : 2 + count]], dtype=float)
    rows = [line.split()[1:4] for line in lines[2 + count : 2 + count + faces]]
    return points, np.array(rows, dtype=np.int32)


def memory(name: str) -> float:
    """Return a line of /proc/self/status in MiB."""
    for line in Path("/proc/self/status").read_text().split("\n"):
        if line.startswith(name):
            return int(line.split()[1]) / 1024
    raise KeyError(name)


def main() -> None:
    """Prepare, solve, tell."""
    program, mesh, solves, output = sys.argv[1:]
    points, faces = read_off(Path(mesh))
    loaded = memory("VmRSS")
    start = time.perf_counter()
    solve = PROGRAMS[program](points, faces)
    distances = solve()
    first = time.perf_counter() - start
    times = []
    for _ in range(int(solves)):
        start = time.perf_counter()
        distances = solve()
        times.append(time.perf_counter() - start)
    np.asarray(distances, dtype=float).tofile(output)
    told = {"first": first, "solves": times, "memory": memory("VmHWM") - loaded}
    sys.stdout.write(json.dumps(told) + "\n")


if __name__ == "__main__":
    main()
