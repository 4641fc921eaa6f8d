"""heatpath and other programs on the same meshes, each in a process of its own."""

import argparse
import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from peer import read_off

HERE = Path(__file__).parent
HEATPATH = os.environ["HEATPATH_MESHES"]
CGAL = os.environ.get("CGAL_HEAT")
PEER = [sys.executable, str(HERE / "peer.py")]
SMALL = 50_000


@dataclass
class Program:
    """How a program is run."""

    name: str
    before: list[str]
    after: list[str]
    is_slow: bool = False


PROGRAMS = [
    Program("heatpath, heat method", [HEATPATH, "heat"], ["1"]),
    Program("heatpath, heat method, 2 threads", [HEATPATH, "heat"], ["2"]),
    Program("CGAL, heat method", [CGAL or ""], []),
    Program("libigl, heat method", [*PEER, "libigl"], []),
    Program("potpourri3d, heat method", [*PEER, "potpourri3d"], []),
    Program("heatpath, fast marching", [HEATPATH, "eikonal"], ["1"]),
    Program("potpourri3d, fast marching", [*PEER, "potpourri3d-fmm"], []),
    Program("heatpath, exact", [HEATPATH, "exact"], ["1"], is_slow=True),
    Program("pygeodesic, exact", [*PEER, "pygeodesic"], [], is_slow=True),
]


def sphere(points: np.ndarray) -> np.ndarray:
    """Return great circles from the first point."""
    return 2 * np.arcsin(np.clip(np.linalg.norm(points - points[0], axis=1) / 2, 0, 1))


def plane(points: np.ndarray) -> np.ndarray:
    """Return straight distances from the first point."""
    return np.linalg.norm(points - points[0], axis=1)


EXACT: dict[str, Callable[[np.ndarray], np.ndarray]] = {"icosphere": sphere, "plane": plane}


def main() -> None:
    """Compare, and write a page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--shapes", nargs="+", default=["icosphere-6", "icosphere-7", "plane-200"])
    parser.add_argument("--rounds", type=int, default=3, help="processes for each program")
    parser.add_argument("--solves", type=int, default=5, help="further solves a process")
    parser.add_argument("--output", type=Path, help="page to write")
    parser.add_argument("--work", type=Path, default=Path("target/mesh-peers"))
    arguments = parser.parse_args()
    page = [head()]
    for shape in arguments.shapes:
        mesh = arguments.work / f"{shape}.off"
        subprocess.run([HEATPATH, "make", shape, str(mesh)], check=True)
        page.append(table(shape, mesh, arguments))
    text = "\n".join(page)
    sys.stdout.write(text)
    if arguments.output:
        arguments.output.write_text(text)


def head() -> str:
    """Return what was measured where."""
    cpu = next(
        line.split(":")[1].strip()
        for line in Path("/proc/cpuinfo").read_text().split("\n")
        if line.startswith("model name")
    )
    today = datetime.datetime.now(tz=datetime.UTC).date()
    return (
        f"# Meshes side by side\n\nMade by `benches/meshes/run` on {today}: {cpu}, {os.cpu_count()} "
        f"processors, {platform.system()}. Medians; one thread unless said "
        "otherwise. *Prepare* is the time until the first distances less one solve; *memory* is "
        "what a process takes beyond the mesh; errors are relative, of all vertices but the source.\n"
    )


def table(shape: str, mesh: Path, arguments: argparse.Namespace) -> str:
    """Return the table of one mesh."""
    points, faces = read_off(mesh)
    lines = [
        f"## {shape}: {len(points):,} vertices, {len(faces):,} triangles\n",
        "| program | prepare s | solve s | memory MiB | mean error % | largest error % |",
        "| --- | ---: | ---: | ---: | ---: | ---: |",
    ]
    exact = EXACT[shape.split("-")[0]](points)
    for program in PROGRAMS:
        if program.before[0] and not (program.is_slow and len(points) > SMALL):
            lines.append(row(program, mesh, exact, arguments))
            sys.stderr.write(lines[-1] + "\n")
    return "\n".join(lines) + "\n"


def row(program: Program, mesh: Path, exact: np.ndarray, arguments: argparse.Namespace) -> str:
    """Run one program and return its line."""
    output = arguments.work / "distances.f64"
    command = [*program.before, str(mesh), str(arguments.solves), str(output), *program.after]
    told = []
    for _ in range(arguments.rounds):
        done = subprocess.run(command, check=True, capture_output=True, text=True)
        told.append(json.loads(done.stdout.strip().split("\n")[-1]))
    solve = statistics.median([time for run in told for time in run["solves"]])
    first = statistics.median([run["first"] for run in told])
    memory = statistics.median([run["memory"] for run in told])
    found = np.fromfile(output)[: len(exact)]
    errors = 100 * np.abs(found[1:] / exact[1:] - 1)
    return (
        f"| {program.name} | {max(first - solve, 0):.2f} | {solve:.3f} | {memory:.0f} "
        f"| {errors.mean():.3f} | {errors.max():.2f} |"
    )


if __name__ == "__main__":
    main()
