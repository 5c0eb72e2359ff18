#!/usr/bin/env python3
# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Flies the campaign of scripts/tight_places, which passes its options on, and prints its table."""
import argparse
import dataclasses
import pathlib
import shutil
import statistics
import sys

sys.dont_write_bytecode = True  # nothing is left among the sources
import campaign

MOST_REJECTED = 0.02  # share of the plans of all UAVs and cycles
WORSE_BY = 1.02  # paths and times against a control
SLOWER_BY = 1.2  # median cycle against a control


def total(runs, key):
    return sum(run[key] for run in runs)


def rejected_share(runs):
    return total(runs, "rejected_plans") / max(1, sum(run["uavs"] * run["cycles"] for run in runs))


def worst(runs, key, of=None):
    """The largest value of the runs that have one; None if none has."""
    values = [run[key] if of is None or run[key] is None else run[key][of] for run in runs]
    values = [value for value in values if value is not None]
    return max(values) if values else None


def text(value, form="{:.2f}"):
    return "-" if value is None else form.format(value)


class Demand:
    """Something that is asked of an experiment's runs."""

    def __init__(self, name, measure, most):
        self.name, self.measure, self.most = name, measure, most

    def judge(self, runs):
        """Whether it is met, and what to say."""
        value = self.measure(runs)
        met = value is not None and value <= self.most
        return met, f"{self.name} {text(value, '{:.4g}')} of {self.most:g}{'' if met else ' MISSED'}"


NO_COLLISION = Demand("collisions", lambda runs: total(runs, "collisions"), 0)
ALL_ARRIVE = Demand("not arrived", lambda runs: total(runs, "uavs") - total(runs, "arrived_uavs"), 0)
FEW_REJECTED = Demand("rejected", rejected_share, MOST_REJECTED)
PROGRESS = [
    Demand("stuck", lambda runs: total(runs, "stuck_uavs"), 0),
    Demand("strayed", lambda runs: total(runs, "strayed_uavs"), 0),
    Demand("UAV collisions", lambda runs: total(runs, "uav_collisions"), 0),
    Demand("obstacle collisions per flight", lambda runs: total(runs, "obstacle_collisions") / len(runs), 0.001),
]


def mission_time(most):
    return Demand("mission s", lambda runs: worst(runs, "mission_time_s"), most)


def mission_ratio(most):
    return Demand("time over least", lambda runs: worst(runs, "mission_time_ratio"), most)


def cycle_p99(most):
    return Demand("cycle p99 ms", lambda runs: worst(runs, "cycle_ms", "p99"), most)


@dataclasses.dataclass
class Experiment:
    """Flights that make one row of the table."""

    name: str
    arguments: list
    seeds: int
    demands: list
    first_seed: int = 0
    timed: bool = False  # planning times are asked for
    without: str = ""

    def title(self):
        return self.name + (f" without {self.without}" if self.without else "")

    def file_name(self):
        return self.title().replace(" ", "_") + ".json"

    def command(self, first, last):
        words = [*self.arguments, "--seeds", f"{first}:{last}"]
        return words + (["--without", self.without] if self.without else [])

    def summary(self, runs):
        return f"{self.title()}: {total(runs, 'arrived_uavs')}/{total(runs, 'uavs')} arrived"


def all_experiments(quick):
    """The campaign; numbers of flights are those of the full and of the quick one."""

    def count(full, few):
        return few if quick else full

    experiments = [Experiment("monte_carlo", ["monte_carlo", "--uavs", "6"], count(1000, 20), PROGRESS)]
    for uavs, few in ((10, 5), (20, 3), (40, 1)):
        demands = [ALL_ARRIVE, NO_COLLISION] + ([mission_ratio(1.5)] if uavs == 10 else [])
        arguments = ["circle_swap", "--uavs", str(uavs)]
        experiments.append(Experiment(f"circle_swap {uavs}", arguments, count(100, few), demands, first_seed=1))
    arrive = [ALL_ARRIVE, NO_COLLISION]
    experiments.append(Experiment("forest", ["forest"], count(100, 5), arrive))
    experiments.append(Experiment("forest any gap", ["forest", "--gap", "0"], count(100, 2), arrive))
    experiments.append(Experiment("small_forest", ["small_forest"], count(30, 3), arrive))
    for name, few in (("gap", 2), ("u_trap", 1), ("box_head_on", 2), ("same_goal", 2)):
        experiments.append(Experiment(name, [name, "--shortest-paths"], count(20, few), arrive))
    swap_times = {6: 4.0, 16: 8.0, 64: 15.0}  # [s]
    for family in ("dens", "swapj"):
        for uavs, full, few in ((6, 100, 5), (12, 100, 3), (16, 100, 3), (32, 50, 1), (64, 20, 1)):
            demands = [*arrive, FEW_REJECTED]
            if family == "swapj" and uavs in swap_times:
                demands.append(mission_time(swap_times[uavs]))
            if uavs == 64:
                demands.append(cycle_p99(30.0))
            arguments = [family, "--uavs", str(uavs), "--threads", "1"]
            experiments.append(
                Experiment(f"{family} {uavs}", arguments, count(full, few), demands, timed=uavs == 64)
            )
    return experiments


