"""What is computed: pictures, the medium that they make, and the distance that is right."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy import ndimage
from skimage import data, io, transform

RETINA = Path(__file__).parents[2] / "examples/data/retina.jpg"
POWER = 3
FLOOR = 1e-3
# The grid of the reference is finer by a whole factor, but has no more cells than this.
REFERENCE_CELLS = 17_000_000
FINEST = 4
# Next to the source all programs are wrong, each in its own way; this is about the rest.
NEAR_CELLS = 10


@dataclass(frozen=True)
class Problem:
    """A picture with grey values from 0 to 1, and a source on one of its cells (numpy's order)."""

    picture: np.ndarray
    source: tuple[int, ...]
    uniform: bool = False
    # The right distance, where the picture is the conductivity itself.
    given: np.ndarray | None = None

    @cached_property
    def conductivity(self) -> np.ndarray:
        """Equation (6) of the paper; 1 if the problem is uniform."""
        if self.uniform:
            return np.ones_like(self.picture)
        if self.given is not None:
            return self.picture
        return (1 - np.abs(self.picture[self.source] - self.picture)) ** POWER + FLOOR

    @cached_property
    def speed(self) -> np.ndarray:
        """The speed whose travel time is the distance of the metric ds / sqrt(k)."""
        return np.sqrt(self.conductivity)

    @cached_property
    def from_source(self) -> np.ndarray:
        """The straight distance from the source, in cells."""
        offsets = np.indices(self.picture.shape) - np.reshape(
            self.source, (-1,) + (1,) * self.picture.ndim
        )
        return np.sqrt((offsets**2).sum(axis=0))

    @cached_property
    def reference(self) -> np.ndarray:
        """The distance that others are compared with."""
        if self.given is not None:
            return self.given
        return self.from_source if self.uniform else refined_distance(self)

    def deviation(self, distance: np.ndarray) -> tuple[float, float]:
        """Return the mean relative deviation from the reference, and the share without a value."""
        far = self.from_source > NEAR_CELLS
        values, right = distance[far], self.reference[far]
        reached = np.isfinite(values)
        relative = np.abs(values[reached] - right[reached]) / right[reached]
        return float(relative.mean()), float(1 - reached.mean())


def refined_distance(problem: Problem) -> np.ndarray:
    """Solve on a finer grid, speed interpolated linearly, by factored fast marching of order 2."""
    factor = refinement(problem.picture.shape)
    fine_shape = [factor * (side - 1) + 1 for side in problem.picture.shape]
    zoom = [fine / side for fine, side in zip(fine_shape, problem.picture.shape, strict=True)]
    speed = ndimage.zoom(problem.speed, zoom, order=1)
    distance = factored_fast_marching(speed, tuple(factor * i for i in problem.source), 2)
    return distance[(slice(None, None, factor),) * distance.ndim] / factor


def refinement(shape: tuple[int, ...]) -> int:
    """How many times finer the grid of the reference is."""
    largest = (REFERENCE_CELLS / np.prod(shape)) ** (1 / len(shape))
    return max(1, min(FINEST, int(largest)))


def factored_fast_marching(speed: np.ndarray, source: tuple[int, ...], order: int) -> np.ndarray:
    """Fast marching that is exact where the speed is constant."""
    import eikonalfm

    spacing = (1.0,) * speed.ndim
    factor = eikonalfm.factored_fast_marching(speed, source, spacing, order)
    return factor * eikonalfm.distance(speed.shape, spacing, source, indexing="ij")


def uniform(side: int) -> Problem:
    """A square without anything in it; the right distance is known."""
    return Problem(np.zeros((side, side)), (side * 3 // 8, side // 3), uniform=True)


def growing(side: int, dimension: int = 2) -> Problem:
    """A square or cube in which the speed grows from 1/3 to 1; the source is in the middle.

    In a constant gradient of the speed the distance has a closed form (Treister & Haber 2016).
    """
    gradient = 2 / 3 / (side - 1)
    speed = np.broadcast_to(1 / 3 + gradient * np.arange(side), (side,) * dimension).copy()
    source = ((side - 1) // 2,) * dimension
    problem = Problem(speed**2, source)
    growth = (gradient * problem.from_source) ** 2 / (2 * speed * speed[source])
    return replace(problem, given=np.arccosh(1 + growth) / gradient)


def camera(side: int) -> Problem:
    """The photographer of scikit-image; the source is on his coat."""
    return Problem(resized(data.camera() / 255, side), (side * 3 // 5, side * 2 // 5))


def retina(side: int) -> Problem:
    """The example picture of heatpath; the source is on a vessel."""
    green = io.imread(RETINA)[..., 1] / 255
    column, row = (round(i * side / len(green)) for i in (300, 411))
    return Problem(resized(green, side), (row, column))


def volume(side: int) -> Problem:
    """Smooth noise in space; the source is in the middle."""
    noise = np.random.default_rng(1).standard_normal((side, side, side))
    smooth = ndimage.gaussian_filter(noise, side / 32, mode="nearest")
    return Problem((smooth - smooth.min()) / np.ptp(smooth), (side // 2,) * 3)


def resized(picture: np.ndarray, side: int) -> np.ndarray:
    """Return `picture` as a square of this many pixels a side."""
    return transform.resize(picture, (side, side), anti_aliasing=side < len(picture))


PROBLEMS: dict[str, Callable[[], Problem]] = {
    "uniform-1024": lambda: uniform(1024),
    "growing-1024": lambda: growing(1024),
    "camera-512": lambda: camera(512),
    "camera-1024": lambda: camera(1024),
    "camera-2048": lambda: camera(2048),
    "retina-512": lambda: retina(512),
    "retina-1024": lambda: retina(1024),
    "retina-2048": lambda: retina(2048),
    "volume-128": lambda: volume(128),
    "growing-volume-128": lambda: growing(128, 3),
    "sources-512": lambda: camera(512),
}
QUICK = ["camera-512", "retina-512", "volume-128"]
