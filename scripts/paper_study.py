# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Runs the studies of the paper's section 4, for scripts/paper."""
import argparse
import csv
import json
import pathlib
import shutil
import subprocess
import sys
import time

import yaml

import paper_figures
import paper_page

METHODS = {"ours": [], "as_paper": ["--as-paper"]}
STUDIES = ["compare", "monte_carlo", "scaling", "claims", "optimality", "convergence"]
LOGGED_SIZES = ["6", "16", "32", "64"]  # those of Figure 7, with the times of every cycle
MORE_SIZES = ["128", "256", "512", "1000"]
HORIZONS = [5, 6, 8, 10, 15, 20, 30, 40]
SAMPLE_EVERY = 0.5  # of what the figures show of a flight [s]


class Study:
    """Where programs and results are, and how much is asked for."""

    def __init__(self, root, build, quick):
        self.root = root
        self.programs = build / "devel/lib/swarm_planner"
        self.output = build / "paper"
        self.output.mkdir(parents=True, exist_ok=True)
        self.quick = quick

    def run(self, program, *arguments, output=None):
        """Runs one of the package's programs; it shows its own progress on the standard error output."""
        command = [str(self.programs / program), *map(str, arguments)]
        done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}: exit status {done.returncode}")
        if output is not None:
            output.write_text(done.stdout)
        return done.stdout

    def experiment(self, name, *arguments, keep_states=None):
        """Flies `arguments`; results in NAME.json and, where states are wanted, a thinned NAME.csv and times."""
        command = [*arguments, "--json", self.output / f"{name}.json", "--threads", "1"]
        if keep_states is None:
            self.run("swarm_experiment", *command)
            return
        logs = self.output / "logs"
        self.run("swarm_experiment", *command, "--csv", logs)
        if keep_states:
            thin(logs / "states.csv", self.output / f"{name}_states.csv")
            thin(logs / "obstacles.csv", self.output / f"{name}_obstacles.csv")
        shutil.copy(logs / "cycles.csv", self.output / f"{name}_cycles.csv")
        shutil.rmtree(logs)


def thin(source, target):
    """Copies the lines every SAMPLE_EVERY seconds."""
    with source.open() as lines, target.open("w") as kept:
        kept.write(next(lines))
        for line in lines:
            step = float(line.split(",", 2)[1]) / SAMPLE_EVERY
            if abs(step - round(step)) < 1e-6:
                kept.write(line)


def compare(study):
    """Section 4's example: Figures 3 and 4."""
    scenario = study.root / "config/scenarios/paper_six.yaml"
    knows_joint = "compare" in study.run("swarm_experiment", "--help").split("options:")[0]
    command = ["compare"] if knows_joint else ["fly", scenario]
    shutil.copy(scenario, study.output / scenario.name)
    study.experiment("compare_ours", *command, keep_states=True)
    study.experiment("compare_as_paper", "fly", scenario, "--as-paper", keep_states=True)


def monte_carlo(study):
    """Section 4.1: Figures 5 and 6."""
    flights = "10" if study.quick else "100"
    for method, options in METHODS.items():
        study.experiment(f"monte_carlo_{method}", "monte_carlo", "--scenarios", flights, *options)


def scaling(study):
    """Section 4.2: Figure 7 and Table 4."""
    for method, options in METHODS.items():
        study.experiment(f"scaling_{method}", "scaling", "--uavs", *LOGGED_SIZES, *options, keep_states=False)
        more = MORE_SIZES[:1] if study.quick else MORE_SIZES
        study.experiment(f"scaling_more_{method}", "scaling", "--uavs", *more, *options)


def claim_scenarios(scenario):
    """What the paper says in words, as scenarios made from its example."""
    free = dict(scenario, name="without_obstacles", obstacles=[])
    catch_up = dict(scenario, name="catch_up")
    stationary = dict(scenario, name="stationary_target", end={"duration": 120.0})
    stationary["uavs"] = [dict(uav, target={"start": 250.0, "speed": 0.0}) for uav in scenario["uavs"]]
    through = dict(scenario, name="target_through_obstacles")
    # Obstacles beside the references of the example stand right on them here.
    on_reference = [uav["start"] for uav in scenario["uavs"]]
    through["obstacles"] = []
    for obstacle in scenario["obstacles"]:
        y, z = obstacle["center"][1:]
        _, near_y, near_z = min(on_reference, key=lambda p: (p[1] - y) ** 2 + (p[2] - z) ** 2)
        moving = any(obstacle.get("velocity", [0, 0, 0]))
        center = obstacle["center"] if moving else [obstacle["center"][0], near_y + 1.0, near_z]
        through["obstacles"].append(dict(obstacle, center=center))
    return [free, catch_up, stationary, through]


def claims(study):
    """Progress with and without obstacles, a target at rest, targets that pass through obstacles."""
    scenario = yaml.safe_load((study.root / "config/scenarios/paper_six.yaml").read_text())
    files = []
    for made in claim_scenarios(scenario):
        file = study.output / f"{made['name']}.yaml"
        file.write_text(yaml.safe_dump(made, sort_keys=False))
        files.append(file)
    for method, options in METHODS.items():
        study.experiment(f"claims_{method}", "fly", *files, *options, keep_states=True)


def optimality(study):
    """The solutions of at most five SQP iterations against Ipopt's."""
    study.run("optimality_study", study.output / "optimality.json", 60 if study.quick else 500)


def convergence(study):
    """Closed loops without obstacles, perturbed starts, horizons of 5 to 40 stages."""
    parts = []
    for i, horizon in enumerate(HORIZONS):
        print(f"\rhorizon {horizon} ({i + 1} of {len(HORIZONS)}) ", end="", file=sys.stderr, flush=True)
        program = study.root / ".build/test" / f"horizon_study_{horizon}"
        if not program.exists():
            program = study.programs / f"horizon_study_{horizon}"
        parts.append(study.run(program))
    print(file=sys.stderr)
    (study.output / "convergence.json").write_text("[\n" + ",\n".join(parts) + "]\n")


def write_table(path, rows):
    with path.open("w", newline="") as file:
        csv.writer(file).writerows(rows)


def parse(arguments):
    parser = argparse.ArgumentParser(prog="scripts/paper", add_help=False)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", nargs="+", choices=STUDIES, default=STUDIES, metavar="STUDY")
    parser.add_argument("--figures-only", action="store_true")
    parser.add_argument("--update-doc", action="store_true")
    return parser.parse_args(arguments)


def main():
    options = parse(sys.argv[1:])
    study = Study(options.root, options.build, options.quick)
    wanted = [] if options.figures_only else options.only
    begin = time.monotonic()
    try:
        for i, name in enumerate(wanted):
            print(f"[{time.monotonic() - begin:3.0f} s] study {i + 1} of {len(wanted)}: {name}", flush=True)
            globals()[name](study)
        print(f"[{time.monotonic() - begin:3.0f} s] figures and page", flush=True)
        figures = paper_figures.draw_all(study.output)
        tables = paper_page.write(study.output, figures)
    except (OSError, RuntimeError) as error:
        print(f"paper: {error}", file=sys.stderr)
        return 1
    for name, rows in tables.items():
        write_table(study.output / f"{name}.csv", rows)
    if options.update_doc:
        target = options.root / "doc/paper"
        target.mkdir(exist_ok=True)
        for figure in figures:
            shutil.copy(study.output / figure, target / figure)
        shutil.copy(study.output / "paper.md", target / "README.md")
    print(f"[{time.monotonic() - begin:3.0f} s] {study.output / 'paper.md'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
