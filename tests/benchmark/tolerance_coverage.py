#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the error that `simsand run --tolerance` estimates hold? Eleven scenes that are not in the chart's data.

    tolerance_coverage.py [-o FOLDER] [-j JOBS] [--tolerance 5%] [--finest 40] [--table FILE.csv] [--quick]

Each scene is run with the tolerance, and finely in the default configuration, which is taken as the truth. A scene is covered if
h_f and r_f of the truth both lie inside the interval that the program states. Complete fine runs are not run again. Exit status 1
if fewer than four fifths are covered (--quick: fewer than both of two coarse ones).
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
# name: shipped scene, settings. Other grains, packings, aspect ratios; then other sizes, floors, gates and parameters.
SCENES = {
    "es_dense_a1": ("es_dense_a1", []),
    "ts_loose_a2": ("ts_loose_a2", []),
    "ss_dense_a0.5": ("ss_dense_a0.5", []),
    "es_dense_a2": ("es_dense_a2", []),
    "ts_dense_a0.5": ("ts_dense_a0.5", []),
    "ss_dense_a1.5": ("ss_dense_a1", ["column.height=0.075"]),
    "ts_loose_large": ("ts_loose_a1", ["column.radius=0.2", "column.height=0.2", "output.grain_diameter=0.0118",
                                       "end.time=3.0"]),
    "ss_dense_a1": ("ss_dense_a1", []),
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


def fine_run(name, folder, finest):
    """The truth, in a folder of its resolution."""
    target = folder / name / f"fine_{finest:g}"
    if summary(target / "result.h5") is None:
        spacing = math.sqrt(math.prod(column(name))) / finest
        simsand(*scene_files(name, folder), "--set", f"scene.spacing={spacing!r}", "--set",
                "output.snapshot_interval=100.0", "-o", str(target))
    return summary(target / "result.h5")


def estimated(name, folder, tolerance, data):
    """Rows of accuracy.csv: (value, lower, upper) of h_f/r0 and r_f/r0; what was chosen."""
    target = folder / name / f"tolerance_{tolerance.rstrip('%')}"
    simsand(*scene_files(name, folder), "--tolerance", tolerance, "--data", str(data), "-o", str(target))
    lines = (target / "accuracy.csv").read_text().splitlines()
    table = csv.DictReader(line for line in lines if not line.startswith("#"))
    rows = [tuple(float(row[k]) for k in ("value", "lower", "upper")) for row in table]
    with h5py.File(target / "result.h5") as file:
        scene = tomllib.loads(file["scene"].asstr()[()])
    return rows, (math.sqrt(math.prod(column(name))) / scene["scene"]["spacing"],
                  scene["material"].get("stiffness_scale", 1.0))


def compared(name, folder, arguments):
    truth = fine_run(name, folder, arguments.finest)
    rows, (resolution, scale) = estimated(name, folder, arguments.tolerance, arguments.data)
    row = {"scene": name, "particles_a_side": f"{resolution:.3g}", "stiffness_scale": f"{scale:g}"}
    inside = []
    for quantity, (value, lower, upper), true in zip(("h_f", "r_f"), rows, truth):
        inside.append(lower <= true <= upper)
        row |= {f"{quantity}/r0": f"{value:.4f}", f"{quantity}_lower": f"{lower:.4f}", f"{quantity}_upper": f"{upper:.4f}",
                f"{quantity}_fine": f"{true:.4f}", f"{quantity}_error_%": f"{100 * (value / true - 1):.2f}"}
    return row | {"covered": int(all(inside))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("results/tolerance_coverage"))
    parser.add_argument("-j", "--jobs", type=int, default=2)
    parser.add_argument("--tolerance", default="5%")
    parser.add_argument("--finest", type=float, default=40, help="particles a side of the truth")
    parser.add_argument("--table", type=pathlib.Path, help="table of the results; default: coverage.csv in the folder")
    parser.add_argument("--program", type=pathlib.Path, help="simsand; default: that of build/")
    parser.add_argument("--data", type=pathlib.Path, default=ROOT / "data", help="data folder of the project")
    parser.add_argument("--quick", action="store_true", help="two scenes, coarse: tolerance 12%%, truth 20 a side")
    arguments = parser.parse_args()
    global PROGRAM
    PROGRAM = (arguments.program or PROGRAM).resolve()
    names = list(SCENES)
    if arguments.quick:
        names, arguments.tolerance, arguments.finest = ["ss_dense_a0.5", "ss_dense_a1"], "12%", 20
    folder = arguments.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        rows = list(pool.map(lambda name: compared(name, folder, arguments), names))
    with open(arguments.table or folder / "coverage.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    covered = sum(row["covered"] for row in rows)
    for row in rows:
        print(*row.values(), sep="  ")
    print(f"{covered} of {len(rows)} scenes covered")
    sys.exit(covered < 0.8 * len(rows))


if __name__ == "__main__":
    main()
