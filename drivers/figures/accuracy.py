#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of `simsand-chart accuracy`.

    accuracy.py FOLDER --data DATA      FOLDER/runs.csv, points.csv -> FOLDER/accuracy_*.png
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.style import plt, use
from figures.table import read_rows
import numpy as np

WORDS = ("geometry", "material", "precision", "kernel", "column")
USUAL = {"geometry": "axisymmetric", "material": "simsand", "precision": "double", "stiffness_scale": 1.0,
         "step_factor": 0.4, "kernel": "wendland-c2", "smoothing_length": 1.5}
# Okabe and Ito: apart for colour-blind readers.
STYLE = {"SIMSAND, axisymmetric": ("#000000", "o"), "stiffness scale 0.3": ("#56B4E9", "v"),
         "stiffness scale 0.1": ("#0072B2", "v"), "stiffness scale 0.03": ("#CC79A7", "v"),
         "Drucker-Prager": ("#D55E00", "s"), "single precision": ("#009E73", "P"),
         "step factor 0.2": ("#E69F00", "<"), "step factor 0.8": ("#E69F00", ">"),
         "smoothing length 1.3": ("#009E73", "<"), "smoothing length 1.8": ("#009E73", ">"),
         "Wendland C4": ("#E69F00", "h"), "Wendland C4, length 1.8": ("#CC79A7", "h"),
         "quarter, 3-D": ("#D55E00", "D"), "half, 3-D": ("#D55E00", "p"), "full, 3-D": ("#D55E00", "*"), "calibrated on DEM": ("#0072B2", "X")}
use(font_size=9, dpi=130)


def kind(row):
    """Name of what departs from the default."""
    if row["geometry"] in ("quarter", "half", "full"):
        return f"{row['geometry']}, 3-D"
    if row["material"] != "simsand":
        return {"drucker_prager": "Drucker-Prager", "calibrated": "calibrated on DEM"}[row["material"]]
    if row["precision"] == "single":
        return "single precision"
    if row["kernel"] == "wendland-c4":
        return "Wendland C4" + (f", length {row['smoothing_length']:g}" if row["smoothing_length"] != 1.5 else "")
    for key in ("stiffness_scale", "step_factor", "smoothing_length"):
        if row[key] != USUAL[key]:
            return f"{key.replace('_', ' ')} {row[key]:g}"
    return "SIMSAND, axisymmetric"


def front_of(points, error):
    """Points that no other beats in both cost and error, by cost."""
    front, least = [], np.inf
    for p in sorted(points, key=lambda p: (p["seconds"], p[error])):
        if p[error] < least:
            front.append(p)
            least = p[error]
    return front


def panel(ax, points, error, label, finest):
    """Cost against error; the front in colour, what is dominated in grey, what was run on fewer columns hollow."""
    shown = [p for p in points if np.isfinite(p[error]) and p["failures"] == 0 and
             (finest is None or p["resolution"] < finest)]
    most = max(p["columns"] for p in shown)
    front = front_of([p for p in shown if p["columns"] == most], error)
    for p in shown:
        colour, marker = STYLE[kind(p)]
        on, fewer = p in front, p["columns"] < most
        ax.plot(p["seconds"], 100 * p[error], marker, color=colour if on or fewer else "0.75", ms=7 if on else 5,
                mfc=colour if on else "none", zorder=3 if on else 2)
        if fewer:
            ax.annotate(f"{p['resolution']:g}", (p["seconds"], 100 * p[error]), xytext=(4, -8),
                        textcoords="offset points", fontsize=6, color=colour)
    ax.step([p["seconds"] for p in front], [100 * p[error] for p in front], where="post", color="0.4", lw=1, zorder=1)
    for p in front:
        ax.annotate(f"{p['resolution']:g}", (p["seconds"], 100 * p[error]), xytext=(5, 5), textcoords="offset points",
                    fontsize=7)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("processor time of a run / s")
    ax.set_ylabel(label)
    ax.grid(True, which="both", color="0.93", lw=0.5)
    ax.yaxis.set_major_formatter(lambda y, _: f"{y:g}")
    ax.yaxis.set_minor_formatter(lambda y, _: f"{y:g}" if str(f"{y:.1e}")[0] in "235" else "")
    return {kind(p) for p in shown}


