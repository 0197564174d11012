#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tables, pictures and the page of `simsand study columns`.

    study_columns.py FOLDER --data DATA      FOLDER/SET/COLUMN/result.h5 -> FOLDER/*.csv, *.png, index.html

Pictures follow the paper of Jin, Lu and Yang: its Figs. 4 (fields at a = 2), 5 and 6 (outlines in time), 7 (height in
time), 8 and 9 (deposits beside the laws), 10 (final fields of all columns)."""
import argparse
import html
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from figures import BLUE, GREEN, GREY, MM, ORANGE, level_line, particles, surface
from study_data import (ASPECTS, PACKINGS, SHAPES, deviation, law_value, outline_distance, read_dem, read_laws,
                        read_runs)
from study_page import PAGE, embedded, page_table, write_table

COLOUR = dict(zip(SHAPES, (BLUE, ORANGE, GREEN)))
MARKER = {"dense": "o", "loose": "s"}
TITLES = {"table4": "parameters of the paper's Table 4", "dem": "parameters calibrated on DEM triaxial tests",
          "literal": "Table 2 read literally: the printed porosity as void ratio"}
TIMES = (0.0, 0.06, 0.1, 0.14, 0.18, 0.24, 0.3)  # s, of outlines; the end is added
HEIGHT_LAW, RUNOUT_LAW, RADIUS_LAW = "h_f / r_0", "(r_f - r_0) / r_0", "r_f / r_0"


def rows_of(runs, dem, laws):
    """One row a run: its numbers, those of DEM and the laws, errors in per cent."""
    for key in sorted(runs, key=lambda k: (SHAPES.index(k[0]), k[1], k[2])):
        run, other = runs[key], dem.get(key)
        row = {"shape": key[0], "packing": key[1], "a": key[2], "void_ratio": run.void_ratio,
               "height": run.height, "runout": run.runout, "time_to_rest_s": run.rest,
               "undisturbed": run.undisturbed}
        if other:
            height, radius = deviation(run, other)
            row |= {"dem_height": other.height, "dem_runout": other.runout,
                    "dem_undisturbed": other.undisturbed, "height_error_%": 100 * height,
                    "radius_error_%": 100 * radius, "outline_distance_%": 100 * outline_distance(run, other)}
        for (source, quantity, reading), pieces in laws.items():
            if quantity == HEIGHT_LAW:
                row[f"{source} height"] = law_value(pieces, key[2])
            elif quantity == RUNOUT_LAW and reading != "first reading":
                row[f"{source} runout"] = law_value(pieces, key[2])
        row |= {"energy_imbalance": run.summary["energy_imbalance"], "particles": run.summary["particles"],
                "steps": run.summary["steps"], "seconds": run.summary["wall_clock"]}
        if other:
            row["dem_seconds_over_ours"] = other.seconds / run.summary["wall_clock"]
        yield row


def deposits(runs, dem, laws):
    """Figs. 8 and 9: final height and runout against the aspect ratio, SPH filled, DEM open."""
    fig, axes = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    a = np.geomspace(0.4, 5, 200)
    styles = {"Lube 2004": "-", "Lajeunesse 2004": "--"}
    for (source, quantity, reading), pieces in laws.items():
        values = np.array([law_value(pieces, x) for x in a])
        if quantity == RADIUS_LAW:
            values, quantity = values - 1, RUNOUT_LAW
        panel = {HEIGHT_LAW: 0, RUNOUT_LAW: 1}.get(quantity)
        if panel is not None:
            axes[panel].plot(a, values, styles.get(source, ":"), color=GREY, lw=1,
                             label=f"{source}{', ' + reading if reading else ''}")
    for values, filled, name in ((runs, True, "SPH"), (dem, False, "DEM")):
        for shape in SHAPES:
            for packing in PACKINGS:
                points = [(k[2], v.height, v.runout) for k, v in sorted(values.items())
                          if k[:2] == (shape, packing)]
                if not points:
                    continue
                x, heights, runouts = np.array(points).T
                for ax, y in zip(axes, (heights, runouts)):
                    ax.plot(x, y, MARKER[packing], color=COLOUR[shape], ms=7, ls="-" if filled else "none", lw=0.6,
                            mfc=COLOUR[shape] if filled else "none", mew=1.4, label=f"{name} {shape} {packing}")
    for ax, label in zip(axes, ("final height $h_f/r_0$", "runout $(r_f - r_0)/r_0$")):
        ax.set_xscale("log")
        ax.set_xticks(ASPECTS, [f"{x:g}" for x in ASPECTS])
        ax.minorticks_off()
        ax.set_xlabel("aspect ratio $a = h_0/r_0$")
        ax.set_ylabel(label)
        ax.set_ylim(bottom=0)
        ax.grid(color="0.92")
    lines = {l.get_label(): l for ax in axes for l in ax.get_lines()}
    axes[1].legend(lines.values(), lines.keys(), loc="upper left", bbox_to_anchor=(1.02, 1.02), fontsize=8)
    return fig


def nearest(times, wanted):
    return sorted({int(np.abs(np.asarray(times) - t).argmin()) for t in wanted} | {len(times) - 1})


def outlines(runs, dem, aspect=2.0, packing="dense"):
    """Figs. 5 and 6: outlines in time, SPH left and DEM right of the axis."""
    shapes = [s for s in SHAPES if (s, packing, aspect) in runs]
    if not shapes:
        return None
    fig, axes = plt.subplots(len(shapes), 1, figsize=(9, 3.1 * len(shapes)), sharex=True, squeeze=False,
                             layout="constrained")
    colours = plt.get_cmap("viridis_r")(np.linspace(0.1, 1, len(TIMES) + 1))
    for ax, shape in zip(axes[:, 0], shapes):
        run, other = runs[shape, packing, aspect], dem.get((shape, packing, aspect))
        snapshots = run.result.snapshots
        for colour, n in zip(colours, nearest([s.time for s in snapshots], TIMES)):
            r, z = surface(run.result.radii, snapshots[n]["outline"])
            ax.plot(-r, z, color=colour, lw=1.4, label=f"{snapshots[n].time:.2f} s")
        if other:
            for colour, n in zip(colours, nearest(other["time"], TIMES)):
                r, z = surface(other["outline/radius"], other["outline/height"][n])
                ax.plot(r, z, color=colour, lw=1.4)
        else:
            ax.text(0.75, 0.5, "no DEM yet", transform=ax.transAxes, ha="center", color=GREY)
        ax.set_aspect("equal")
        ax.set_title(f"{shape} {packing}, $a$ = {aspect:g}: SPH left, DEM right", fontsize=10)
        ax.set_ylabel("$z$ / mm")
        ax.axvline(0, color="0.8", lw=0.8)
    axes[0, 0].legend(loc="upper left", fontsize=8, title="time (SPH)")
    axes[-1, 0].set_xlabel("$r$ / mm")
    axes[-1, 0].xaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")
    return fig


def heights(runs, dem, packing="dense"):
    """Fig. 7: height in time over initial height, one panel an aspect ratio."""
    fig, axes = plt.subplots(1, 4, figsize=(13, 3.6), sharey=True, layout="constrained")
    for ax, aspect in zip(axes, ASPECTS):
        for shape in SHAPES:
            run, other = runs.get((shape, packing, aspect)), dem.get((shape, packing, aspect))
            if run:
                ax.plot(run.result.series["time"], run.result.series["height"] / run.h0, color=COLOUR[shape],
                        label=f"SPH {shape}")
            if other:
                h = other["height/surface"]
                ax.plot(other["time"], h / h[0], "--", color=COLOUR[shape], label=f"DEM {shape}")
        scale = np.sqrt(aspect * 0.05 / 9.81)
        for phase in (1, 3):
            ax.axvline(phase * scale, color="0.85", lw=1)
        ax.set_xlim(0, 8 * scale)
        ax.set_title(f"$a$ = {aspect:g}, {packing}; lines: 1 and 3 $\\sqrt{{h_0/g}}$", fontsize=9)
        ax.set_xlabel("time $t$ / s")
    axes[0].set_ylabel("height $h/h_0$")
    axes[0].set_ylim(0, 1.08)
    lines = {l.get_label(): l for ax in axes for l in ax.get_lines() if not l.get_label().startswith("_")}
    axes[0].legend(lines.values(), lines.keys(), fontsize=8, loc="lower left")
    return fig


def field(ax, run, limit):
    """Final displacement of one run, the undisturbed zone outlined."""
    spacing = MM * run.result.scene_value("scene", "spacing")
    position, u = MM * run.result.final["position"], MM * run.result.displacement()
    discs = particles(ax, position, u, spacing, "viridis", 0, limit)
    level = MM * 0.5 * run.grain
    if u.min() < level < u.max():
        level_line(ax, position, u, level, 3 * spacing)
    return discs


def all_fields(runs):
    """Fig. 10: final displacement of every column."""
    series = [(s, p) for s in SHAPES for p in PACKINGS]
    fig, axes = plt.subplots(len(series), 4, figsize=(14, 2.0 * len(series)), squeeze=False, layout="constrained")
    for row, (shape, packing) in zip(axes, series):
        for ax, aspect in zip(row, ASPECTS):
            run = runs.get((shape, packing, aspect))
            limit = 50 * aspect
            if run:
                discs = field(ax, run, limit)
                reach = MM * (run.r0 * (1 + run.runout))
                ax.set_xlim(0, 1.15 * reach)
                ax.set_ylim(0, 1.25 * MM * run.r0 * max(run.height, 0.3))
                fig.colorbar(discs, ax=ax, pad=0.01, aspect=12)
            ax.set_aspect("equal")
            ax.set_title(f"{shape} {packing} $a$ = {aspect:g}", fontsize=8)
            ax.tick_params(labelsize=7)
    fig.supxlabel("$r$ / mm; colour: displacement / mm; line: moved half a grain", fontsize=9)
    fig.supylabel("$z$ / mm", fontsize=9)
    return fig


def compared_fields(runs, dem, aspect=2.0, packing="dense"):
    """Fig. 4: final displacement by DEM (left of the axis) and SPH (right)."""
    shapes = [s for s in SHAPES if (s, packing, aspect) in runs]
    if not shapes:
        return None
    fig, axes = plt.subplots(len(shapes), 1, figsize=(9, 2.6 * len(shapes)), squeeze=False, layout="constrained")
    for ax, shape in zip(axes[:, 0], shapes):
        run, other = runs[shape, packing, aspect], dem.get((shape, packing, aspect))
        limit = 50 * aspect
        discs = field(ax, run, limit)
        top = 1.25 * MM * run.r0 * run.height
        if other:
            size = MM * 0.05 / 17
            z, r = np.indices(other["displacement/final_u"].shape)
            u = MM * other["displacement/final_u"]
            known = np.isfinite(u) & (u > 0)
            ax.pcolormesh(-size * np.arange(u.shape[1] + 1), size * np.arange(u.shape[0] + 1),
                          np.where(known, u, np.nan), cmap="viridis", vmin=0, vmax=limit)
        else:
            ax.text(0.25, 0.5, "no DEM yet", transform=ax.transAxes, ha="center", color=GREY)
        reach = 1.15 * MM * run.r0 * (1 + run.runout)
        ax.set_xlim(-reach, reach)
        ax.set_ylim(0, top)
        ax.set_aspect("equal")
        ax.set_title(f"{shape} {packing}, $a$ = {aspect:g}: DEM left, SPH right", fontsize=10)
        ax.set_ylabel("$z$ / mm")
        ax.xaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")
        fig.colorbar(discs, ax=ax, label="displacement / mm", pad=0.01)
    axes[-1, 0].set_xlabel("$r$ / mm")
    return fig


def summary_lines(rows):
    """What the comparison comes to, in sentences."""
    lines = []
    for name, label in (("height_error_%", "final height"), ("radius_error_%", "final radius"),
                        ("outline_distance_%", "area between the outlines, of the column's section")):
        errors = np.array([row[name] for row in rows if name in row])
        if errors.size:
            worst = max((row for row in rows if name in row), key=lambda row: abs(row[name]))
            lines.append(f"{label} against DEM, {errors.size} columns: mean {np.abs(errors).mean():.1f} %, largest "
                         f"{worst[name]:+.1f} % ({worst['shape']} {worst['packing']} a = {worst['a']:g}), mean with "
                         f"sign {errors.mean():+.1f} %")
    seconds = sum(row["seconds"] for row in rows)
    lines.append(f"{len(rows)} runs took {seconds / 60:.0f} minutes of one thread each, together")
    return lines


INTRO = """Axisymmetric SPH with SIMSAND, beside discrete elements of the same grains and the laws of Lube et al. (2004)
and Lajeunesse et al. (2004). Heights and runouts over the initial radius of 50 mm; the front is where the deposit is
one grain, 2.95 mm, high. Undisturbed: share of the mass that moved less than half a grain."""


def page_part(title, rows, pictures):
    images = "".join(embedded(path, caption) for path, caption in pictures)
    sentences = "".join(f"<li>{html.escape(line)}</li>" for line in summary_lines(rows))
    return f"<h2>{html.escape(title)}</h2><ul>{sentences}</ul>{images}{page_table(rows)}"


def draw(folder, name, runs, dem, laws):
    """The pictures of a set: (file, caption)."""
    made = []
    for picture, caption, fig in (
            ("deposits", "Final height and runout against the aspect ratio", deposits(runs, dem, laws)),
            ("outlines", "Outlines in time, a = 2, dense", outlines(runs, dem)),
            ("fields", "Final displacement, a = 2, dense", compared_fields(runs, dem)),
            ("heights", "Height in time, dense", heights(runs, dem)),
            ("all_fields", "Final displacement and undisturbed zone of all columns", all_fields(runs))):
        if fig is None:
            continue
        path = folder / f"{name}_{picture}.png"
        fig.savefig(path, dpi=130, bbox_inches="tight")
        plt.close(fig)
        made.append((path, caption))
    return made


def main():
    parser = argparse.ArgumentParser(description="Tables, pictures and page of the study of 24 columns.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="data folder of the project")
    arguments = parser.parse_args()
    dem, laws, body = read_dem(arguments.data), read_laws(arguments.data), ""
    for name, title in TITLES.items():
        runs = read_runs(arguments.folder / name)
        if not runs:
            continue
        rows = list(rows_of(runs, dem, laws))
        write_table(arguments.folder / f"{name}.csv", rows)
        body += page_part(title, rows, draw(arguments.folder, name, runs, dem, laws))
        print(title, *summary_lines(rows), sep="\n  ")
    if not body:
        sys.exit(f"{arguments.folder}: expected folders of runs such as table4/ss_dense_a1, found none complete")
    page = arguments.folder / "index.html"
    page.write_text(PAGE.format(title="The 24 columns of Jin, Lu and Yang", intro=INTRO, body=body), encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
