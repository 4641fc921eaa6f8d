"""Who is compared: each program prepares a problem and returns what is then timed."""

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heatpath import (
    EIKONAL,
    MEDIUM_CONDUCTIVITY,
    MEDIUM_GIVEN,
    MEDIUM_UNIFORM,
    NORMALIZED,
    Library,
)
from problems import Problem, factored_fast_marching

Timed = Callable[[], np.ndarray | None]


@dataclass(frozen=True)
class Program:
    """A program under test."""

    name: str
    # Outside the clock; raises if the program is not there or cannot do it.
    prepare: Callable[[Problem], Timed]


def library() -> Library:
    """Return the libheatpath that `run` has built."""
    return Library(Path(os.environ["HEATPATH_LIBRARY"]))


def heatpath(threads: int, estimator: int = NORMALIZED) -> Callable[[Problem], Timed]:
    """From the picture: medium, and distance by heat or exactly. No thread outlives the call."""
    loaded = library()

    def prepare(problem: Problem) -> Timed:
        medium = MEDIUM_UNIFORM if problem.uniform else MEDIUM_CONDUCTIVITY
        if problem.given is not None:
            medium = MEDIUM_GIVEN
        return lambda: loaded.distance(
            problem.picture, problem.source, medium, threads, estimator
        )

    return prepare


def scikit_fmm(order: int) -> Callable[[Problem], Timed]:
    """From the speed."""

    def prepare(problem: Problem) -> Timed:
        import skfmm

        outside = np.ones_like(problem.speed)
        outside[problem.source] = 0
        return lambda: skfmm.travel_time(outside, problem.speed, order=order)

    return prepare


def eikonalfm_factored(problem: Problem) -> Timed:
    """From the speed; the product with the straight distance is inside the clock."""
    return lambda: factored_fast_marching(problem.speed, problem.source, 2)


def pyekfmm(problem: Problem) -> Timed:
    """From the speed; the copy to float32 in Fortran's order is its own."""
    from pyekfmm import eikonal

    shape = problem.speed.shape
    axes = [[0, 1, side] for side in (*shape, 1)[:3]]
    source = np.array((*problem.source, 0)[:3], dtype=float)

    def run() -> np.ndarray:
        times = eikonal(problem.speed, source, *axes, order=2)
        return times.reshape(shape, order="F")

    return run


def itk(problem: Problem) -> Timed:
    """From the speed as an image of float32."""
    import itk

    dimension = problem.speed.ndim
    speed = problem.speed.astype(np.float32)
    image = itk.Image[itk.F, dimension]
    node = itk.LevelSetNode[itk.F, dimension]()
    node.SetValue(0)
    node.SetIndex([int(i) for i in reversed(problem.source)])
    nodes = itk.VectorContainer[itk.UI, itk.LevelSetNode[itk.F, dimension]].New()
    nodes.InsertElement(0, node)

    def run() -> np.ndarray:
        marching = itk.FastMarchingImageFilter[image, image].New(itk.image_view_from_array(speed))
        marching.SetTrialPoints(nodes)
        marching.Update()
        return itk.array_from_image(marching.GetOutput())

    return run


def scikit_image(problem: Problem) -> Timed:
    """From the cost of a step; the shortest way along pixels and their diagonals."""
    from skimage.graph import MCP_Geometric

    cost = 1 / problem.speed
    return lambda: MCP_Geometric(cost, fully_connected=True).find_costs([problem.source])[0]


def fastgeodis(problem: Problem) -> Timed:
    """From a picture whose grey values weigh nothing; in torch's float32."""
    if not problem.uniform:
        raise NotImplementedError("has no speed: another distance than all others here")
    import FastGeodis
    import torch

    picture = torch.zeros((1, 1, *problem.picture.shape))
    outside = torch.ones_like(picture)
    outside[(0, 0, *problem.source)] = 0
    run = FastGeodis.generalised_geodesic2d
    return lambda: run(picture, outside, 1e10, 0.0, 2).numpy()[0, 0]


def distance_programs() -> list[Program]:
    """Everyone who makes a distance map."""
    return [
        Program("heatpath, 1 thread", heatpath(1)),
        Program("heatpath, all threads", heatpath(0)),
        Program("heatpath, eikonal", heatpath(1, EIKONAL)),
        Program("scikit-fmm, order 2", scikit_fmm(2)),
        Program("scikit-fmm, order 1", scikit_fmm(1)),
        Program("eikonalfm, factored, order 2", eikonalfm_factored),
        Program("pyekfmm, order 2", pyekfmm),
        Program("ITK FastMarching", itk),
        Program("scikit-image MCP", scikit_image),
        Program("FastGeodis", fastgeodis),
    ]
