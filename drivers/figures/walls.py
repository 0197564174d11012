#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Sand and walls of a scene in the plane at six times, coloured by speed, and the forces on the walls in time.
Usage: walls.py RESULT.h5 [-o DIR]"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.result import Result
from figures.style import plt
import numpy as np
from matplotlib.collections import EllipseCollection

GREY = "#999999"


def displacement(wall, time, horizontal):
    """Of a wall since time 0, m: the integral of its piecewise linear velocity."""
    if "times" in wall:
        times = np.array(wall["times"])
        speeds = [wall.get(f"velocity_{axis}", [0.0] * len(times)) for axis in (horizontal, "z")]
    elif "velocity" in wall:
        times = np.array([wall["start"], wall["end"]])
        speeds = [[v, v] for v in wall["velocity"]]
    else:
        return np.zeros(2)
    at = np.unique(np.concatenate([times[times < time], [min(max(time, times[0]), times[-1])]]))
    return np.array([np.trapz(np.interp(at, times, speed), at) for speed in speeds])


def rectangle(ax, low, high, shift, solid):
    low, high = np.array(low) + shift, np.array(high) + shift
    x = [low[0], high[0], high[0], low[0], low[0]]
    z = [low[1], low[1], high[1], high[1], low[1]]
    if solid:
        ax.fill(x, z, color=GREY, zorder=0)
    else:
        ax.plot(x, z, color="black", lw=1.2)


def draw_wall(ax, wall, time, horizontal):
    shift = displacement(wall, time, horizontal)
    if wall["shape"] == "plane":
        point, normal = np.array(wall["point"]) + shift, np.array(wall["normal"])
        along = 1e2 * np.array([normal[1], -normal[0]]) / np.hypot(*normal)
        ax.plot(*np.array([point - along, point + along]).T, color="black", lw=1.2, scalex=False, scaley=False)
    elif wall["shape"] == "box":
        rectangle(ax, wall["lower"], wall["upper"], shift, wall["side"] == "outside")
    else:
        middle, radius = wall.get("center", [0.0])[0], wall["radius"]
        rectangle(ax, [middle - radius, wall["lower"]], [middle + radius, wall["upper"]], shift,
                  wall["side"] == "outside")


def sand(run):
    walls = run.scene.get("wall", [])
    spacing = run.scene_value("scene", "spacing")
    chosen = [run.snapshots[k] for k in np.unique(np.linspace(0, len(run.snapshots) - 1, 6).astype(int))]
    places = np.concatenate([s["position"] for s in chosen])
    low, high = np.percentile(places, 0.5, axis=0) - 6 * spacing, np.percentile(places, 99.5, axis=0) + 6 * spacing
    fastest = max(np.percentile(np.linalg.norm(s["velocity"], axis=1), 98) for s in chosen)
    width, height = high - low
    columns = 2 if width > 1.5 * height else 3
    rows = -(-len(chosen) // columns)
    panel = 10 / columns
    fig, axes = plt.subplots(rows, columns, figsize=(10.8, rows * (panel * height / width + 0.5)), sharex=True,
                             sharey=True, squeeze=False, layout="constrained")
    for ax in axes.flat[len(chosen):]:
        ax.set_visible(False)
    for ax, snapshot in zip(axes.flat, chosen):
        position = snapshot["position"]
        size = np.full(len(position), spacing)
        discs = EllipseCollection(size, size, 0 * size, units="xy", offsets=position, transOffset=ax.transData,
                                  cmap="viridis", lw=0)
        discs.set_array(np.linalg.norm(snapshot["velocity"], axis=1))
        discs.set_clim(0, fastest)
        ax.add_collection(discs)
        ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", title=f"{snapshot.time:.2f} s")
        for wall in walls:
            draw_wall(ax, wall, snapshot.time, run.horizontal)
    for ax in axes[-1]:
        ax.set_xlabel(f"${run.horizontal}$ / m")
    for ax in axes[:, 0]:
        ax.set_ylabel("$z$ / m")
    fig.colorbar(discs, ax=axes, label="speed / (m/s)", shrink=0.7, extend="max")
    return fig


def forces(run):
    names = [n[len("wall_"):-len("_normal_force")] for n in run.series if n.endswith("_normal_force")]
    fig, ax = plt.subplots(figsize=(7, 3.6), layout="constrained")
    for name in names:
        ax.plot(run.series["time"][1:], run.series[f"wall_{name}_normal_force"][1:], label=name, lw=1.2)
    ax.set(xlabel="$t$ / s", ylabel="normal force / " + ("(N/m)" if run.geometry == "plane_strain" else "N"))
    ax.legend(frameon=False)
    return fig


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("result", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    arguments = parser.parse_args()
    folder = arguments.output or arguments.result.parent
    folder.mkdir(parents=True, exist_ok=True)
    run = Result(arguments.result)
    if run.dimension != 2:
        raise SystemExit("expected a result in the plane")
    for name, figure in {"walls": sand(run), "wall_forces": forces(run)}.items():
        figure.savefig(folder / f"{name}.png", dpi=110)
        print(folder / f"{name}.png")


if __name__ == "__main__":
    main()
