# Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
"""What the campaigns of scripts/ share: flying experiments with swarm_experiment, and tables.

An experiment is a call of swarm_experiment over a range of seeds. The range is cut into chunks, several of which fly at
the same time: flights do not depend on what else runs, only their planning times do.
"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

PROCESSES = 2
CHUNK = 20  # flights per call of the program


def fly(program, experiment, seeds):
    """The runs of a range of seeds, as swarm_experiment reports them."""
    with tempfile.TemporaryDirectory() as directory:
        results = pathlib.Path(directory, "results.json")
        command = [program, *experiment.command(*seeds), "--json", str(results)]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(command)}\n{done.stderr}")
        return json.loads(results.read_text())


def chunks(experiment):
    first, end = experiment.first_seed, experiment.first_seed + experiment.seeds
    return [(seed, min(seed + CHUNK, end) - 1) for seed in range(first, end, CHUNK)]


def fly_all(program, experiments, output_dir, processes=PROCESSES):
    """(experiment, its runs) for each, in order; the results are kept in output_dir as they come."""
    flights = sum(experiment.seeds for experiment in experiments)
    flown = []
    with concurrent.futures.ThreadPoolExecutor(processes) as pool:
        pending = [
            [pool.submit(fly, program, experiment, seeds) for seeds in chunks(experiment)]
            for experiment in experiments
        ]
        done = 0
        line_start = "\r" if sys.stdout.isatty() else ""  # over the progress
        try:
            for experiment, parts in zip(experiments, pending):
                runs = []
                for part in parts:
                    runs += part.result()
                    if line_start:
                        print(f"{line_start}{done + len(runs):5d}/{flights}", end="", flush=True)
                done += len(runs)
                (output_dir / experiment.file_name()).write_text(json.dumps(runs, indent=1) + "\n")
                print(f"{line_start}{done:5d}/{flights} flights  {experiment.summary(runs)}", flush=True)
                flown.append((experiment, runs))
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return flown


def aligned(rows, left=(0, -1)):
    """Columns as wide as they need to be; those with an index in `left` are aligned left, the others right."""
    count = len(rows[0])
    left = {index % count for index in left}
    widths = [max(len(cells[i]) for cells in rows) for i in range(count)]
    lines = []
    for cells in rows:
        texts = [text.ljust(widths[i]) if i in left else text.rjust(widths[i]) for i, text in enumerate(cells)]
        lines.append("  ".join(texts).rstrip())
    return "\n".join(lines)


def flight_count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'expected a whole number >= 1, not "{text}"')
    return int(text)
