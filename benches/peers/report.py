"""What is told: a dated page with tables, and every single number for programs."""

import json
import os
import platform
import subprocess
from dataclasses import asdict
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

from programs import library
from rounds import Comparison, Result

PACKAGES = ("scikit-fmm", "eikonalfm", "pyekfmm", "itk-filtering", "scikit-image", "FastGeodis")
PACKAGES += ("scikit-sparse", "numpy", "scipy")
BASELINES = ("heatpath, 1 thread", "heatpath, all threads")
EXPLANATION = """
Seconds on the wall: the median of the rounds and, in brackets, the quartiles. The next two columns
are the time divided by heatpath's: the median of the ratios of each round, above 1 where heatpath
is faster. Deviation: mean relative difference, beyond 10 cells from the source, from factored fast
marching of order 2 on a grid up to 4 times finer; in the uniform and the growing square from the
exact distance.
""".strip()


def machine() -> dict[str, str]:
    """Say where this runs, and how busy it is."""
    return {
        "processor": processor(),
        "cores": str(os.cpu_count()),
        "kernel": f"{platform.system()} {platform.release()}",
        "load average at the start": f"{os.getloadavg()[0]:.1f}",
        "OMP_NUM_THREADS": os.environ.get("OMP_NUM_THREADS", "not set"),
    }


def processor() -> str:
    """Return the model of the processor."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    return next(models, platform.processor())


def versions() -> dict[str, str]:
    """Return the version of everything that takes part."""
    found = {"heatpath": f"{library().version()} ({revision()})"}
    found["Python"] = platform.python_version()
    for package in PACKAGES:
        try:
            found[package] = metadata.version(package)
        except metadata.PackageNotFoundError:
            found[package] = "not installed"
    return found


def revision() -> str:
    """Return the commit of heatpath."""
    command = ["git", "describe", "--always", "--dirty"]
    try:
        return subprocess.run(command, capture_output=True, check=True, text=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return "unknown commit"


def markdown(facts: dict[str, str], comparisons: dict[str, Comparison]) -> str:
    """Return the whole page."""
    parts = [f"# Side by side, {datetime.now(UTC):%Y-%m-%d}", bullets(facts), EXPLANATION]
    parts += [section(name, comparison) for name, comparison in comparisons.items()]
    return "\n\n".join(parts) + "\n"


def bullets(facts: dict[str, str]) -> str:
    """Return one line a fact."""
    return "\n".join(f"- {name}: {value}" for name, value in facts.items())


def section(name: str, comparison: Comparison) -> str:
    """Return the table of one case."""
    rounds = max((len(result.seconds) for result in comparison.results.values()), default=0)
    baselines = [comparison.results.get(name) for name in BASELINES]
    lines = [
        f"## {name}, rounds: {rounds}",
        "",
        "| program | seconds | / heatpath, 1 thread | / heatpath, all threads | deviation |",
        "| --- | --- | --- | --- | --- |",
    ]
    lines += [row(name, result, baselines) for name, result in comparison.results.items()]
    if comparison.not_run:
        lines += ["", "Not run:", "", bullets(comparison.not_run)]
    return "\n".join(lines)


def row(name: str, result: Result, baselines: list[Result | None]) -> str:
    """Return the line of one program."""
    low, median, high = result.quartiles()
    cells = [name, f"{median:.3g} ({low:.3g} to {high:.3g})"]
    cells += ["" if other is None else f"{result.ratio(other):.2f}" for other in baselines]
    return f"| {' | '.join([*cells, deviation(result)])} |"


def deviation(result: Result) -> str:
    """Return the deviation in per cent, and how much has no value."""
    if result.deviation is None:
        return ""
    missing = f", {result.not_reached:.1%} not reached" if result.not_reached else ""
    return f"{100 * result.deviation:.2g} %{missing}"


def raw(facts: dict[str, str], comparisons: dict[str, Comparison]) -> str:
    """Return every single number as JSON."""
    cases = {name: asdict(comparison) for name, comparison in comparisons.items()}
    return json.dumps({"facts": facts, "cases": cases}, indent=1) + "\n"
