"""heatpath side by side with other programs on the same arrays, in one process."""

import argparse
import sys
from pathlib import Path

from many_sources import many_source_programs
from problems import PROBLEMS, QUICK
from programs import Program, distance_programs
from report import machine, markdown, raw, versions
from rounds import Comparison, compare


def main() -> None:
    """Measure what the command line asks for, and tell."""
    arguments = parse()
    facts = machine() | versions()
    names = QUICK if arguments.quick else arguments.cases
    comparisons = {name: measure(name, arguments) for name in names}
    page = markdown(facts, comparisons)
    sys.stdout.write(page)
    if arguments.output:
        arguments.output.write_text(page)
        arguments.output.with_suffix(".json").write_text(raw(facts, comparisons))


def parse() -> argparse.Namespace:
    """Return what the command line asks for."""
    parser = argparse.ArgumentParser(prog="benches/peers/run", description=__doc__)
    cases = parser.add_mutually_exclusive_group()
    cases.add_argument("--cases", nargs="+", choices=PROBLEMS, default=list(PROBLEMS))
    cases.add_argument("--quick", action="store_true", help=f"only {', '.join(QUICK)}")
    parser.add_argument("--rounds", type=positive, default=5, help="for each case, 5 by default")
    parser.add_argument(
        "--budget", type=float, default=600, help="seconds for the rounds of a case, 600 by default"
    )
    parser.add_argument("--output", type=Path, help="page to write; raw numbers beside it, .json")
    return parser.parse_args()


def positive(text: str) -> int:
    """Return a number of rounds."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("must be 1 or more")
    return number


def measure(name: str, arguments: argparse.Namespace) -> Comparison:
    """Compare the programs of one case."""
    say(name)
    return compare(PROBLEMS[name](), programs(name), arguments.rounds, arguments.budget, say)


def programs(case: str) -> list[Program]:
    """Return who takes part in a case."""
    return many_source_programs() if case.startswith("sources") else distance_programs()


def say(line: str) -> None:
    """Tell how far it is, beside the report."""
    sys.stderr.write(f"{line}\n")


if __name__ == "__main__":
    main()
