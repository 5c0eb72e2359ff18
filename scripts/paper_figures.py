# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""Figures laid out as the paper's, from the results of scripts/paper."""
import collections
import csv
import json

import matplotlib
import yaml

matplotlib.use("Agg")
from matplotlib import patches, pyplot  # noqa: E402  (after the choice of the back end)

NAMES = {"ours": "ours", "as_paper": "the paper's method"}
COLOURS = {"ours": "black", "as_paper": "tab:blue"}
JOINT_COLOUR = "tab:red"
PAPER_COLOUR = "tab:orange"


def load(output, name):
    """The JSON of a study, or None if it has not run."""
    path = output / f"{name}.json"
    return json.loads(path.read_text()) if path.exists() else None


def read(output, name):
    path = output / f"{name}.csv"
    if not path.exists():
        return []
    with path.open() as file:
        return list(csv.DictReader(file))


def tracks(output, name, run):
    """Of one run: UAV -> lists of t, x, y, z."""
    paths = collections.defaultdict(lambda: ([], [], [], []))
    for line in read(output, f"{name}_states"):
        if int(line["run"]) != run:
            continue
        for values, key in zip(paths[line["uav"]], ("time_s", "x", "y", "z")):
            values.append(float(line[key]))
    return paths


def joint_run(runs):
    """Index of the run of Problem 1, or None."""
    return next((i for i, run in enumerate(runs) if run.get("problem") == 1), None)


def iterative_run(runs):
    return next(i for i, run in enumerate(runs) if run.get("problem", 2) == 2)


def save(figure, output, name):
    figure.tight_layout()
    figure.savefig(output / name, dpi=75)
    pyplot.close(figure)
    return name


def draw_obstacles(output, axis, z):
    """Obstacles that reach to within a few metres of the height `z`, where they start, with their way in 10 s."""
    for obstacle in yaml.safe_load((output / "paper_six.yaml").read_text())["obstacles"]:
        x, y, height = obstacle["center"]
        if abs(height - z) > obstacle["radii"][2] + 2:
            continue
        width, depth = 2 * obstacle["radii"][0], 2 * obstacle["radii"][1]
        vx, vy, _ = obstacle.get("velocity", [0, 0, 0])
        axis.add_patch(patches.Ellipse((x, y), width, depth, color="tab:orange" if vx or vy else "0.8"))
        if vx or vy:
            axis.annotate(f"{abs(vx) + abs(vy):g} m/s", (x + 10 * vx, y + 10 * vy), (x, y), fontsize=8,
                          arrowprops={"arrowstyle": "->"})


def figure_3(output):
    """Trajectories from above, even UAVs on top, odd ones below."""
    runs = load(output, "compare_ours")
    figure, axes = pyplot.subplots(2, 1, figsize=(9, 8), sharex=True)
    sources = [("compare_as_paper", 0, COLOURS["as_paper"], "the paper's method, Problem 2")]
    sources.append(("compare_ours", iterative_run(runs), COLOURS["ours"], "ours, Problem 2"))
    if joint_run(runs) is not None:
        sources.insert(1, ("compare_ours", joint_run(runs), JOINT_COLOUR, "ours, Problem 1"))
    for name, run, colour, label in sources:
        for i, (_, (_, x, y, _)) in enumerate(sorted(tracks(output, name, run).items())):
            axes[1 - i % 2].plot(x, y, color=colour, linewidth=1.2, label=label if i < 2 else None)
    for axis, title in zip(axes, ("UAVs 2, 4, 6 (z = 40 m)", "UAVs 1, 3, 5 (z = 20 m)")):
        for y in (100, 150, 200):
            axis.axhline(y, color="tab:green", linestyle="--", linewidth=0.8)
        draw_obstacles(output, axis, 40 if axis is axes[0] else 20)
        axis.set(ylabel="y [m]", title=title, ylim=(-10, 310))
        axis.legend(fontsize=8, loc="lower right")
    axes[1].set_xlabel("x [m]")
    return save(figure, output, "figure_3.png")


def cycle_times(output, name, run):
    return [float(line["cycle_ms"]) for line in read(output, f"{name}_cycles") if int(line["run"]) == run]


def figure_4(output):
    """Solution time at each MPC instant."""
    runs = load(output, "compare_ours")
    figure, axis = pyplot.subplots(figsize=(8, 4))
    axis.axhspan(104.7, 176.5, color=PAPER_COLOUR, alpha=0.3, label="paper, Problem 1")
    axis.axhspan(17.8, 24.4, color=PAPER_COLOUR, alpha=0.6, label="paper, Problem 2")
    if joint_run(runs) is not None:
        axis.plot(cycle_times(output, "compare_ours", joint_run(runs)), color=JOINT_COLOUR, label="ours, Problem 1")
    axis.plot(cycle_times(output, "compare_as_paper", 0), color=COLOURS["as_paper"], label="the paper's method here")
    axis.plot(cycle_times(output, "compare_ours", iterative_run(runs)), color=COLOURS["ours"], label="ours, Problem 2")
    axis.set(yscale="log", xlabel="MPC instant", ylabel="solution time of the swarm [ms]")
    axis.legend(fontsize=8)
    return save(figure, output, "figure_4.png")


def summed_histogram(runs, key):
    """Lower bin edges [ms] and the share of instances in each bin [%]."""
    first = runs[0][key]
    counts = [sum(column) for column in zip(*(run[key]["counts"] for run in runs))]
    total = sum(counts)
    edges = [first["least"] * 10 ** (i / first["bins_per_decade"]) for i in range(len(counts) + 1)]
    return edges, [100.0 * count / total for count in counts]


