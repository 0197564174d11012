# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the study of the 24 columns, after Figs. 4 to 10 of Jin, Lu and Yang. Columns: dictionaries from
(shape, packing, aspect ratio) to runs or discrete elements."""
from figures.draw import level_line, particles, surface
from figures.style import AMBER, BLUE, GREEN, GREY, MM, ORANGE, SKY, plt, use
from figures.study_data import ASPECTS, PACKINGS, SHAPES, STILL, farthest
from figures.study_rows import HEIGHT_LAW, RADIUS_LAW, RUNOUT_LAW
import numpy as np

use(font_size=10, dpi=160)
COLOUR = dict(zip(SHAPES, (BLUE, ORANGE, GREEN)))
MARKER = {"dense": "o", "loose": "s"}
NAMES = {"table4": "SPH, Table 4", "dem": "SPH, calibrated", "literal": "SPH, literal", "dem_packing":
         "SPH, calibrated, DEM's void ratio", "drucker_prager": "SPH, Drucker-Prager"}
TIMES = (0.0, 0.06, 0.1, 0.14, 0.18, 0.24, 0.3)  # s, of outlines; the last is added
RING = 0.05 / 17  # m, cells of the fields of discrete elements


def aspect_axis(ax, label):
    ax.set_xscale("log")
    ax.set_xticks(ASPECTS, [f"{x:g}" for x in ASPECTS])
    ax.minorticks_off()
    ax.set_xlim(0.42, 4.8)
    ax.set_xlabel("aspect ratio $a = h_0/r_0$")
    ax.set_ylabel(label)
    ax.grid(color="0.92")


LAW_STYLES = {("Lube 2004", ""): ("-", "Lube et al. 2004"), ("Lajeunesse 2004", ""): ("--", "Lajeunesse et al. 2004"),
              ("Lajeunesse 2004", "first reading"): (":", "Lajeunesse et al., read as $(r_f - r_0)/r_0$"),
              ("Lajeunesse 2004", "second reading"): ("--", "Lajeunesse et al., read as $r_f/r_0$")}


def draw_laws(axes, laws):
    """Each piece of a law as a line of its own: where they do not meet, nothing is stated between."""
    for (source, quantity, reading), pieces in laws.items():
        panel = {HEIGHT_LAW: 0, RUNOUT_LAW: 1, RADIUS_LAW: 1}.get(quantity)
        if panel is None:
            continue
        style, name = LAW_STYLES[source, reading]
        for low, high, coefficient, exponent in pieces:
            a = np.geomspace(max(low, 0.4), min(high, 5), 100)
            values = coefficient * a**exponent - (quantity == RADIUS_LAW)
            axes[panel].plot(a, values, style, color=GREY, lw=1.1, label=name)


def draw_deposits(axes, columns):
    for shape in SHAPES:
        for packing in PACKINGS:
            points = [(k[2], v.top, v.runout) for k, v in sorted(columns.items()) if k[:2] == (shape, packing)]
            if points:
                x, heights, runouts = np.array(points).T
                for ax, y in zip(axes, (heights, runouts)):
                    ax.plot(x, y, MARKER[packing], color=COLOUR[shape], ms=6.5, ls="-" if packing == "dense" else ":",
                            lw=0.8, mfc=COLOUR[shape] if packing == "dense" else "white", mew=1.3,
                            label=f"{shape} {packing}")


def deposits(families, laws):
    """Figs. 8 and 9: final height and runout against the aspect ratio; a column of panels for each family of bodies,
    (title, columns)."""
    fig, axes = plt.subplots(2, len(families), figsize=(3.6 * len(families) + 2.4, 7), sharey="row", squeeze=False,
                             layout="constrained")
    for column, (title, bodies) in zip(axes.T, families):
        draw_laws(column, laws)
        draw_deposits(column, bodies)
        column[0].set_title(title, fontsize=10)
        for ax, label in zip(column, ("final height $h_f/r_0$", "runout $(r_f - r_0)/r_0$")):
            aspect_axis(ax, label if ax is axes[0, 0] or ax is axes[1, 0] else "")
    for ax in axes[:, 0]:  # after all families: a limit set ends the scaling
        ax.set_ylim(bottom=0)
    lines = {l.get_label(): l for ax in axes.flat for l in ax.get_lines()}
    axes[0, -1].legend(lines.values(), lines.keys(), loc="upper left", bbox_to_anchor=(1.02, 1.02), fontsize=8.5)
    return fig


def nearest(times, wanted):
    return sorted({int(np.abs(np.asarray(times) - t).argmin()) for t in wanted} | {len(times) - 1})


def absent(ax, x, text):
    ax.text(x, 0.5, text, transform=ax.transAxes, ha="center", va="center", color=GREY, fontsize=9)


def mirrored_axis(ax, reach, top):
    ax.set_aspect("equal")
    ax.set_xlim(-reach, reach)
    ax.set_ylim(0, top)
    ax.set_ylabel("$z$ / mm")
    ax.axvline(0, color="0.8", lw=0.8)
    ax.xaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")


def row_figure(count, reach, top):
    """Panels above each other, each with the proportions of a deposit."""
    panel = 8.2 * top / (2 * reach)
    return plt.subplots(count, 1, figsize=(9.8, count * (panel + 0.55) + 0.5), sharex=True, squeeze=False,
                        layout="constrained")


def outlines(runs, dem, aspect=2.0, packing="dense"):
    """Figs. 5 and 6: outlines in time, discrete elements left and SPH right of the axis."""
    shapes = [s for s in SHAPES if (s, packing, aspect) in runs]
    if not shapes:
        return None
    bodies = [runs[s, packing, aspect] for s in shapes] + [body for key, body in dem.items()
                                                          if key in [(s, packing, aspect) for s in shapes]]
    reach = 1.1 * MM * farthest(bodies)
    fig, axes = row_figure(len(shapes), reach, 55 * aspect)
    colours = plt.get_cmap("viridis_r")(np.linspace(0.1, 1, len(TIMES) + 1))
    for ax, shape in zip(axes[:, 0], shapes):
        run, other = runs[shape, packing, aspect], dem.get((shape, packing, aspect))
        snapshots = run.result.snapshots
        draw_outlines(ax, 1, [s.time for s in snapshots], run.result.radii, lambda n: snapshots[n]["outline"], colours)
        ends = f"SPH right (end {snapshots[-1].time:.2f} s)"
        if other:
            draw_outlines(ax, -1, other.time, other["outline/radius"], lambda n: other["outline/height"][n], colours)
            ends = f"DEM left (end {other.time[-1]:.2f} s), {ends}"
        else:
            absent(ax, 0.25, "no discrete elements of this column")
        mirrored_axis(ax, reach, 55 * aspect)
        ax.set_title(f"{shape} {packing}, $a$ = {aspect:g}: {ends}", fontsize=10)
    lines = {l.get_label(): l for l in axes[0, 0].get_lines() if not l.get_label().startswith("_")}
    axes[0, 0].legend(lines.values(), lines.keys(), title="time", loc="upper left", bbox_to_anchor=(1.01, 1.05), fontsize=8)
    axes[-1, 0].set_xlabel("$r$ / mm")
    return fig


def draw_outlines(ax, side, times, radii, outline, colours):
    """Outlines at TIMES and at the end, on one side of the axis."""
    for colour, n in zip(colours, nearest(times, TIMES)):
        r, z = surface(radii, outline(n))
        last = n == len(times) - 1
        ax.plot(side * r, z, color=colour, lw=1.9 if last else 1.1, label="end" if last else f"{times[n]:.2f} s")


def heights(runs, dem):
    """Fig. 7: height in time over initial height, a panel each packing and aspect ratio; the phases of the paper."""
    fig, axes = plt.subplots(2, 4, figsize=(13, 6), sharey=True, squeeze=False, layout="constrained")
    for row, packing in zip(axes, PACKINGS):
        for ax, aspect in zip(row, ASPECTS):
            scale = np.sqrt(aspect * 0.05 / 9.81)
            for shape in SHAPES:
                run, other = runs.get((shape, packing, aspect)), dem.get((shape, packing, aspect))
                if run:
                    ax.plot(run.time, run.heights / run.h0, color=COLOUR[shape], lw=1.5, label=f"SPH {shape}")
                if other:
                    ax.plot(other.time, other.heights / other.heights[0], "--", color=COLOUR[shape], lw=1.3,
                            label=f"DEM {shape}")
            for phase, label in ((0.05, "0.05 s"), (0.4, "0.40 s")):
                ax.axvline(phase, color="0.8", lw=1, zorder=0)
                if aspect == 2:
                    ax.text(phase, 1.065, label, fontsize=7, color=GREY, ha="center")
            ax.axvline(3 * scale, color="0.5", lw=0.9, ls=":", zorder=0)
            ax.set_xlim(0, 0.82)
            ax.set_ylim(0, 1.12)
            ax.set_title(f"$a$ = {aspect:g}, {packing}", fontsize=9.5)
    for ax in axes[1]:
        ax.set_xlabel("time $t$ / s")
    for ax in axes[:, 0]:
        ax.set_ylabel("height $h/h_0$")
    lines = {l.get_label(): l for ax in axes.flat for l in ax.get_lines() if not l.get_label().startswith("_")}
    axes[0, -1].legend(lines.values(), lines.keys(), loc="upper left", bbox_to_anchor=(1.02, 1.02), fontsize=8.5)
    return fig


def field(ax, run, limit, side=1):
    """Final displacement of a run; the line bounds the undisturbed zone."""
    spacing = MM * run.spacing
    position, u = MM * run.result.final["position"] * [side, 1], MM * run.result.displacement()
    discs = particles(ax, position, u, 1.15 * spacing, "viridis", 0, limit)
    discs.set_rasterized(True)
    level = MM * STILL * run.grain
    if u.min() < level < u.max():
        level_line(ax, position, u, level, 3 * spacing)
    return discs


def dem_field(ax, other, limit):
    """Final displacement by discrete elements, left of the axis, and the cells whose grains stayed in the mean."""
    u = MM * other["displacement/final_u"]
    u = np.where(np.isfinite(u) & (u > 0), u, np.nan)
    edges = [MM * RING * np.arange(n + 1) for n in u.shape]
    ax.pcolormesh(-edges[1], edges[0], u, cmap="viridis", vmin=0, vmax=limit, rasterized=True)
    middle = [0.5 * (e[1:] + e[:-1]) for e in edges]
    level = MM * STILL * 2.95e-3
    if np.nanmin(u) < level:
        filled = np.where(np.isfinite(u), u, limit)
        for colour, width in (("white", 3.2), (ORANGE, 1.8)):
            ax.contour(-middle[1], middle[0], filled, levels=[level], colors=colour, linewidths=width)


def all_fields(runs):
    """Fig. 10: final displacement of every column, equal scales in a column of panels."""
    series = [(s, p) for s in SHAPES for p in PACKINGS if any(k[:2] == (s, p) for k in runs)]
    aspects = [a for a in ASPECTS if any(k[2] == a for k in runs)]
    reach = [1.08 * MM * farthest(r for k, r in runs.items() if k[2] == a) for a in aspects]
    top = [1.12 * MM * max(r.r0 * r.height for k, r in runs.items() if k[2] == a) for a in aspects]
    width = 16.0
    panel = max(width * t / sum(reach) for t in top)
    fig, axes = plt.subplots(len(series), len(aspects), figsize=(width, len(series) * (panel + 0.35) + 1.3),
                             squeeze=False, width_ratios=reach, sharex="col", layout="constrained")
    for row, (shape, packing) in zip(axes, series):
        for n, (ax, aspect) in enumerate(zip(row, aspects)):
            run = runs.get((shape, packing, aspect))
            discs = field(ax, run, 50 * aspect) if run else None
            ax.set_xlim(0, reach[n])
            ax.set_ylim(0, top[n])
            ax.set_aspect("equal")
            ax.set_anchor("S")
            ax.set_title(f"{shape} {packing}, $a$ = {aspect:g}", fontsize=9)
            ax.tick_params(labelsize=8)
            if row is axes[-1] or np.array_equal(row, axes[-1]):
                ax.set_xlabel("$r$ / mm", fontsize=9)
                if discs:
                    bar = fig.colorbar(discs, ax=axes[:, n], location="bottom", pad=0.01, aspect=22, extend="max")
                    bar.set_label("displacement / mm", fontsize=9)
                    bar.ax.tick_params(labelsize=8)
        row[0].set_ylabel("$z$ / mm", fontsize=9)
    return fig


def compared_fields(runs, dem, aspect=2.0, packing="dense"):
    """Fig. 4: final displacement by discrete elements (left of the axis) and SPH (right)."""
    shapes = [s for s in SHAPES if (s, packing, aspect) in runs]
    if not shapes:
        return None
    pairs = [(runs[s, packing, aspect], dem.get((s, packing, aspect))) for s in shapes]
    bodies = [body for pair in pairs for body in pair if body]
    reach = 1.12 * MM * farthest(bodies)
    top = 1.15 * MM * max(body.r0 * body.height for body in bodies)
    fig, axes = row_figure(len(shapes), reach, top)
    for ax, (run, other) in zip(axes[:, 0], pairs):
        discs = field(ax, run, 50 * aspect)
        if other:
            dem_field(ax, other, 50 * aspect)
        else:
            absent(ax, 0.25, "no discrete elements of this column")
        mirrored_axis(ax, reach, top)
        ax.set_title(f"{run.shape} {packing}, $a$ = {aspect:g}: DEM left, SPH right", fontsize=10)
    bar = fig.colorbar(discs, ax=axes, pad=0.01, aspect=30, extend="max")
    bar.set_label("displacement / mm; line: half a grain")
    axes[-1, 0].set_xlabel("$r$ / mm")
    return fig


def errors(sets):
    """Errors against discrete elements, column by column: sets of (name, rows)."""
    cases = list(dict.fromkeys(f"{r['shape']} {r['packing']} {r['a']:g}" for _, rows in sets for r in rows
                               if "dem_height" in r))
    if not cases:
        return None
    fig, axes = plt.subplots(2, 1, figsize=(10, 5.4), sharex=True, layout="constrained")
    colours = dict(zip((name for name, _ in sets), (BLUE, ORANGE, GREEN, SKY, AMBER)))
    for number, (name, rows) in enumerate(sets):
        found = {f"{r['shape']} {r['packing']} {r['a']:g}": r for r in rows if "dem_height" in r}
        x = np.array([n for n, case in enumerate(cases) if case in found])
        for ax, of in zip(axes, ("height_error_%", "radius_error_%")):
            ax.bar(x + 0.8 * (number + 0.5) / len(sets) - 0.4, [found[cases[n]][of] for n in x], 0.8 / len(sets),
                   color=colours[name], label=name)
    for ax, label in zip(axes, ("$h_f$: SPH / DEM - 1, %", "$r_f$: SPH / DEM - 1, %")):
        for bound in (-15, 15):
            ax.axhline(bound, color="0.6", lw=0.8, ls="--")
        ax.axhline(0, color="black", lw=0.8)
        ax.set_ylabel(label)
        ax.grid(axis="y", color="0.92")
        ax.set_axisbelow(True)
    axes[1].set_xticks(range(len(cases)), cases, rotation=30, ha="right", fontsize=8.5)
    axes[0].legend(fontsize=8.5, loc="upper right", title="dashed: 15 %", title_fontsize=8)
    return fig


def cost(table):
    """Mean errors against processor time of one column, by set and spacing; beside the time of discrete elements."""
    rows = [row for row in table if "mean_height_error_%" in row and row["set"] in ("dem", "table4", "drucker_prager")]
    if not rows:
        return None
    fig, axes = plt.subplots(1, 2, figsize=(10, 4.2), sharex=True, layout="constrained")
    names = list(dict.fromkeys(row["set"] for row in rows))
    colours = dict(zip(names, (BLUE, ORANGE, GREEN, SKY, AMBER)))
    for ax, label in zip(axes, ("height", "radius")):
        for name in names:
            of_set = sorted((row for row in rows if row["set"] == name), key=lambda row: row["spacing_mm"])
            x = [row["median_cpu_s"] for row in of_set]
            y = [row[f"mean_{label}_error_%"] for row in of_set]
            ax.plot(x, y, "o-", color=colours[name], label=NAMES.get(name, name))
            for row, here, there in zip(of_set, x, y):
                ax.annotate(f"{row['spacing_mm']:g} mm", (here, there), fontsize=7.5, textcoords="offset points",
                            xytext=(4, 5))
        ax.axvline(rows[0]["median_dem_cpu_s"], color=GREY, ls="--", lw=1, label="cost of the discrete elements")
        ax.set_xscale("log")
        ax.set_ylim(bottom=0)
        ax.set_xlabel("processor time of a column, median / s")
        ax.set_ylabel(f"mean error of the final {label} / %")
        ax.grid(color="0.92")
    axes[0].legend(fontsize=8, loc="best")
    return fig
