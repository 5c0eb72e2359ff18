# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""The page of scripts/paper: tables of what the paper gives and what was measured."""
import platform

import paper_figures
from paper_figures import NAMES, iterative_run, joint_run, load, progress_spread

METHODS = list(NAMES)


def table(rows):
    """Markdown; the first row is the head."""
    lines = ["| " + " | ".join(map(str, row)) + " |" for row in rows]
    return "\n".join([lines[0], "|" + " --- |" * len(rows[0]), *lines[1:]]) + "\n"


def processor():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            return next(line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


def compare_table(output):
    runs = load(output, "compare_ours")
    flown = {
        "the paper's method, Problem 2": load(output, "compare_as_paper")[0],
        "ours, Problem 2": runs[iterative_run(runs)],
    }
    if joint_run(runs) is not None:
        flown["ours, Problem 1"] = runs[joint_run(runs)]
    rows = [["", "swarm, mean [ms]", "median [ms]", "max [ms]", "UAV, mean [ms]", "nonzeros", "collisions", "least clearance [m]",
             "least pair distance [m]", "cost (15)"]]
    rows.append(["paper, Problem 1", "-", "-", "104.7 to 176.5", "-", 35994, "-", "-", "-", "-"])
    rows.append(["paper, Problem 2", 20.94, "-", "17.8 to 24.4", 3.49, 6189, "-", "-", "-", "-"])
    for name, run in flown.items():
        cycle = run["cycle_ms"]
        rows.append([name, f"{cycle['mean']:.3f}", f"{cycle['median']:.3f}", f"{cycle['max']:.3f}", f"{run['uav_ms']['mean']:.4f}",
                     run["kkt_nonzeros"], run["collisions"], f"{run['min_obstacle_clearance_m']:.3f}",
                     f"{run['min_uav_distance_m']:.2f}", f"{run['cost']:.0f}"])
    return rows


def compare_text(output):
    runs = load(output, "compare_ours")
    if joint_run(runs) is None:
        return "Problem 1 was not flown: this build's `swarm_experiment` has no `compare`.\n"
    joint, iterative = runs[joint_run(runs)], runs[iterative_run(runs)]
    ratio = joint["cycle_ms"]["median"] / iterative["cycle_ms"]["median"]
    cost = 100.0 * (iterative["cost"] / joint["cost"] - 1.0)
    return (f"Problem 1 takes {ratio:.1f} times as long as Problem 2 at the median (the paper: four to seven times); "
            f"Problem 2's flight costs {cost:+.2f} % against Problem 1's.\n")


def share_between(runs, key, low, high):
    """Percent of the instances in [low, high) ms."""
    edges, shares = paper_figures.summed_histogram(runs, key)
    return sum(share for edge, share in zip(edges, shares) if low <= edge * 1.0001 < high)


def monte_carlo_table(output):
    rows = [["", "paper", *(f"{NAMES[method]} here" for method in METHODS)]]
    results = [load(output, f"monte_carlo_{method}") for method in METHODS]

    def add(name, paper, value):
        rows.append([name, paper, *(value(runs) for runs in results)])

    add("flights", 100, len)
    add("cycles", "-", lambda runs: sum(run["cycles"] for run in runs))
    add("UAV, mean of the flights' means [ms]", "4 to 6 in 76 %, 2 to 4 in 20 %",
        lambda runs: f"{sum(run['uav_ms']['mean'] for run in runs) / len(runs):.4f}")
    add("UAV, longest [ms]", "-", lambda runs: f"{max(run['uav_ms']['max'] for run in runs):.2f}")
    add("swarm, median of the flights' medians [ms]", "-",
        lambda runs: f"{sorted(run['cycle_ms']['median'] for run in runs)[len(runs) // 2]:.3f}")
    add("swarm, longest [ms]", "below 30", lambda runs: f"{max(run['cycle_ms']['max'] for run in runs):.2f}")
    add("swarm, longest processor time [ms]", "-", lambda runs: f"{max(run['cycle_cpu_ms']['max'] for run in runs):.2f}")
    add("swarm, cycles below about 3 ms [%]", "-",
        lambda runs: f"{share_between(runs, 'cycle_ms_histogram', 0.0, 3.0):.3f}")
    add("nonzeros", 8279, lambda runs: f"{min(r['kkt_nonzeros'] for r in runs)} to {max(r['kkt_nonzeros'] for r in runs)}")
    add("collisions with obstacles", "-", lambda runs: sum(run["obstacle_collisions"] for run in runs))
    add("collisions of UAVs", "-", lambda runs: sum(run["uav_collisions"] for run in runs))
    add("least clearance [m]", "-", lambda runs: f"{min(run['min_obstacle_clearance_m'] for run in runs):.3f}")
    add("least pair distance [m]", "-", lambda runs: f"{min(run['min_uav_distance_m'] for run in runs):.2f}")
    add("UAVs stuck at the end", "-", lambda runs: sum(run["stuck_uavs"] for run in runs))
    add("UAVs more than 20 m behind their target's plane at the end", "-",
        lambda runs: sum(run["strayed_uavs"] + run["strayed_uavs_with_reason"] for run in runs))
    add("mean lag at the end [m]", "-", lambda runs: f"{sum(run['final_lag_m']['mean'] for run in runs) / len(runs):.2f}")
    return rows


def scaling_table(output):
    """Table 4, with its columns for the paper, its method here, and ours."""
    paper = {6: (3.49, 20.94, 6189), 16: (3.94, 63.01, 7937), 32: (5.17, 165.48, 10977), 64: (7.65, 489.75, 17057)}
    rows = [["UAVs", "paper Avg_tq [ms]", "Avg_tsw [ms]", "Nnz"]]
    for method in METHODS:
        rows[0] += [f"{NAMES[method]}: Avg_tq [ms]", "Avg_tsw [ms]", "of a UAV, processor time [ms]", "Nnz"]
    runs = {m: load(output, f"scaling_{m}") + load(output, f"scaling_more_{m}") for m in METHODS}
    for i, first in enumerate(runs[METHODS[0]]):
        row = [first["uavs"], *paper.get(first["uavs"], ("-", "-", "-"))]
        for method in METHODS:
            run = runs[method][i]
            row += [f"{run['uav_ms']['mean']:.4f}", f"{run['cycle_ms']['mean']:.3f}", f"{run['cycle_cpu_ms']['mean'] / run['uavs']:.4f}", run["kkt_nonzeros"]]
        rows.append(row)
    return rows


def claims_table(output):
    rows = [["scenario", "method", "greatest spread of progress [m]", "at the end [m]", "mean lag at the end [m]", "collisions",
             "least clearance [m]", "stuck"]]
    for method in METHODS:
        for i, run in enumerate(load(output, f"claims_{method}")):
            _, spreads = progress_spread(output, method, i)
            clearance = run["min_obstacle_clearance_m"]
            rows.append([run["scenario"], NAMES[method], f"{max(spreads):.2f}", f"{spreads[-1]:.2f}",
                         f"{run['final_lag_m']['mean']:.2f}", run["collisions"], "-" if clearance is None else f"{clearance:.3f}",
                         run["stuck_uavs"]])
    return rows


def convergence_table(output):
    rows = [["N"]]
    for method in METHODS:
        rows[0] += [f"{NAMES[method]}: settled", "after [s]", "distance at the end [m]"]
    studies = load(output, "convergence")
    for horizon in sorted({study["horizon"] for study in studies}):
        row = [horizon]
        for method in METHODS:
            study = next(s for s in studies if s["horizon"] == horizon and s["method"] == method)
            row += [f"{study['settled']} of {study['starts']}", study["settling_time_s"], f"{study['final_distance_m']:.3f}"]
        rows.append(row)
    return rows


def optimality_table(output):
    rows = [["method", "programs", "within 1 % of Ipopt [%]", "median gap [%]", "largest gap [%]", "better by 1 %",
             "beyond: more iterations", "beyond: other minimum", "beyond: stuck", "Ipopt failed"]]
    for study in load(output, "optimality"):
        for part, name in (("all", ""), ("constrained", ", something near")):
            s = study[part]
            rows.append([NAMES[study["method"]] + name, s["programs"], f"{100 * s['within_1_percent']:.1f}",
                         f"{100 * s['median_gap']:.2g}", f"{100 * s['max_gap']:.1f}", s["better_by_1_percent"],
                         s["beyond_more_iterations"], s["beyond_other_minimum"], s["beyond_no_step"],
                         study["ipopt_failed"]])
    return rows


SECTIONS = [
    ("compare", "compare_as_paper", "The example of section 4 (Figures 3 and 4)", compare_table, ["figure_3.png", "figure_4.png"]),
    ("monte_carlo", "monte_carlo_as_paper", "Monte Carlo test (section 4.1, Figures 5 and 6)", monte_carlo_table,
     ["figure_5.png", "figure_6.png"]),
    ("scaling", "scaling_more_as_paper", "Scalability (section 4.2, Figure 7 and Table 4)", scaling_table, ["figure_7.png"]),
    ("claims", "claims_as_paper", "What the paper says in words", claims_table, ["figure_progress.png"]),
    ("convergence", "convergence", "Convergence of the closed loop without obstacles", convergence_table,
     ["figure_convergence.png"]),
    ("optimality", "optimality", "Solutions against Ipopt's", optimality_table, ["figure_optimality.png"]),
]

HEAD = """# The paper's study, measured

Made by `scripts/paper`; do not edit. *Paper*: the numbers that the paper gives, from its 1.8 GHz laptop. *The paper's
method*: its method alone as flown here (`--as-paper`, [experiments.md](../experiments.md#as-the-paper-has-it)). *Ours*: the
planner as shipped. Times are wall-clock times of one thread on {processor}; where other programs shared the processors,
jumps of 4 ms and more are theirs, and processor time is what to go by.
"""

NOTES = {
    "compare": "",
    "monte_carlo": "",
    "scaling": "Avg_tq is the mean time of one UAV's solution, Avg_tsw that of the whole swarm's, Nnz the nonzeros of the KKT "
               "matrix of one UAV's QP with all rows that could ever be set.",
    "claims": "The spread of progress is how far the first UAV is ahead of the last along x. The paper: UAVs progress "
              "equally in the absence of obstacles, and those lagging behind catch up after them; targets may stand still or "
              "pass through obstacles.",
    "convergence": "One UAV after its target, 50 starts perturbed by up to 20 m, 2.5 m/s and 2 m/s² on each axis, 90 s. "
                   "Settled: its distance to the target changes by less than 1 cm in the last 6 s. Our plans end nearly at "
                   "rest, so that a UAV settles off a moving target: far behind it with a short horizon.",
    "optimality": "Programs as UAVs meet them in flight, solved by at most five SQP iterations, and by Ipopt from the same "
                  "start; ours with the points where the separating planes touch the bodies as variables.",
}


def write(output, figures):
    """Writes paper.md; returns the tables by name."""
    text = [HEAD.format(processor=processor())]
    tables = {}
    for name, study, title, make, pictures in SECTIONS:
        if not (output / f"{study}.json").exists():
            continue
        tables[name] = make(output)
        text.append(f"## {title}\n")
        text.append(table(tables[name]))
        if name == "compare":
            text.append(compare_text(output))
        if NOTES[name]:
            text.append(NOTES[name] + "\n")
        text += [f"![{picture}]({picture})\n" for picture in pictures if picture in figures]
    (output / "paper.md").write_text("\n".join(text))
    return tables