def histogram_figure(output, key, name, label, paper, limit=None):
    figure, axis = pyplot.subplots(figsize=(8, 4))
    for i, (low, high, share) in enumerate(paper):
        axis.bar(low, share, high - low, align="edge", color=PAPER_COLOUR, alpha=0.5, label=None if i else "paper")
    if limit is not None:
        axis.axvline(limit, color=PAPER_COLOUR, label=f"paper: all below {limit} ms")
    for method in NAMES:
        runs = load(output, f"monte_carlo_{method}")
        edges, shares = summed_histogram(runs, key)
        axis.stairs(shares, edges, color=COLOURS[method], label=f"{NAMES[method]} here", linewidth=1.5)
    axis.set(xscale="log", xlabel=label, ylabel="share of the instances [%]", xlim=(0.003, 100))
    axis.legend(fontsize=8)
    return save(figure, output, name)


def figure_5(output):
    # "a little over 20 %" and "approximately 76 %".
    return histogram_figure(output, "uav_ms_histogram", "figure_5.png", "time for a UAV [ms]", [(2, 4, 20), (4, 6, 76)])


def figure_6(output):
    # The text gives no more than "within 30 milliseconds".
    return histogram_figure(output, "cycle_ms_histogram", "figure_6.png", "time for the swarm of six [ms]", [], limit=30)


def figure_7(output):
    """Times of every instant for 6 to 64 UAVs, and of a UAV in swarms of any size."""
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10, 4))
    for run, uavs in enumerate((6, 16, 32, 64)):
        for method, style in (("ours", "-"), ("as_paper", ":")):
            left.plot(cycle_times(output, f"scaling_{method}", run), style, color=f"C{run}", linewidth=0.9,
                      label=f"{uavs} UAVs" if method == "ours" else None)
    left.set(yscale="log", xlabel="MPC instant", ylabel="solution time of the swarm [ms]")
    left.legend(fontsize=8, title="ours; dotted: the paper's method")
    right.plot((6, 16, 32, 64), (3.49, 3.94, 5.17, 7.65), "o-", color=PAPER_COLOUR, label="paper")
    for method in NAMES:
        runs = load(output, f"scaling_{method}") + load(output, f"scaling_more_{method}")
        right.plot([run["uavs"] for run in runs], [run["cycle_cpu_ms"]["mean"] / run["uavs"] for run in runs], "o-",
                   color=COLOURS[method], label=f"{NAMES[method]} here, processor time")
    right.set(xscale="log", yscale="log", xlabel="UAVs", ylabel="mean time of the swarm over UAVs [ms]", ylim=(0.005, 20))
    right.legend(fontsize=8)
    return save(figure, output, "figure_7.png")


def progress_spread(output, method, run):
    """Times and the difference between the first and the last UAV's x."""
    paths = list(tracks(output, f"claims_{method}", run).values())
    spread = [max(xs) - min(xs) for xs in zip(*(x for _, x, _, _ in paths))]
    return paths[0][0], spread


def figure_progress(output):
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 3.5))
    for axis, run, title in zip(axes, (0, 1), ("without obstacles", "paper_six")):
        for method in NAMES:
            axis.plot(*progress_spread(output, method, run), color=COLOURS[method], label=NAMES[method])
        axis.set(xlabel="t [s]", ylabel="first UAV ahead of the last [m]", title=title)
        axis.legend(fontsize=8)
    return save(figure, output, "figure_progress.png")


def figure_convergence(output):
    figure, axes = pyplot.subplots(1, 2, figsize=(10, 3.5), sharey=True)
    for axis, method in zip(axes, NAMES):
        for study in load(output, "convergence"):
            if study["method"] == method:
                distance = study["worst_distance_m"]
                axis.plot([0.3 * i for i in range(len(distance))], distance, label=f"N = {study['horizon']}")
        axis.set(yscale="log", xlabel="t [s]", ylabel="worst distance to the target [m]", title=NAMES[method])
        axis.legend(fontsize=7, ncol=2)
    return save(figure, output, "figure_convergence.png")


def figure_optimality(output):
    figure, axis = pyplot.subplots(figsize=(8, 4))
    for study in load(output, "optimality"):
        gaps = sorted(max(100 * program["gap"], 1e-6) for program in study["programs"])
        shares = [100.0 * (i + 1) / len(gaps) for i in range(len(gaps))]
        axis.plot(gaps, shares, color=COLOURS[study["method"]], label=NAMES[study["method"]])
    axis.axvline(1.0, color="0.5", linestyle="--")
    axis.set(xscale="log", xlabel="cost above Ipopt's local optimum [%]", ylabel="programs within that [%]")
    axis.legend(fontsize=8)
    return save(figure, output, "figure_optimality.png")


def draw_all(output):
    """The names of the figures whose studies have run."""
    needs = {
        figure_3: "compare_as_paper", figure_4: "compare_as_paper", figure_5: "monte_carlo_as_paper",
        figure_6: "monte_carlo_as_paper", figure_7: "scaling_more_as_paper", figure_progress: "claims_as_paper",
        figure_convergence: "convergence", figure_optimality: "optimality",
    }
    return [draw(output) for draw, study in needs.items() if (output / f"{study}.json").exists()]