def legend(fig, kinds):
    handles = [plt.Line2D([], [], marker=STYLE[k][1], color=STYLE[k][0], ls="none", label=k) for k in STYLE if k in kinds]
    handles += [plt.Line2D([], [], marker="o", mfc="none", color="0.75", ls="none", label="dominated (any)"),
                plt.Line2D([], [], marker="D", mfc="none", color="#D55E00", ls="none", ms=5,
                           label="fewer columns (hollow)"),
                plt.Line2D([], [], color="0.4", lw=1, label="Pareto front")]
    fig.legend(handles=handles, loc="lower center", ncols=6, fontsize=8)


def fronts(points, folder):
    round_ones = [p for p in points if p["geometry"] != "plane_strain" and p["material"] != "calibrated"]
    finest = max(p["resolution"] for p in round_ones)
    fig, axes = plt.subplots(1, 3, figsize=(12.5, 4.8))
    kinds = set()
    for ax, (error, label) in zip(axes, (("height_error", "error of $h_f$ / %, worst column"),
                                         ("radius_error", "error of $r_f$ / %, worst column"),
                                         ("outline_error", "area between outlines / $r_0 h_0$, %"))):
        kinds |= panel(ax, round_ones, error, label, finest)
    axes[0].set_title(f"against the finest runs, {finest:g} particles a side; numbers: particles a side", fontsize=9, loc="left")
    legend(fig, kinds)
    fig.tight_layout(rect=(0, 0.1, 1, 1))
    fig.savefig(folder / "accuracy_finest.png")


def against_dem(points, folder):
    round_ones = [p for p in points if p["geometry"] != "plane_strain" and np.isfinite(p["dem_height_error"])]
    if not round_ones:
        return
    fig, axes = plt.subplots(1, 3, figsize=(12.5, 4.8))
    kinds = set()
    for ax, (error, label) in zip(axes, (("dem_height_error", "error of $h_f$ / %"), ("dem_radius_error", "error of $r_f$ / %"),
                                         ("dem_outline_error", "area between outlines / $r_0 h_0$, %"))):
        kinds |= panel(ax, round_ones, error, label, None)
    axes[0].set_title("against discrete elements, mean of the columns that have them", fontsize=9, loc="left")
    legend(fig, kinds)
    fig.tight_layout(rect=(0, 0.1, 1, 1))
    fig.savefig(folder / "accuracy_dem.png")


def scatter(rows, folder):
    """Every run of the default configuration, column by column: bias and scatter."""
    usual = [r for r in rows if r["failed"] == 0 and all(r[k] == v for k, v in USUAL.items() if k != "geometry")
             and r["geometry"] in ("axisymmetric", "plane_strain")]
    columns = sorted({r["column"] for r in usual})
    fig, axes = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    for ax, quantity, label in zip(axes, ("height", "radius"), ("h_f", "r_f")):
        for column, (colour, marker) in zip(columns, STYLE.values()):
            mine = [r for r in usual if r["column"] == column]
            finest = max(r["resolution"] for r in mine)
            reference = np.mean([r[quantity] for r in mine if r["resolution"] == finest])
            levels = sorted({r["resolution"] for r in mine})
            values = [[100 * (r[quantity] / reference - 1) for r in mine if r["resolution"] == n] for n in levels]
            colour = colour if colour != "#000000" else "0.2"
            ax.plot(levels, [np.mean(v) for v in values], "-", color=colour, lw=1, label=column)
            for n, v in zip(levels, values):
                ax.plot([n] * len(v), v, marker, color=colour, ms=4, mfc="none")
        ax.axhline(0, color="0.6", lw=0.8)
        ax.set_xscale("log")
        every = sorted({r["resolution"] for r in usual})
        ax.set_xticks(every, [f"{n:g}" for n in every])
        ax.minorticks_off()
        ax.set_xlabel("particles a side, $\\sqrt{r_0 h_0}$ / spacing")
        ax.set_ylabel(f"error of ${label}$ / %")
        ax.grid(color="0.93")
    axes[0].legend(fontsize=8)
    axes[0].set_title("single runs (marks) and their means (lines), default configuration", fontsize=9, loc="left")
    fig.savefig(folder / "accuracy_scatter.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, help="data folder of the project; not used")
    arguments = parser.parse_args()
    points = read_rows(arguments.folder / "points.csv", WORDS)
    fronts(points, arguments.folder)
    against_dem(points, arguments.folder)
    scatter(read_rows(arguments.folder / "runs.csv", WORDS), arguments.folder)
    print(*sorted(arguments.folder.glob("accuracy_*.png")), sep="\n")


if __name__ == "__main__":
    main()
