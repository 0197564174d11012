#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table, pictures and page of `simsand study causes`: columns where SPH and DEM differ, one thing changed at a time.

    study_causes.py FOLDER --data DATA      FOLDER/COLUMN/CHANGE/result.h5 -> FOLDER/causes.csv, *.png, index.html"""
import argparse
import html
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.draw import surface
from figures.result import Result
from figures.style import BLUE, GREEN, GREY, MM, ORANGE, PURPLE, SKY, plt, use
from figures.study_data import deviation, mean_top, read_dem
from figures.study_page import PAGE, bullets, embedded, page_table, save
from figures.table import read_rows, write_rows
import numpy as np

use(font_size=10, dpi=160)
TRIAXIAL_WORDS = ("case", "shape", "packing", "variables")  # columns that are no numbers
PARAMETERS = ("friction", "dilatancy", "interlocking", "packing")
BOUNDARY = ("floor", "rest", "glue")
SCHEME = ("flowviscosity", "smoothing", "diffusion", "step", "spacing", "dimension")
VARIANTS = {"-var local_damping 0.1": "local damping 0.1", "-var local_damping 0.7": "local damping 0.7"}


class Change:
    """One run: its numbers, its outline."""

    def __init__(self, folder):
        self.name = folder.name
        self.family, _, self.value = folder.name.partition("_")
        self.result = Result(folder / "result.h5")
        summary = self.result.file["summary"]
        self.runout, self.rest = (float(summary[name][()]) for name in ("runout", "time_to_rest"))
        material = self.result.scene["material"]
        self.friction, self.r0 = material["phi"], self.result.scene["column"]["radius"]
        self.height = self.top = mean_top(self.result, self.r0)


def read_changes(folder):
    """Column -> name -> change; complete runs only."""
    columns = {}
    for path in sorted(folder.glob("*_a*/*/result.h5")):
        try:
            change = Change(path.parent)
        except (OSError, ValueError, KeyError):  # being written
            continue
        if change.result.complete:
            columns.setdefault(path.parts[-3], {})[change.name] = change
    return {name: changes for name, changes in columns.items() if "base" in changes}


def key_of(column):
    shape, packing, aspect = column.split("_")
    return shape.upper(), packing, float(aspect[1:])


def reference_of(change, changes):
    return changes["dimension_2"] if change.name == "dimension_3" and "dimension_2" in changes else changes["base"]


def row_of(column, change, changes, other):
    base = reference_of(change, changes)
    height, radius = deviation(change, other)
    return {"column": column, "change": change.name, "height": change.height, "runout": change.runout,
            "time_to_rest_s": change.rest, "height_change_%": 100 * (change.height / base.height - 1),
            "radius_change_%": 100 * ((1 + change.runout) / (1 + base.runout) - 1),
            "height_error_%": 100 * height, "radius_error_%": 100 * radius}


def triaxial_angles(data, shape):
    """Critical friction angles of the triaxial tests of the main set, degrees."""
    rows = read_rows(pathlib.Path(data) / "dem/results/triaxial.csv", TRIAXIAL_WORDS)
    return np.array([row["critical_angle_deg"] for row in rows
                     if row["shape"] == shape and row["variables"] == "none"])


def matching_angle(changes, other):
    """Friction angle at which the final height is that of discrete elements, and the radius there; None beyond."""
    runs = sorted([changes["base"], *(c for c in changes.values() if c.family == "friction")],
                  key=lambda c: c.friction)
    heights, angles = np.array([c.height for c in runs]), np.array([c.friction for c in runs])
    if not heights.min() < other.height < heights.max() or not (np.diff(heights) > 0).all():
        return None
    return np.interp(other.height, heights, angles), np.interp(other.height, heights, [1 + c.runout for c in runs])


def parameter_lines(column, changes, other, data):
    lines, angles = [], triaxial_angles(data, key_of(column)[0])
    base = changes["base"]
    if found := matching_angle(changes, other):
        angle, radius = found
        lines.append(f"{column}: DEM's height needs a friction angle of {angle:.1f} degrees; {angles.size} triaxial tests of the same grains "
                     f"give {angles.mean():.1f} with a standard deviation of {angles.std(ddof=1):.1f}, so it is "
                     f"{abs(angles.mean() - angle) / angles.std(ddof=1):.1f} deviations off. The radius would then be off by "
                     f"{100 * (radius / (1 + other.runout) - 1):+.1f} % (with the calibrated angle "
                     f"{100 * ((1 + base.runout) / (1 + other.runout) - 1):+.1f} %)")
    others = [c for c in changes.values() if c.family in PARAMETERS and c.family != "friction"]
    if others:
        effects = ", ".join(f"{c.name.replace('_', ' ')}: {100 * (c.height / base.height - 1):+.0f} %" for c in others)
        lines.append(f"{column}: other parameters change the height by: {effects}; DEM's height asks for "
                     f"{100 * (other.height / base.height - 1):+.0f} %")
    return lines


def boundary_lines(column, changes, other):
    base = changes["base"]
    lines = []
    for change in (c for c in changes.values() if c.family in ("floor", "rest")):
        radius = 100 * ((1 + change.runout) / (1 + other.runout) - 1)
        far = f"radius {radius:+.0f} %" if np.isfinite(radius) else "radius not found: it leaves the sampled radii"
        lines.append(f"{column}: {change.name.replace('_', ' ')}: height {100 * (change.height / other.height - 1):+.0f} %, {far} from DEM "
                     f"(base {100 * (base.height / other.height - 1):+.0f} and "
                     f"{100 * ((1 + base.runout) / (1 + other.runout) - 1):+.0f} %)")
    return lines


def model_lines(column, changes, other, variants):
    """What discrete elements do that a rate-independent continuum does not."""
    base = changes["base"]
    at_rest = np.interp(base.rest, other.time, other.heights) / other.r0
    front = np.interp(base.rest, other.time, other.fronts) / other.r0
    lines = [f"{column}: SPH rests after {base.rest:.2f} s at {base.height:.3f}. DEM then stands at {at_rest:.3f} (SPH "
             f"{100 * (base.height / at_rest - 1):+.0f} %), radius {front:.2f} (SPH "
             f"{100 * ((1 + base.runout) / front - 1):+.0f} %); it goes on to {other.height:.3f} and {1 + other.runout:.2f} at "
             f"{other.time[-1]:.1f} s"]
    kinetic, rotational, potential = (other[f"energy/{name}"] for name in ("kinetic", "rotational", "potential"))
    lines.append(f"{column}: at its end DEM holds {100 * (kinetic[-1] + rotational[-1]) / potential[0]:.1f} % of the first "
                 f"potential energy as motion, {100 * rotational[-1] / (kinetic[-1] + rotational[-1]):.0f} % of that as rotation")
    for label, variant in variants.items():
        height, radius = deviation(base, variant)
        lines.append(f"{column}: DEM with {label} in place of 0, all else equal, ends at {variant.height:.3f} and radius "
                     f"{1 + variant.runout:.2f}; SPH is {100 * height:+.1f} and {100 * radius:+.1f} % from it")
    tops = (other.heights[0] - other.h0) / other.r0
    lines.append(f"{column}: the grain tops that are DEM's height stand {tops:+.3f} r0 above the nominal height before anything moves; less "
                 f"this, SPH is {100 * (base.height / (other.height - tops) - 1):+.1f} % from DEM in place of "
                 f"{100 * (base.height / other.height - 1):+.1f} %")
    slope = np.degrees(np.arctan2(other.height, 1 + other.runout))
    lines.append(f"{column}: the cone from DEM's top to its front has {slope:.1f} degrees, that of SPH "
                 f"{np.degrees(np.arctan2(base.height, 1 + base.runout)):.1f}")
    return lines


def scheme_lines(column, changes, other):
    base = changes["base"]
    some = [c for c in changes.values() if c.family in SCHEME and c.name != "dimension_2"]
    if not some:
        return []
    effects = [(100 * (c.height / reference_of(c, changes).height - 1),
                100 * ((1 + c.runout) / (1 + reference_of(c, changes).runout) - 1), c.name) for c in some]
    height, radius = max(effects, key=lambda e: abs(e[0])), max(effects, key=lambda e: abs(e[1]))
    lines = [f"{column}: of {len(some)} changes of the scheme the largest effect on the height is {height[0]:+.1f} % ({height[2]}), on "
             f"the radius {radius[1]:+.1f} % ({radius[2]}); the errors are {100 * (base.height / other.height - 1):+.0f} % and "
             f"{100 * ((1 + base.runout) / (1 + other.runout) - 1):+.1f} %"]
    for c in sorted((c for c in some if c.family in ("spacing", "dimension")), key=lambda c: c.name):
        lines.append(f"{column}: {c.name}: height {c.height:.3f}, runout {c.runout:.3f} (compared with "
                     f"{reference_of(c, changes).name}: {reference_of(c, changes).height:.3f}, "
                     f"{reference_of(c, changes).runout:.3f})")
    return lines


def effects_figure(rows):
    """Effect of each change on height and radius, columns side by side; the error to be explained as a line."""
    names = list(dict.fromkeys(r["change"] for f in (*PARAMETERS, *BOUNDARY, *SCHEME) for r in rows
                               if r["change"].split("_")[0] == f and r["change"] != "dimension_2"))
    names.sort(key=lambda name: (name.startswith("friction"), float(name[9:]) if name.startswith("friction") else 0),
               reverse=True)
    columns = list(dict.fromkeys(row["column"] for row in rows))
    colours = dict(zip(columns, (BLUE, ORANGE, GREEN, PURPLE)))
    fig, axes = plt.subplots(1, 2, figsize=(11, 0.4 * len(names) + 1.2), sharey=True, layout="constrained")
    for ax, of, error in zip(axes, ("height_change_%", "radius_change_%"), ("height_error_%", "radius_error_%")):
        for n, column in enumerate(columns):
            found = {row["change"]: row for row in rows if row["column"] == column}
            y = [k for k, name in enumerate(names) if name in found]
            ax.barh(np.array(y) + 0.8 * (n + 0.5) / len(columns) - 0.4, [found[names[k]][of] for k in y],
                    0.8 / len(columns), color=colours[column], label=column.replace("_", " "))
            base = found["base"][error]
            ax.axvline(100 * (1 / (1 + base / 100) - 1), color=colours[column], ls="--", lw=1.2)
        ax.axvline(0, color="black", lw=0.8)
        ax.set_xlim(-60, 60)
        ax.set_xlabel(f"change of the final {of.split('_')[0]} / %; dashed: what would match DEM")
        ax.grid(axis="x", color="0.92")
        ax.set_axisbelow(True)
    axes[0].set_yticks(range(len(names)), [name.replace("_", " ") for name in names], fontsize=8.5)
    axes[0].invert_yaxis()
    axes[1].legend(fontsize=8.5, loc="lower right")
    return fig


def outlines_figure(columns, dem, variants):
    fig, axes = plt.subplots(len(columns), 1, figsize=(9.5, 2.3 * len(columns)), squeeze=False, layout="constrained")
    for ax, (column, changes) in zip(axes[:, 0], columns.items()):
        other, base = dem[key_of(column)], changes["base"]
        then = int(np.abs(other.time - base.rest).argmin())
        ax.plot(*surface(other["outline/radius"], other["outline/height"][-1]), color="black", lw=2,
                label=f"DEM at {other.time[-1]:.2f} s")
        ax.plot(*surface(other["outline/radius"], other["outline/height"][then]), "--", color="black", lw=1.3,
                label=f"DEM when SPH rests, {other.time[then]:.2f} s")
        for colour, (label, variant) in zip((GREEN, SKY), variants.get(column, {}).items()):
            ax.plot(*surface(variant["outline/radius"], variant["outline/height"][-1]), color=colour, lw=1.5,
                    label=f"DEM, {label}")
        ax.plot(*surface(base.result.radii, base.result.final["outline"]), color=ORANGE, lw=2, label="SPH, calibrated")
        for name, colour, label in (("friction_8", PURPLE, "SPH, 8 degrees"), ("floor_0.2", BLUE, "SPH, floor 0.2"),
                                    ("friction_34", PURPLE, "SPH, 34 degrees")):
            if name in changes:
                ax.plot(*surface(changes[name].result.radii, changes[name].result.final["outline"]), "-.", color=colour,
                        lw=1.4, label=label)
        ax.set_aspect("equal")
        ax.set_xlim(0, 175)
        ax.set_ylim(0, 1.1 * max(line.get_ydata().max() for line in ax.get_lines()))
        ax.set_ylabel("$z$ / mm")
        ax.set_title("{} {}, $a$ = {:g}".format(*key_of(column)), fontsize=10)
        ax.legend(fontsize=8, loc="upper right")
    axes[-1, 0].set_xlabel("$r$ / mm")
    return fig


INTRO = """Columns where SPH with the calibrated parameters and discrete elements (DEM) of the same grains differ most. One thing is
changed at a time: parameters of the material, the floor, the stress at rest and the smallest stress, the scheme; and, among the discrete
elements, time and damping. What would have to change by more than the tests allow is not to blame."""


def main():
    parser = argparse.ArgumentParser(description="Table, pictures and page of the study of causes.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="data folder of the project")
    arguments = parser.parse_args()
    dem = read_dem(arguments.data)
    columns = {name: changes for name, changes in read_changes(arguments.folder).items() if key_of(name) in dem}
    if not columns:
        sys.exit(f"{arguments.folder}: expected runs such as ss_dense_a0.5/base with DEM beside them, found none complete")
    varied = {label: read_dem(arguments.data, variables) for variables, label in VARIANTS.items()}
    variants = {name: {label: found[key_of(name)] for label, found in varied.items() if key_of(name) in found}
                for name in columns}
    rows = [row_of(name, change, changes, dem[key_of(name)]) for name, changes in columns.items()
            for change in changes.values()]
    write_rows(arguments.folder / "causes.csv", rows)
    parts = {"Parameters": lambda n, c, d: parameter_lines(n, c, d, arguments.data), "Boundary": boundary_lines,
             "Model": lambda n, c, d: model_lines(n, c, d, variants[n]), "Scheme": scheme_lines}
    body = ""
    for title, lines in parts.items():
        sentences = [line for name, changes in columns.items() for line in lines(name, changes, dem[key_of(name)])]
        body += f"<h2>{html.escape(title)}</h2>" + bullets(sentences)
        print(title, *sentences, sep="\n  ")
    for name, caption, fig in (
            ("outlines", "Final outlines", outlines_figure(columns, dem, variants)),
            ("effects", "Effect of each change", effects_figure(rows))):
        save(fig, arguments.folder / f"causes_{name}.png")
        body += embedded(arguments.folder / f"causes_{name}.png", caption)
    page = arguments.folder / "index.html"
    page.write_text(PAGE.format(title="Why SPH and discrete elements differ", intro=INTRO,
                                body=body + page_table(rows)), encoding="utf-8")
    print(page)


if __name__ == "__main__":
    main()