HEADER = [
    "experiment",
    "flights",
    "arrived",
    "stuck",
    "coll.",
    "rejected",
    "mission s",
    "most",
    "time x",
    "path x",
    "most",
    "cycle ms",
    "p99",
    "asked for",
]


def row(experiment, runs):
    paths = [run["path_ratio"]["mean"] for run in runs if run["path_ratio"]]
    verdicts = [demand.judge(runs)[1] for demand in experiment.demands]
    return [
        experiment.title(),
        str(len(runs)),
        f"{total(runs, 'arrived_uavs')}/{total(runs, 'uavs')}",
        str(total(runs, "stuck_uavs")),
        str(total(runs, "collisions")),
        f"{100.0 * rejected_share(runs):.2f} %",
        text(statistics.median(run["mission_time_s"] for run in runs)),
        text(worst(runs, "mission_time_s")),
        text(worst(runs, "time_ratio", "max")),
        text(statistics.mean(paths) if paths else None, "{:.3f}"),
        text(worst(runs, "path_ratio", "max"), "{:.3f}"),
        text(statistics.median(run["cycle_ms"]["median"] for run in runs)),
        text(worst(runs, "cycle_ms", "p99"), "{:.1f}"),
        ", ".join(verdicts) or "-",
    ]


def comparison(experiment, runs, control_runs):
    """Demands on the runs whose control arrived: paths and mission times in all, and the median cycle."""
    pairs = [(run, other) for run, other in zip(runs, control_runs) if other["arrived_uavs"] == other["uavs"]]

    def ratio(key):
        return sum(run[key] for run, _ in pairs) / sum(other[key] for _, other in pairs) if pairs else None

    def median(several):
        return statistics.median(run["cycle_ms"]["median"] for run in several)

    demands = [Demand("cycle", lambda _: median(runs) / median(control_runs), SLOWER_BY)]
    if pairs:
        demands.append(Demand("path", lambda _: ratio("path_length_m"), WORSE_BY))
        demands.append(Demand("time", lambda _: ratio("mission_time_s"), WORSE_BY))
    judged = [demand.judge(runs) for demand in demands]
    what = f"{experiment.name}, in {len(pairs)} of {len(runs)} flights all arrive in the control: "
    return all(met for met, _ in judged), what + ", ".join(words for _, words in judged)


def selected(options, parser):
    experiments = all_experiments(options.quick)
    for experiment in experiments:
        wanted = options.scenarios if experiment.name == "monte_carlo" else options.seeds
        experiment.seeds = wanted or experiment.seeds
    if not options.only:
        return experiments
    chosen = [one for one in experiments if one.name in options.only or one.arguments[0] in options.only]
    known = {one.name for one in experiments} | {one.arguments[0] for one in experiments}
    unknown = [name for name in options.only if name not in known]
    if unknown:
        parser.error(f"--only: no experiment is called {', '.join(unknown)}")
    return chosen


def fly(options, experiments):
    """Those whose planning times matter fly alone."""
    flown = campaign.fly_all(options.program, [one for one in experiments if not one.timed], options.output_dir)
    flown += campaign.fly_all(options.program, [one for one in experiments if one.timed], options.output_dir, 1)
    order = [one.title() for one in experiments]
    return sorted(flown, key=lambda pair: order.index(pair[0].title()))


def main():
    usage = "scripts/tight_places [--quick] [--seeds N] [--scenarios N] [--only NAME ...] [--compare CONTROL]"
    parser = argparse.ArgumentParser(prog="scripts/tight_places", usage=usage, add_help=False)
    parser.add_argument("program")
    parser.add_argument("output_dir")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--seeds", type=campaign.flight_count)
    parser.add_argument("--scenarios", type=campaign.flight_count)
    parser.add_argument("--only", nargs="+", default=[])
    parser.add_argument("--compare")
    options = parser.parse_args()

    experiments = selected(options, parser)
    options.output_dir = pathlib.Path(options.output_dir)
    shutil.rmtree(options.output_dir, ignore_errors=True)  # results of another campaign
    options.output_dir.mkdir(parents=True)
    try:
        flown = fly(options, experiments)
        controls = []
        if options.compare:
            again = [dataclasses.replace(one, without=options.compare, demands=[]) for one in experiments]
            controls = fly(options, again)
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return 1
    table = campaign.aligned([HEADER, *(row(*pair) for pair in flown + controls)]) + "\n"
    judged = [demand.judge(runs)[0] for experiment, runs in flown for demand in experiment.demands]
    for (experiment, runs), (_, control_runs) in zip(flown, controls):
        met, line = comparison(experiment, runs, control_runs)
        judged.append(met)
        table += f"\n{line}"
    print(f"\n{table}\n")
    (options.output_dir / "table.txt").write_text(table + "\n")
    print(f"{sum(judged)} of {len(judged)} demands are met.")
    return 0 if all(judged) else 1


if __name__ == "__main__":
    sys.exit(main())
