"""How it is timed: every program once a round, in rotating order."""

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from problems import Problem
from programs import Program, Timed


@dataclass
class Result:
    """The seconds of one program, one a round, and how exact it was, if that is a question."""

    deviation: float | None
    not_reached: float | None
    seconds: list[float] = field(default_factory=list)

    def quartiles(self) -> tuple[float, float, float]:
        """Return the first quartile, the median and the third quartile of the seconds."""
        low, median, high = np.percentile(self.seconds, [25, 50, 75])
        return float(low), float(median), float(high)

    def ratio(self, other: "Result") -> float:
        """Return the median over the rounds of the time in units of the other's time."""
        return float(np.median(np.divide(self.seconds, other.seconds)))


@dataclass
class Comparison:
    """All programs on one problem, and the reasons of those that did not run."""

    results: dict[str, Result]
    not_run: dict[str, str]


def compare(
    problem: Problem,
    programs: list[Program],
    rounds: int,
    budget: float,
    say: Callable[[str], None],
) -> Comparison:
    """Run every program `rounds` times, or fewer once `budget` seconds are over."""
    timed, results, not_run = warm_up(problem, programs, say)
    begin = perf_counter()
    for count in range(rounds):
        if count > 0 and perf_counter() - begin > budget:
            break
        say(f"  round {count + 1}")
        for name in rotated(list(timed), count):
            results[name].seconds.append(seconds(timed[name]))
    return Comparison(results, not_run)


def warm_up(
    problem: Problem, programs: list[Program], say: Callable[[str], None]
) -> tuple[dict[str, Timed], dict[str, Result], dict[str, str]]:
    """Run every program once before the clock, and see how exact it is."""
    timed, results, not_run = {}, {}, {}
    for program in programs:
        say(f"  {program.name}")
        try:
            run = program.prepare(problem)
            distance = run()
        except (ImportError, NotImplementedError, RuntimeError) as error:
            not_run[program.name] = str(error)
            continue
        deviation = (None, None) if distance is None else problem.deviation(distance)
        timed[program.name], results[program.name] = run, Result(*deviation)
    return timed, results, not_run


def rotated(names: list[str], by: int) -> list[str]:
    """Return the names, another one first in every round."""
    first = by % max(1, len(names))
    return names[first:] + names[:first]


def seconds(run: Timed) -> float:
    """Return the time on the wall."""
    begin = perf_counter()
    run()
    return perf_counter() - begin
