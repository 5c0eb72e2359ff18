#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Flies the safety campaign of scripts/safety, which passes its options on, and prints its table."""
import argparse
import collections
import dataclasses
import pathlib
import shutil
import sys

sys.dont_write_bytecode = True  # nothing is left among the sources
import campaign

LATENCIES = (0.0, 0.1, 0.3)  # [s]
SCENARIO_LATENCIES = (0.0, 0.1)  # [s] of files given by the user
DISTURBANCES = ("--drop", "0.2", "--noise", "0.05")  # noise in m and m/s
CONTROLS = (("check", 0.1), ("check,segments", 0.1), ("latency", 0.3))  # what is left out, latency [s]
CONTROL_SHARE = 5  # a control gets the seeds of an experiment divided by this


@dataclasses.dataclass
class Experiment:
    """Flights that make one row of the table."""

    name: str
    arguments: list
    seeds: int
    latency: float = 0.0
    disturbed: bool = True
    without: str = ""
    ends_at_goals: bool = True
    first_seed: int = 0

    def title(self):
        return self.name + (f" without {self.without}" if self.without else "")

    def file_name(self):
        title = self.title().replace("/", "_").replace(",", "+")
        return f"{title} latency {self.latency:g}.json".replace(" ", "_")

    def command(self, first, last):
        words = [*self.arguments, "--seeds", f"{first}:{last}"]
        if self.disturbed:
            words += ["--latency", str(self.latency), *DISTURBANCES]
        if self.without:
            words += ["--without", self.without]
        return words

    def summary(self, runs):
        collisions = sum(run["collisions"] for run in runs)
        return f"{self.title()}, latency {self.latency:g} s: {collisions} collisions"


def experiments_of(options):
    studies = [
        ("circle_swap", ["circle_swap", "--uavs", "10", "--radius", "10"]),
        ("crossing", ["fly", options.crossing]),
        ("moving_obstacles", ["moving_obstacles"]),
    ]
    monte_carlo = ["monte_carlo", "--uavs", "6"]
    # Files first: a fault in one ends the campaign at once.
    experiments = [
        Experiment(path, ["fly", path], options.seeds, latency)
        for path in options.scenario_files
        for latency in SCENARIO_LATENCIES
    ]
    experiments.append(Experiment("monte_carlo", monte_carlo, options.scenarios, disturbed=False, ends_at_goals=False))
    experiments += [Experiment(*study, options.seeds, latency) for study in studies for latency in LATENCIES]
    control_seeds = max(1, options.seeds // CONTROL_SHARE)
    experiments += [
        Experiment(*study, control_seeds, latency, without=without)
        for without, latency in CONTROLS
        for study in studies
    ]
    return experiments


def least(runs, key):
    values = [run[key] for run in runs if run[key] is not None]
    return f"{min(values):.3f}" if values else "-"


class Legend:
    """Short marks for reasons in words, in the order in which they come up."""

    def __init__(self):
        self.marks = {}

    def mark(self, reason):
        return self.marks.setdefault(reason, f"[{len(self.marks) + 1}]")


HEADER = [
    "experiment",
    "latency s",
    "runs",
    "UAV-UAV coll.",
    "obstacle coll.",
    "flights with coll.",
    "stuck",
    "arrived",
    "rejected plans",
    "least pair m",
    "least clear. m",
    "fallbacks",
]


def row(experiment, runs, legend):
    def total(key):
        return sum(run[key] for run in runs)

    fallbacks = collections.Counter()
    for run in runs:
        fallbacks.update(run["fallbacks"])
    uav_cycles = sum(run["uavs"] * run["cycles"] for run in runs)
    rejected = total("rejected_plans")
    return [
        experiment.title(),
        f"{experiment.latency:g}",
        str(len(runs)),
        str(total("uav_collisions")),
        str(total("obstacle_collisions")),
        str(sum(run["collisions"] > 0 for run in runs)),
        str(total("stuck_uavs")),
        f"{total('arrived_uavs')}/{total('uavs')}" if experiment.ends_at_goals else "-",
        f"{rejected} ({100.0 * rejected / uav_cycles:.2f} %)",
        least(runs, "min_uav_distance_m"),
        least(runs, "min_obstacle_clearance_m"),
        "  ".join(f"{legend.mark(reason)} {count}" for reason, count in sorted(fallbacks.items())) or "0",
    ]


def main():
    usage = "scripts/safety [--scenarios N] [--seeds N] [SCENARIO.yaml ...]"
    parser = argparse.ArgumentParser(prog="scripts/safety", usage=usage, add_help=False)
    parser.add_argument("program")
    parser.add_argument("crossing")
    parser.add_argument("output_dir")
    parser.add_argument("--scenarios", type=campaign.flight_count, default=1000)
    parser.add_argument("--seeds", type=campaign.flight_count, default=100)
    parser.add_argument("scenario_files", nargs="*")
    options = parser.parse_intermixed_args()

    options.output_dir = pathlib.Path(options.output_dir)
    shutil.rmtree(options.output_dir, ignore_errors=True)  # results of another campaign
    options.output_dir.mkdir(parents=True)
    try:
        flown = campaign.fly_all(options.program, experiments_of(options), options.output_dir)
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return 1
    legend = Legend()
    rows = [row(experiment, runs, legend) for experiment, runs in flown]
    table = campaign.aligned([HEADER, *rows]) + "\n"
    table += "".join(f"\n{mark} {reason}" for reason, mark in legend.marks.items())
    print(f"\n{table}\n")
    (options.output_dir / "table.txt").write_text(table + "\n")

    protected = [run for experiment, runs in flown if not experiment.without for run in runs]
    collided = sum(run["collisions"] > 0 for run in protected)
    print(f"{collided} of {len(protected)} flights with all protections had a collision.")
    return 1 if collided else 0


if __name__ == "__main__":
    sys.exit(main())
