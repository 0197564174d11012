#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One column in axisymmetry, a quarter and the whole in three dimensions, at equal spacing, by runs that differ in the step
alone. Prints every run, and mean and scatter of height and front for each geometry. At 2 mm a quarter of aspect ratio 1 takes
8 minutes of one core and the whole half an hour. Complete runs are not run again.

usage: geometries.py SIMSAND FOLDER [--column NAME] [--spacing M] [--axisymmetric N] [--quarter N] [--full N] [-j JOBS]"""
import argparse
import json
import pathlib
import statistics
import subprocess
from concurrent.futures import ThreadPoolExecutor

SCENES = pathlib.Path(__file__).resolve().parents[2] / "data/scenes"
SOLID = ["scene.geometry=three_dimensional", "scene.sector="]
SETTINGS = {"axisymmetric": [], "quarter": [SOLID[0], SOLID[1] + "quarter"], "full": [SOLID[0], SOLID[1] + "full"]}
FACTORS = [0.4, 0.39, 0.41, 0.395, 0.405, 0.385, 0.38, 0.375]  # of the step


def command(simsand, *arguments):
    done = subprocess.run([simsand, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def collapse(simsand, folder, column, spacing, geometry, factor):
    """Summary of one run: name to value."""
    place = folder / f"{column}_{geometry}_{1000 * spacing:g}mm_{factor}"
    if not (place / "complete").exists():
        fresh = not (place / "checkpoint.h5").exists()
        settings = [f"scene.spacing={spacing}", f"numerics.step_factor={factor}", *SETTINGS[geometry]]
        setting = [word for value in settings for word in ("--set", value)]
        start = [SCENES / f"{column}.toml", *setting, "-o", place] if fresh else ["--resume", place]
        command(simsand, "run", *start, "-t", "1", "-q")
        (place / "complete").touch()
    summary = json.loads(command(simsand, "info", place / "result.h5", "--json"))["summary"]
    return {name: entry["value"] if isinstance(entry, dict) else entry for name, entry in summary.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("simsand")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--column", default="ts_dense_a1", help="a scene of data/scenes, axisymmetric")
    parser.add_argument("--spacing", type=float, default=0.002, help="m")
    for geometry, count in (("axisymmetric", 8), ("quarter", 3), ("full", 1)):
        parser.add_argument(f"--{geometry}", type=int, default=count, help="runs, at most 8")
    parser.add_argument("-j", "--jobs", type=int, default=1, help="runs at a time, each on one thread")
    given = parser.parse_args()
    given.folder.mkdir(parents=True, exist_ok=True)
    cases = [(geometry, factor) for geometry in SETTINGS for factor in FACTORS[: getattr(given, geometry)]]
    with ThreadPoolExecutor(given.jobs) as pool:
        runs = list(pool.map(lambda case: collapse(given.simsand, given.folder, given.column, given.spacing, *case), cases))
    print(f"{'geometry':<14}{'step factor':>12}{'h_f/r0':>8}{'r_f/r0':>8}{'rest s':>8}{'steps':>8}{'cpu s':>8}{'1e6/s':>7}{'imbalance':>11}")
    fronts, heights = {}, {}
    for (geometry, factor), run in zip(cases, runs):
        heights.setdefault(geometry, []).append(run["final_height"])
        fronts.setdefault(geometry, []).append(1 + run["runout"])
        print(f"{geometry:<14}{factor:>12}{run['final_height']:>8.3f}{1 + run['runout']:>8.3f}{run['time_to_rest'] or float('nan'):>8.3f}"
              f"{run['steps']:>8.0f}{run['time_processor']:>8.0f}{run['particles'] * run['steps'] / run['time_processor'] / 1e6:>7.2f}"
              f"{run['energy_imbalance']:>11.1e}")
    print(f"\n{'geometry':<14}{'runs':>5}{'h_f/r0':>8}{'+-':>7}{'ratio':>7}{'r_f/r0':>8}{'+-':>7}{'ratio':>7}")
    for geometry in heights:
        row = f"{geometry:<14}{len(heights[geometry]):>5}"
        for values in (heights, fronts):
            mean = statistics.mean(values[geometry])
            scatter = statistics.stdev(values[geometry]) if len(values[geometry]) > 1 else float("nan")
            row += f"{mean:>8.3f}{scatter:>7.3f}{mean / statistics.mean(values[next(iter(heights))]):>7.3f}"
        print(row)


if __name__ == "__main__":
    main()
