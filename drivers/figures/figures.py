#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a run: outlines, displacement, height, energy, state; in three
dimensions azimuthal means, and a view of the solid. Usage: figures.py RESULT.h5 [-o DIR]"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.draw import level_line, particles, surface
from figures.result import Result
from figures.style import AMBER, BLUE, GREEN, GREY, MM, ORANGE, PURPLE, SKY, plt, use
import numpy as np
from mpl_toolkits.axes_grid1 import make_axes_locatable

CARRIES_STRESS = 20.0  # Pa: below it void ratios are those of loose grains
use(font_size=10, dpi=160)


def mirrored(r, z):
    """A line from the axis outwards, continued to the other side."""
    return np.concatenate([-r[::-1], r]), np.concatenate([z[::-1], z])


def geometric(ax, run, left, right, top):
    ax.set_aspect("equal")
    ax.set_xlim(left, right)
    ax.set_ylim(0, top)
    ax.set_xlabel(f"${run.horizontal}$ / mm")
    ax.set_ylabel("$z$ / mm")
    if run.geometry != "plane_strain":
        ax.xaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")


def colour_bar(ax, discs, label):
    """As high as the axes; pointed where values lie beyond its range."""
    values, (low, high) = discs.get_array(), discs.get_clim()
    ends = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
    cax = make_axes_locatable(ax).append_axes("right", size=0.14, pad=0.12)
    ax.figure.colorbar(discs, cax=cax, label=label, extend=ends[int(values.min() < low), int(values.max() > high)])


def initial_rectangle(ax, run, both_sides):
    radius, height = (MM * run.scene_value("column", key) for key in ("radius", "height"))
    left = -radius if both_sides else 0
    ax.plot([left, left, radius, radius], [0, height, height, 0], "--", color=GREY, lw=1, label="initial column",
            zorder=4)


def extent(run):
    """Half width and height of the pictures, mm: the deposit at all times, not the last stray particle."""
    reach = np.percentile(np.abs(run.in_plane(run.final["position"])[:, 0]), 99)
    for snapshot in run.snapshots:
        if snapshot.has("outline"):
            reach = max(reach, *run.radii[snapshot["outline"] > 0], 0)
    height = max(np.percentile(s["position"][:, -1], 99) for s in run.snapshots)
    return 1.08 * MM * reach, 1.15 * MM * height


def geometric_figure(run, both_sides, panels, extra):
    """Figure whose panels have the proportions of the deposit; `extra` inches of height for labels."""
    width, top = extent(run)
    panel = 7.6 * top / (2 * width if both_sides else width)
    fig, axes = plt.subplots(panels, 1, figsize=(9, panels * (panel + extra)), sharex=True, squeeze=False)
    for ax in axes[:, 0]:
        geometric(ax, run, -width if both_sides else 0, width, top)
    for ax in axes[:-1, 0]:
        ax.set_xlabel("")
    return fig, axes[:, 0]


def note_strays(ax, run):
    beyond = int((np.abs(MM * run.in_plane(run.final["position"])[:, 0]) > ax.get_xlim()[1]).sum())
    text = f"$t$ = {run.final.time:.2f} s"
    if beyond:
        text += f"\n{beyond} of {len(run.initial_position)} particles\nlie further out"
    ax.text(0.01, 0.95, text, transform=ax.transAxes, va="top", fontsize=9)


def distinct(run, count):
    """Numbers of the snapshots that divide the change of the outline into equal parts."""
    lines = np.array([s["outline"] for s in run.snapshots])
    change = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(lines, axis=0)).sum(axis=1))])
    if change[-1] == 0:
        return [0, len(lines) - 1]
    # The last that still differs by a percent of the whole change counts as final.
    parts = np.linspace(0, 0.99 * change[-1], count)
    return sorted({int(np.abs(change - part).argmin()) for part in parts[:-1]} | {len(lines) - 1})


def outlines(run):
    chosen = distinct(run, 9)
    colours = plt.get_cmap("viridis_r")(np.linspace(0.12, 1, len(chosen)))
    fig, (ax,) = geometric_figure(run, True, 1, 0.9)
    for number, colour in zip(chosen, colours):
        snapshot = run.snapshots[number]
        r, z = surface(run.radii, snapshot["outline"])
        last = number == chosen[-1]
        ax.plot(*mirrored(r, z), color=colour, lw=2.2 if last else 1.3, label=f"{snapshot.time:.2f} s")
    ax.legend(title="time", loc="center left", bbox_to_anchor=(1.01, 0.5))
    return fig


def displacement(run):
    grain, spacing = MM * run.scene_value("output", "grain_diameter"), MM * run.scene_value("scene", "spacing")
    position, u = run.azimuthal_mean(MM * run.displacement())
    position = MM * position
    both = np.concatenate([position * [-1, 1], position])
    fig, (ax,) = geometric_figure(run, True, 1, 1.2)
    high = max(np.percentile(u, 98), grain)
    discs = particles(ax, both, np.concatenate([u, u]), spacing, "viridis", 0, high)
    if u.min() < grain < u.max():
        level_line(ax, both, np.concatenate([u, u]), grain, 3 * spacing)
        ax.plot([], [], color=ORANGE, lw=1.8, label=f"displacement of one grain, {grain:.2f} mm")
    initial_rectangle(ax, run, both_sides=True)
    ax.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    colour_bar(ax, discs, "displacement / mm")
    note_strays(ax, run)
    return fig


