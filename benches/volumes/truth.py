#!/usr/bin/env python3
"""Paths and trees in volumes against what is known of them: the tables of docs/volumes.md.

    cargo build --release -p heatpath-cli
    pip install pyvista
    python3 benches/volumes/truth.py HELIX AORTA NEURONS

HELIX is the folder with Synthetic-04.mhd and Synthetic-04-Tube.mhd of ITKMinimalPathExtraction, AORTA the one
with aorta.mha and aorta-centerline.vtp of VMTK's tutorial, NEURONS one with a folder for each stack of the
Snake-for-Neuron-Tracing set, which holds NAME.tif and NAME.swc.
"""

import pathlib
import subprocess
import sys
import tempfile

HEATPATH = pathlib.Path(__file__).resolve().parents[2] / "target/release/heatpath"


def heatpath(*words):
    return subprocess.run([HEATPATH, *map(str, words)], check=True, capture_output=True, text=True).stdout


def write_swc(points, file):
    """A line from the first point to the last, nobody knows how thick."""
    rows = [f"{i + 1} 2 {x} {y} {z} 1 {i if i else -1}" for i, (x, y, z) in enumerate(points)]
    pathlib.Path(file).write_text("\n".join(rows) + "\n")


def evaluate(extracted, truth, *tolerances):
    words = [word for tolerance in tolerances for word in ("--tolerance", tolerance)]
    print(heatpath("evaluate", "--extracted", extracted, "--truth", truth, *words))


def path(folder, truth, volume, *words):
    """Traces a path between the ends of a line; says how far the two are from each other."""
    line, found = f"{folder}/line.swc", f"{folder}/path.swc"
    write_swc(truth, line)
    source, end = (",".join(map(str, truth[i])) for i in (0, -1))
    heatpath("path", volume, *words, f"--source={source}", f"--end={end}", "--force", "-o", found)
    evaluate(found, line, 2)


def helix(folder, data):
    rows = (data / "Synthetic-04-Tube.mhd").read_text().split("Points")[-1].splitlines()
    points = [list(map(float, row.split()[:3])) for row in rows if len(row.split()) > 5]
    words = "--medium vesselness --scale 2,3.5,5 --estimator eikonal".split()
    path(folder, points, data / "Synthetic-04.mhd", *words)


def aorta(folder, data):
    import pyvista

    lines = pyvista.read(data / "aorta-centerline.vtp")
    for number in range(lines.n_cells):
        # They are RAS, the volume is LPS.
        points = lines.get_cell(number).points * [-1, -1, 1]
        words = "--physical --medium vesselness --scale 4,6,8 --estimator eikonal".split()
        path(folder, points.tolist(), data / "aorta.mha", *words)


def neurons(folder, data):
    for stack in sorted(data.iterdir()):
        for command in ("vote", "keypoints"):
            volume, truth, found = stack / f"{stack.name}.tif", stack / f"{stack.name}.swc", f"{folder}/tree.swc"
            options = "--medium vesselness --scale 1,1.5,2 --quiet --force".split()
            heatpath(command, volume, *options, "-o", found)
            print(stack.name, command)
            evaluate(found, truth, 2, 3)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for check, data in zip((helix, aorta, neurons), sys.argv[1:]):
            print(f"== {check.__name__}")
            check(folder, pathlib.Path(data))


if __name__ == "__main__":
    main()
