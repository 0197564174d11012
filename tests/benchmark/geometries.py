#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""One column in axisymmetry, a quarter and the whole in three dimensions, at equal spacing, by runs that differ in the step
alone. Prints every run, and mean and scatter of height, front (where it is a grain high, and where the mean outline is a spacing
high) and radii of the mass for each geometry. At 2 mm a quarter of aspect ratio 1 takes
8 minutes of one core and the whole half an hour. Complete runs are not run again.

usage: geometries.py SIMSAND FOLDER [--column NAME] [--spacing M] [--axisymmetric N] [--quarter N] [--full N] [-j JOBS]"""
import argparse
import h5py
import json
import numpy
import pathlib
import subprocess
from concurrent.futures import ThreadPoolExecutor

SCENES = pathlib.Path(__file__).resolve().parents[2] / "data/scenes"
SOLID = ["scene.geometry=three_dimensional", "scene.sector="]
SETTINGS = {"axisymmetric": [], "quarter": [SOLID[0], SOLID[1] + "quarter"], "full": [SOLID[0], SOLID[1] + "full"]}
SHARES = [0.5, 0.9, 0.99]
RADIUS = 0.05  # m, of all columns
FACTORS = [0.4, 0.39, 0.41, 0.395, 0.405, 0.385, 0.38, 0.375]  # of the step


def command(simsand, *arguments):
    done = subprocess.run([simsand, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")
    return done.stdout


def radius_with(share, file):
    """Radius of the cylinder that holds a share of the mass at the end, m."""
    with h5py.File(file) as result:
        position = result["snapshots"][max(result["snapshots"])]["position"][:]
        mass = result["particles/mass"][:]
    radius = position[:, 0] if position.shape[1] == 2 else numpy.hypot(position[:, 0], position[:, 1])
    order = numpy.argsort(radius)
    return numpy.interp(share, numpy.cumsum(mass[order]) / mass.sum(), radius[order])


def front_at(thickness, file):
    """Radius at which the mean outline at the end is `thickness` high, m."""
    with h5py.File(file) as result:
        radius = result["outline/r"][:]
        height = result["snapshots"][max(result["snapshots"])]["outline"][:]
    last = numpy.flatnonzero(height >= thickness)[-1]
    return numpy.interp(-thickness, -height[last : last + 2], radius[last : last + 2])


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
    run = {name: entry["value"] if isinstance(entry, dict) else entry for name, entry in summary.items()}
    run["front_of_spacing"] = front_at(spacing, place / "result.h5") / RADIUS
    return run | {share: radius_with(share, place / "result.h5") / RADIUS for share in SHARES}


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
    collected = {}
    for (geometry, factor), run in zip(cases, runs):
        values = [run["final_height"], 1 + run["runout"], run["front_of_spacing"], *(run[share] for share in SHARES)]
        collected.setdefault(geometry, []).append(values)
        print(f"{geometry:<14}{factor:>12}{values[0]:>8.3f}{values[1]:>8.3f}{run['time_to_rest'] or float('nan'):>8.3f}"
              f"{run['steps']:>8.0f}{run['time_processor']:>8.0f}{run['particles'] * run['steps'] / run['time_processor'] / 1e6:>7.2f}"
              f"{run['energy_imbalance']:>11.1e}")
    names = ["h_f/r0", "r_f/r0", "r_f 1 dx", *(f"r {100 * share:g} %" for share in SHARES)]
    print(f"\n{'geometry':<14}{'runs':>5}" + "".join(f"{name:>9}{'+-':>7}{'ratio':>7}" for name in names))
    first = numpy.mean(next(iter(collected.values())), axis=0)
    for geometry, values in collected.items():
        mean = numpy.mean(values, axis=0)
        scatter = numpy.std(values, axis=0, ddof=1) if len(values) > 1 else numpy.full(len(names), numpy.nan)
        print(f"{geometry:<14}{len(values):>5}" + "".join(f"{m:>9.3f}{d:>7.3f}{m / f:>7.3f}" for m, d, f in zip(mean, scatter, first)))


if __name__ == "__main__":
    main()
