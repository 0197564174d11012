#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plans against runs: what `simsand run --plan` says of columns, and what then happens. Prints a table.
Usage: plan.py SIMSAND [SPACING ...]  (m; default 0.005 0.004 0.003; 0.002 takes minutes)"""
import json
import math
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SCENE = """[scene]
geometry = "{geometry}"
spacing = {spacing}
[column]
radius = 0.05
height = {height}
[material]
file = "{source}/data/materials/{material}.toml"
void_ratio = {void_ratio}
[floor]
friction = 0.5
[gate]
motion = "lift"
speed = 1.6
[end]
time = 3
[output]
folder = "results"
sample_interval = 0.005
snapshot_interval = 0.05
grain_diameter = 0.003
"""


def planned(text):
    """Steps, seconds and bytes of a plan's page."""
    value = lambda pattern: float(re.search(pattern, text)[1])
    return {"end": value(r"simulated +(\S+) s"), "steps": value(r"steps +(\S+) of"), "step": value(r"of (\S+) s\n"),
            "rate": value(r"(\S+) particle-steps"), "memory": value(r"memory +(\S+) MB"),
            "disk": value(r"disk +(\S+) MB")}


def peak_of(command, folder):
    """Runs it; MB in use at most, CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(["/usr/bin/python3", "-c", "import subprocess, resource, sys; "
                          "subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); "
                          "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)", *command],
                         cwd=folder, check=True, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return 1024e-6 * float(run.stdout), after.ru_utime - before.ru_utime


def compare(simsand, case):
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "scene.toml").write_text(SCENE.format(source=SOURCE, **case))
        text = subprocess.run([simsand, "run", "-t", "1", "--plan", "scene.toml"], cwd=folder, check=True,
                              capture_output=True, text=True).stdout
        plan = planned(text)
        memory, seconds = peak_of([simsand, "run", "-q", "-t", "1", "scene.toml"], folder)
        result = pathlib.Path(folder) / "results/result.h5"
        run = json.loads(subprocess.run([simsand, "info", "--json", result], check=True, capture_output=True,
                                        text=True).stdout)
        disk = result.stat().st_size / 1e6
    actual = {"end": run["time"], "steps": run["steps"], "step": run["time"] / run["steps"],
              "rate": run["steps"] * run["particles"] / seconds, "memory": memory, "disk": disk}
    return {name: plan[name] / actual[name] for name in actual}


def main():
    simsand = pathlib.Path(sys.argv[1]).resolve()
    ratios = []
    print("plan over run (rate: of CPU time)\n" + " " * 40 + "  end steps  step  rate memory  disk")
    for spacing in [float(a) for a in sys.argv[2:]] or [0.005, 0.004, 0.003]:
        for aspect in (0.5, 1, 4):
            for geometry in ("axisymmetric", "plane_strain"):
                for material, void_ratio in (("TS", 0.4451), ("SS", 0.7)):
                    case = {"geometry": geometry, "spacing": spacing, "height": 0.05 * aspect, "material": material,
                            "void_ratio": void_ratio}
                    ratio = compare(simsand, case)
                    ratios.append(ratio)
                    print(f"{geometry:13} a {aspect:<4} {material} {1e3 * spacing:g} mm".ljust(40)
                          + "".join(f"{v:6.2f}" for v in ratio.values()), flush=True)
    for name in ratios[0]:
        logs = sorted(math.log(r[name]) for r in ratios)
        inside = sum(abs(v) <= math.log(1.5) for v in logs)
        print(f"{name}: median {math.exp(logs[len(logs) // 2]):.2f}, from {math.exp(logs[0]):.2f} to "
              f"{math.exp(logs[-1]):.2f}, {inside} of {len(logs)} within a factor of 1.5")


main()
