#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a scheme could save that leaves resting sand out: the share of a run's particle-steps that belong to sand that is slower
than a part of sqrt(g h0) together with all within its reach. Until the time of rest that the run reports, and by thirds of the time.

usage: resting_share.py RESULT.h5 ... [--slow 1e-2 1e-3]"""
import argparse
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "drivers"))
from figures.result import Result  # noqa: E402

CELL, RING = 1.7, 2  # spacings; cells around that must be slow too: the kernel's reach and the skin, 3.4 spacings


def resting(snapshot, spacing, speed):
    """Which particles and all around them are slower than `speed`, m/s."""
    cells = np.floor(snapshot["position"] / (CELL * spacing)).astype(int)
    cells -= cells.min(axis=0) - RING
    fast = np.zeros(cells.max(axis=0) + RING + 1, dtype=bool)
    moving = np.linalg.norm(snapshot["velocity"], axis=1) > speed
    fast[tuple(cells[moving].T)] = True
    for axis in range(fast.ndim):
        fast = np.any([np.roll(fast, k, axis) for k in range(-RING, RING + 1)], axis=0)
    return ~fast[tuple(cells.T)]


def shares(result, slow):
    """Share of the particle-steps in sand at rest: of the run, and of thirds of its time."""
    speed = slow * np.sqrt(result.scene_value("scene", "gravity") * result.scene_value("column", "height"))
    spacing = result.scene_value("scene", "spacing")
    end = result.series["time"][-1]
    at = np.array([s.time for s in result.snapshots])
    share = np.array([resting(s, spacing, speed).mean() for s in result.snapshots])
    time, step = result.series["time"][1:], result.series["step_size"][1:]
    steps = np.diff(result.series["time"]) / step
    here = np.interp(time, at, share)
    third = np.minimum((3 * time / end).astype(int), 2)
    parts = [np.average(here[third == k], weights=steps[third == k]) for k in range(3)]
    return np.average(here, weights=steps), parts


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", nargs="+")
    parser.add_argument("--slow", nargs="+", type=float, default=[1e-2, 1e-3], help="over sqrt(g h0)")
    arguments = parser.parse_args()
    for file in arguments.results:
        result = Result(file)
        for slow in arguments.slow:
            whole, thirds = shares(result, slow)
            print(f"{file}: slower than {slow:g} sqrt(g h0): {100 * whole:.0f} % of the particle-steps; thirds of the time: "
                  + ", ".join(f"{100 * x:.0f}" for x in thirds) + f" %; at most {1 / (1 - whole):.2f} times as fast")


if __name__ == "__main__":
    main()
