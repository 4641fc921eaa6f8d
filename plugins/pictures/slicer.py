"""The data of the picture in docs/slicer.md: python slicer.py FOLDER

Makes a volume of vessels with noise; needs numpy, and the module HeatpathVesselTree in PATH.
"""

import subprocess
import sys

import numpy as np

SIZE = (110, 100, 80)
SPACING = (0.5, 0.5, 0.7)


def curve(start, bend, end):
    t = np.linspace(0, 1, 160)[:, None]
    return (1 - t) ** 2 * np.array(start) + 2 * t * (1 - t) * np.array(bend) + t**2 * np.array(end)


def add_vessel(volume, line, radii):
    for point, radius in zip(line, np.linspace(*radii, len(line))):
        box = tuple(
            slice(max(int(c - 4 * radius), 0), min(int(c + 4 * radius) + 2, n))
            for c, n in zip(point, SIZE)
        )
        squared = sum((axis - c) ** 2 for axis, c in zip(np.mgrid[box], point))
        volume[box] = np.maximum(volume[box], np.exp(-squared / (2 * (0.62 * radius) ** 2)))


def vessels():
    volume = np.zeros(SIZE)
    trunk = curve((6, 50, 14), (40, 72, 30), (58, 50, 38))
    left = curve((58, 50, 38), (70, 38, 42), (100, 20, 60))
    right = curve((58, 50, 38), (74, 64, 44), (102, 84, 40))
    side = curve(trunk[70], (36, 36, 40), (20, 14, 60))
    for line, radii in [
        (trunk, (4.2, 3.6)),
        (left, (3.2, 1.8)),
        (right, (3.0, 1.8)),
        (side, (2.8, 1.6)),
        (curve(left[70], (84, 46, 60), (96, 56, 74)), (2.4, 1.5)),
        (curve(right[60], (70, 82, 34), (62, 94, 14)), (2.4, 1.5)),
        (curve(side[90], (40, 18, 40), (58, 8, 22)), (2.2, 1.5)),
    ]:
        add_vessel(volume, line, radii)
    noise = np.random.default_rng(1).normal(0, 9, SIZE)
    return np.clip(30 + 170 * volume + noise, 0, 255).astype(np.uint8)


def write_nrrd(path, volume):
    header = (
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\n"
        "sizes: %d %d %d\nspace directions: (%g,0,0) (0,%g,0) (0,0,%g)\n"
        "kinds: domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n\n"
    )
    with open(path, "wb") as file:
        file.write((header % (SIZE + SPACING)).encode() + volume.tobytes(order="F"))


folder = sys.argv[1]
write_nrrd(folder + "/vessels.nrrd", vessels())
module = ["HeatpathVesselTree", folder + "/vessels.nrrd", folder + "/tree.vtp"]
subprocess.run([*module, "--scale", "0.7,1,1.5", "--prune", "4"], check=True)
