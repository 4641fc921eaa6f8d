"""Many sources in one medium: fast marching again and again, or a factor made once."""

from collections.abc import Callable

import numpy as np
from scipy import sparse

from problems import Problem
from programs import Program, Timed, library

SOURCES = 100
# Of the implicit step, in cells squared. The pattern, and so the time, does not depend on it.
TIME = 16.0


def sources_of(problem: Problem) -> np.ndarray:
    """Return points at random, always the same."""
    return np.random.default_rng(1).integers(problem.picture.shape, size=(SOURCES, 2))


def heatpath(threads: int) -> Callable[[Problem], Timed]:
    """From the picture: medium, factor and all sources."""
    loaded = library()

    def prepare(problem: Problem) -> Timed:
        sources = sources_of(problem)
        maps = np.empty((SOURCES, *problem.picture.shape))

        def run() -> None:
            with loaded.prepared(problem.picture, reference(problem), threads) as solver:
                loaded.distances(solver, sources, maps, threads)

        return run

    return prepare


def heatpath_prepare(problem: Problem) -> Timed:
    """From the picture: medium and factor."""
    loaded = library()

    def run() -> None:
        with loaded.prepared(problem.picture, reference(problem), 1):
            pass

    return run


def reference(problem: Problem) -> float:
    """Return the grey value that the conductivity compares with."""
    return float(problem.picture[problem.source])


def scikit_fmm(problem: Problem) -> Timed:
    """All sources, one after the other."""
    import skfmm

    sources = sources_of(problem)

    def run() -> None:
        for source in map(tuple, sources):
            outside = np.ones_like(problem.speed)
            outside[source] = 0
            skfmm.travel_time(outside, problem.speed, order=2)

    return run


def cholmod_factor(ordering: str) -> Callable[[Problem], Timed]:
    """Analyse and factor, from the assembled matrix."""

    def prepare(problem: Problem) -> Timed:
        from sksparse.cholmod import cholesky

        matrix = implicit_step(problem.conductivity)

        def run() -> None:
            cholesky(matrix, ordering_method=ordering)

        return run

    return prepare


def cholmod_solve(problem: Problem) -> Timed:
    """One source with the factor that is there."""
    from sksparse.cholmod import cholesky

    factor = cholesky(implicit_step(problem.conductivity), ordering_method="amd")
    heat = np.zeros(problem.picture.size)
    heat[np.ravel_multi_index(problem.source, problem.picture.shape)] = 1

    def run() -> None:
        factor(heat)

    return run


def implicit_step(conductivity: np.ndarray) -> sparse.csc_matrix:
    """Return I + t L, where L has the mean conductivity of two cells between them."""
    cell = np.arange(conductivity.size).reshape(conductivity.shape)
    before = np.concatenate([cell[:-1].ravel(), cell[:, :-1].ravel()])
    after = np.concatenate([cell[1:].ravel(), cell[:, 1:].ravel()])
    face = TIME * (conductivity.ravel()[before] + conductivity.ravel()[after]) / 2
    links = sparse.coo_matrix((face, (before, after)), (cell.size, cell.size))
    links = links + links.T
    diagonal = 1 + np.asarray(links.sum(axis=0)).ravel()
    return sparse.csc_matrix(sparse.diags(diagonal) - links)


def many_source_programs() -> list[Program]:
    """Everyone who is faster the second time, and who is not."""
    return [
        Program("heatpath, 1 thread", heatpath(1)),
        Program("heatpath, all threads", heatpath(0)),
        Program("heatpath, prepare only", heatpath_prepare),
        Program(f"scikit-fmm, order 2, {SOURCES} sources", scikit_fmm),
        Program("CHOLMOD, analyse and factor, AMD", cholmod_factor("amd")),
        Program("CHOLMOD, analyse and factor, default ordering", cholmod_factor("default")),
        Program("CHOLMOD, one solve", cholmod_solve),
    ]
