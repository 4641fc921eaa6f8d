#!/usr/bin/env python3
"""Trees of vessels, found by themselves, against an observer's centrelines: a table in Markdown.

    cargo build --release -p heatpath-cli
    python3 benches/extraction/trees.py DATA [METHOD ...]

The folder DATA holds `retina_chase` and `retina_stare`, each with `images`, `centerline` and `fov_png`.
One set of options serves all pictures. What is measured and what comes out stands in
`docs/extraction.md`.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HEATPATH = Path(__file__).parents[2] / "target/release/heatpath"
TOLERANCES = (1, 2, 3)
SETS = {"CHASE_DB1": "retina_chase", "STARE": "retina_stare"}

PICTURE = "--channel green --margin 4 --normalize 15 --threads 2"
MEDIUM = "--medium vesselness --polarity dark --elongation 3"
SCALES = "--scale 2,3,4.5"
METHODS = {
    "votes, accumulated": "vote",
    "votes, accumulated, `--scale auto`": "vote --scale auto",
    "votes, multiple": "vote --method multiple",
    "votes, front": "vote --method front",
    "votes, accumulated, the paper's rules": "vote --no-growth",
    "votes, multiple, the paper's rules": "vote --no-growth --method multiple",
    "votes, front, the paper's rules": "vote --no-growth --method front",
    "votes, fast marching, random ends": "vote --method random",
    "votes, fast marching, ends at the border": "vote --method border",
    "key points, heat": "keypoints",
    "key points, length (fast marching)": "keypoints --method length",
}


def heatpath(arguments):
    done = subprocess.run([HEATPATH, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"heatpath {' '.join(map(str, arguments))}\n{done.stderr}")
    return done.stdout


def scores(folder, picture, command, scratch):
    """Recall and precision at each tolerance, and the seconds of the extraction."""
    name, output = picture.stem, Path(scratch) / "tree.json"
    view, truth = folder / "fov_png" / f"{name}.png", folder / "centerline" / f"{name}.png"
    verb, *options = f"{command} {'' if '--scale' in command else SCALES}".split()
    start = time.perf_counter()
    heatpath([verb, picture, "--mask", view, *PICTURE.split(), *MEDIUM.split(), *options,
              "-o", output, "--force", "--quiet"])
    seconds = time.perf_counter() - start
    tolerances = [part for tolerance in TOLERANCES for part in ("--tolerance", tolerance)]
    found = json.loads(heatpath(["evaluate", "--extracted", output, "--truth", truth,
                                 "--mask", view, "--json", *tolerances]))
    return [(score["recall"], score["precision"]) for score in found], seconds


def main():
    data, methods = Path(sys.argv[1]), sys.argv[2:] or METHODS
    for title, folder in SETS.items():
        pictures = sorted((data / folder / "images").iterdir())
        print(f"\n{title}, {len(pictures)} pictures\n")
        print("| method |" + "".join(f" {t} px |" for t in TOLERANCES) + " worst, 3 px | seconds |")
        print("| --- |" + " --- |" * (len(TOLERANCES) + 2))
        for method in methods:
            with tempfile.TemporaryDirectory() as scratch:
                found = [scores(data / folder, p, METHODS[method], scratch) for p in pictures]
            mean = [[100 * statistics.mean(s[0][t][i] for s in found) for i in (0, 1)] for t in range(3)]
            worst = [100 * min(s[0][2][i] for s in found) for i in (0, 1)]
            cells = [f"{recall:.1f} / {precision:.1f}" for recall, precision in [*mean, worst]]
            seconds = statistics.median(s[1] for s in found)
            print(f"| {method} | " + " | ".join(cells) + f" | {seconds:.1f} |", flush=True)


if __name__ == "__main__":
    main()
