#!/usr/bin/env python3
"""A path through a volume: heatpath next to ITK and scikit-fmm, in one run.

    pip install -r benches/volumes/requirements.txt
    cargo build --release -p heatpath-cli
    python3 benches/volumes/path.py [SIDE]

The volume is a bright helix in noise, SIDE^3 voxels (256) of 8 bits; the path leads from one end of the
helix to the other. The medium is the conductivity of heatpath's default with a power of 6, which the others
get as a speed. Each program runs in a process of its own and reads the same file; times are without loading
Python's packages, memory is the process's at its peak. ITK marches and traces back (SpeedFunctionToPathFilter), scikit-fmm,
which has no paths, only marches, to first order as ITK and to second order as heatpath.
"""

import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy

HEATPATH = pathlib.Path(__file__).resolve().parents[2] / "target/release/heatpath"
POWER, FLOOR = 6, 1e-3


def helix(side):
    """The volume, and its centreline from end to end."""
    turns = numpy.linspace(0, 6 * numpy.pi, 25 * side)
    centre, radius = side / 2, 0.31 * side
    line = numpy.stack([centre + radius * numpy.cos(turns), centre + radius * numpy.sin(turns),
                        side * (0.11 + 0.78 * turns / turns[-1])], axis=1)
    distance = numpy.full((side,) * 3, 99.0, numpy.float32)
    near = numpy.mgrid[-7:8, -7:8, -7:8]
    for x, y, z in line:
        cell = [int(z), int(y), int(x)]
        place = tuple(slice(i - 7, i + 8) for i in cell)
        offset = [near[a] + cell[a] - p for a, p in enumerate((z, y, x))]
        distance[place] = numpy.minimum(distance[place], numpy.sqrt(sum(o * o for o in offset)))
    noise = numpy.random.default_rng(1).normal(0, 8, distance.shape)
    values = 20 + 200 * numpy.clip(1.5 - distance / 5, 0, 1) + noise
    return numpy.clip(values, 0, 255).astype(numpy.uint8), line


def speed(values, start):
    grey = values.astype(numpy.float32) / 255
    x, y, z = start
    return numpy.sqrt(numpy.abs(1 - numpy.abs(grey[z, y, x] - grey)) ** POWER + FLOOR)


def with_itk(file, start, end):
    import itk

    kind = itk.SpeedFunctionToPathFilter[itk.Image[itk.F, 3], itk.PolyLineParametricPath[3]]
    information = itk.SpeedFunctionPathInformation[itk.Point[itk.D, 3]].New()
    optimizer = itk.RegularStepGradientDescentOptimizer.New()
    began = time.perf_counter()
    image = itk.image_from_array(speed(numpy.load(file), start))
    tracer = kind.New(Input=image)
    information.SetStartPoint([float(i) for i in start])
    information.SetEndPoint([float(i) for i in end])
    tracer.AddPathInformation(information)
    optimizer.SetNumberOfIterations(100000)
    optimizer.SetMaximumStepLength(0.5)
    optimizer.SetMinimumStepLength(0.1)
    optimizer.SetRelaxationFactor(0.5)
    tracer.SetOptimizer(optimizer)
    tracer.SetTerminationValue(2.0)
    tracer.Update()
    return time.perf_counter() - began


def with_skfmm(file, start, order):
    import skfmm

    began = time.perf_counter()
    values = numpy.load(file)
    phi = numpy.ones(values.shape)
    phi[start[::-1]] = -1
    skfmm.travel_time(phi, speed(values, start), order=order)
    return time.perf_counter() - began


def with_heatpath(file, start, end, more):
    point = [",".join(str(i) for i in p) for p in (start, end)]
    words = ["path", file, "--spacing", "1,1,1", "--power", str(POWER), "--source", point[0], "--end", point[1],
             "--threads", "2", "--quiet", "--force", "-o", f"{file}.json", *more]
    began = time.perf_counter()
    subprocess.run([HEATPATH, *words], check=True)
    return time.perf_counter() - began


RUNS = {
    "heatpath, fast marching": lambda f, a, b: with_heatpath(f, a, b, ["--estimator", "eikonal"]),
    "heatpath, heat": lambda f, a, b: with_heatpath(f, a, b, []),
    "ITK, MinimalPathExtraction": with_itk,
    "scikit-fmm, order 1": lambda f, a, b: with_skfmm(f, a, 1),
    "scikit-fmm, order 2": lambda f, a, b: with_skfmm(f, a, 2),
}


def measure(name, file, start, end):
    words = [sys.executable, __file__, "--run", name, file, *map(str, start + end)]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        return f"failed: {done.stderr.strip().splitlines()[-1]}"
    seconds, kilobytes = done.stdout.split()[-2:]
    return f"{float(seconds):6.1f} s {int(kilobytes) / 1024:6.0f} MiB"


def main():
    if sys.argv[1:2] == ["--run"]:
        point = [int(i) for i in sys.argv[4:]]
        seconds = RUNS[sys.argv[2]](sys.argv[3], tuple(point[:3]), tuple(point[3:]))
        children = sys.argv[2].startswith("heatpath")
        who = resource.RUSAGE_CHILDREN if children else resource.RUSAGE_SELF
        print(seconds, resource.getrusage(who).ru_maxrss)
        return
    side = int(sys.argv[1]) if len(sys.argv) > 1 else 256
    values, line = helix(side)
    start, end = [tuple(int(i) for i in line[n]) for n in (0, -1)]
    with tempfile.TemporaryDirectory() as folder:
        file = f"{folder}/helix.npy"
        numpy.save(file, values)
        for name in RUNS:
            print(f"{name:28} {measure(name, file, start, end)}", flush=True)


if __name__ == "__main__":
    main()