def height(run):
    time, h, front = (run.series[name] for name in ("time", "height", "front_radius"))
    r0 = run.scene_value("column", "radius")
    fig, (upper, lower) = plt.subplots(2, 1, figsize=(6.4, 5.4), sharex=True)
    upper.plot(time, h / h[0], color=BLUE, lw=1.8)
    upper.set_ylabel("height $h/h_0$")
    upper.set_ylim(0, 1.05 * max(1, (h / h[0]).max()))
    lower.plot(time, front / r0 - 1, color=ORANGE, lw=1.8)
    lower.set_ylabel("runout $(%s - %s_0)/%s_0$" % ((run.horizontal,) * 3))
    lower.set_ylim(bottom=min(0, (front / r0 - 1).min()))
    lower.set_xlabel("time $t$ / s")
    for ax in (upper, lower):
        ax.grid(color="0.9")
        ax.margins(x=0)
    return fig


def energy(run):
    """Budget: kinetic + potential - sum of all works stays at its initial value."""
    time, kinetic, potential = (run.series[name] for name in ("time", "kinetic_energy", "potential_energy"))
    works = {name[5:].replace("_", " "): w for name, w in run.series.items() if name.startswith("work_")}
    whole = potential[0]
    residual = kinetic + potential - sum(works.values()) - (kinetic[0] + potential[0])
    fig, (upper, lower) = plt.subplots(2, 1, figsize=(7.4, 6), sharex=True, height_ratios=[3, 1])
    upper.plot(time, 100 * potential / whole, color=BLUE, lw=1.8, label="potential")
    upper.plot(time, 100 * kinetic / whole, color=ORANGE, lw=1.8, label="kinetic")
    colours = (GREEN, PURPLE, SKY, AMBER, GREY)
    for k, (name, work) in enumerate(sorted(works.items(), key=lambda item: item[1][-1])):
        upper.plot(time, -100 * work / whole, "--", color=colours[k % 5], lw=1.6, label=f"taken by {name}")
    upper.set_ylabel("share of the initial\npotential energy / %")
    upper.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    lower.plot(time, 100 * residual / whole, color="black", lw=1.4)
    bound = max(1.1 * 100 * np.abs(residual / whole).max(), 0.1)  # not a picture of rounding errors
    lower.set_ylim(-bound, bound)
    lower.set_ylabel("unaccounted / %")
    lower.set_xlabel("time $t$ / s")
    for ax in (upper, lower):
        ax.grid(color="0.9")
        ax.margins(x=0)
    fig.align_ylabels()
    return fig


def state(run):
    spacing = MM * run.scene_value("scene", "spacing")
    position, e = run.azimuthal_mean(run.final["state_void_ratio"])
    position, pressure = run.azimuthal_mean(-run.final["stress"][:, :3].sum(axis=1) / 3)
    position = MM * position
    settled = e[pressure > CARRIES_STRESS] if (pressure > CARRIES_STRESS).any() else e
    fig, axes = geometric_figure(run, False, 2, 0.6)
    panels = [(e, "void ratio $e$", "viridis", *np.percentile(settled, [1, 99])),
              (pressure, "mean stress $p$ / Pa", "cividis_r", 0, max(np.percentile(pressure, 99.5), 1))]
    for ax, (values, label, cmap, low, high) in zip(axes, panels):
        if high - low < 1e-3 * abs(high):  # uniform: keep rounding out of the colours
            low, high = low - 0.01 * abs(high), high + 0.01 * abs(high)
        discs = particles(ax, position, values, spacing, cmap, low, high)
        initial_rectangle(ax, run, both_sides=False)
        colour_bar(ax, discs, label)
    axes[0].legend(loc="upper right")
    return fig


def solid(run):
    """Three dimensions: the deposit seen from outside and above, each particle a disc."""
    spacing, reach, top = MM * run.scene_value("scene", "spacing"), *extent(run)
    position, u = MM * run.final["position"], MM * run.displacement()
    azimuth, elevation = np.radians(40), np.radians(28)
    towards = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0])
    upwards = np.cross(towards, right)
    near = np.hypot(position[:, 0], position[:, 1]) < reach
    order = np.flatnonzero(near)[np.argsort(position[near] @ towards)]  # the nearest is drawn last
    seen = np.column_stack([position[order] @ right, position[order] @ upwards])
    fig, ax = plt.subplots(figsize=(9, 6))
    discs = particles(ax, seen, u[order], 1.2 * spacing, "viridis", 0, np.percentile(u, 98))
    ax.set_aspect("equal")
    ax.set_axis_off()
    ax.set_xlim(seen[:, 0].min() - spacing, seen[:, 0].max() + spacing)
    ax.set_ylim(seen[:, 1].min() - spacing, seen[:, 1].max() + spacing)
    colour_bar(ax, discs, "displacement / mm")
    ax.text(0.01, 0.95, f"$t$ = {run.final.time:.2f} s", transform=ax.transAxes, fontsize=9)
    return fig


def main():
    parser = argparse.ArgumentParser(description="Pictures of a run.")
    parser.add_argument("result", type=pathlib.Path, help="result file, .h5")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder of the pictures (default: the result's)")
    arguments = parser.parse_args()
    folder = arguments.output or arguments.result.parent
    failed = False
    try:
        run = Result(arguments.result)
        folder.mkdir(parents=True, exist_ok=True)
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"{arguments.result}: {error}".replace("\n", " "))
    for draw in (outlines, displacement, height, energy, state) + ((solid,) if run.dimension == 3 else ()):
        path = folder / f"{draw.__name__}.png"
        try:
            fig = draw(run)
            if not run.complete:
                fig.text(0.01, 0.01, "the run ended early", color=ORANGE, fontsize=8)
            fig.savefig(path, bbox_inches="tight")
            print(path)
        except (OSError, ValueError, KeyError, IndexError) as error:
            print(f"{path}: not drawn: {error}".replace("\n", " "), file=sys.stderr)
            failed = True
        plt.close("all")
    sys.exit(int(failed))


if __name__ == "__main__":
    main()
