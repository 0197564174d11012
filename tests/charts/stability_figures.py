#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the stability chart: stability_figures.py STABILITY.csv [-o FOLDER]

STABILITY.csv is written by `simsand-chart stability`.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "drivers"))
from figures.style import plt, use
from figures.table import read_rows
import numpy as np
from matplotlib.colors import ListedColormap

# What a run came to, with colours that stay apart for colour-blind readers (Okabe and Ito).
VERDICTS = {
    "holds": "#009E73",
    "restless": "#F0E442",
    "thrown": "#E69F00",
    "stopped: energy": "#CC79A7",
    "stopped: step": "#56B4E9",
    "stopped: strain": "#D55E00",
    "stopped: material": "#000000",
}
MEANING = {
    "holds": "holds",
    "restless": "still moves at the end (elastic: more than at the start)",
    "thrown": "particles thrown off",
    "stopped: energy": "stopped by the energy guard",
    "stopped: step": "stopped by the step guard",
    "stopped: strain": "stopped by the strain guard",
    "stopped: material": "stopped by the material",
}
WORDS = ("material", "geometry", "ended", "verdict")
RECOMMENDED = {"smoothing_length": 1.5, "viscosity": 1, "stress_diffusion": 5, "step_factor": 0.4}
use(font_size=8, dpi=120)


def values(rows, key):
    return sorted({r[key] for r in rows})


def where(rows, **wanted):
    return [r for r in rows if all(r[k] == v for k, v in wanted.items())]


def panel(ax, rows, steps, viscosities):
    codes = {v: k for k, v in enumerate(VERDICTS)}
    image = np.full((len(viscosities), len(steps)), np.nan)
    for r in rows:
        image[viscosities.index(r["viscosity"]), steps.index(r["step_factor"])] = codes[r["verdict"]]
    ax.imshow(image, origin="lower", aspect="auto", cmap=ListedColormap(VERDICTS.values()), vmin=-0.5,
              vmax=len(VERDICTS) - 0.5)
    ax.set_xticks(range(len(steps)), [f"{s:g}" for s in steps])
    ax.set_yticks(range(len(viscosities)), [f"{v:g}" for v in viscosities])
    ax.tick_params(length=0)
    ax.set_xticks(np.arange(len(steps) - 1) + 0.5, minor=True)
    ax.set_yticks(np.arange(len(viscosities) - 1) + 0.5, minor=True)
    ax.grid(which="minor", color="white", lw=0.8)
    if rows and all(rows[0][k] == RECOMMENDED[k] for k in ("smoothing_length", "stress_diffusion")):
        x, y = steps.index(RECOMMENDED["step_factor"]), viscosities.index(RECOMMENDED["viscosity"])
        ax.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, fill=False, ec="black", lw=2))


def draw_map(rows, material, folder):
    mine = where(rows, material=material)
    steps, viscosities = values(mine, "step_factor"), values(mine, "viscosity")
    lengths, diffusions = values(mine, "smoothing_length"), values(mine, "stress_diffusion")
    lines = [(g, n) for g in ("plane_strain", "axisymmetric") for n in values(mine, "particles_per_radius")]
    columns = [(h, d) for h in lengths for d in diffusions]
    fig, axes = plt.subplots(len(lines), len(columns), figsize=(2 + 1.55 * len(columns), 1.6 + 1.05 * len(lines)),
                             squeeze=False, sharex=True, sharey=True)
    for (geometry, n), line in zip(lines, axes):
        for (h, d), ax in zip(columns, line):
            panel(ax, where(mine, geometry=geometry, particles_per_radius=n, smoothing_length=h, stress_diffusion=d),
                  steps, viscosities)
            if (geometry, n) == lines[0]:
                ax.set_title(f"h = {h:g} dx\ndiffusion {d:g}", fontsize=8)
        line[0].set_ylabel(f"{geometry.replace('_', ' ')}\nr$_0$/{n:g}\n\nviscosity", fontsize=8)
    for ax in axes[-1]:
        ax.set_xlabel("step factor")
    handles = [plt.Rectangle((0, 0), 1, 1, color=VERDICTS[v], label=MEANING[v]) for v in VERDICTS
               if any(r["verdict"] == v for r in mine)]
    handles.append(plt.Rectangle((0, 0), 1, 1, fill=False, ec="black", lw=2, label="recommended"))
    fig.legend(handles=handles, loc="lower center", ncols=len(handles))
    name = {"simsand": "SIMSAND, a dense column that collapses", "elastic": "elastic column, set free at its side"}
    fig.suptitle(name[material], fontsize=10)
    fig.tight_layout(rect=(0, 0.045, 1, 1))
    fig.savefig(folder / f"stability_{material}.png")


def draw_quality(rows, folder):
    """What the settings that hold do to the deposit and to the noise of stress; at the recommended step."""
    mine = [r for r in rows if r["material"] == "simsand" and r["step_factor"] == 0.4]
    viscosities, diffusions = values(mine, "viscosity"), values(mine, "stress_diffusion")
    quantities = [("noise", "checkerboard index while falling"), ("height", "height / r$_0$"),
                  ("front", "front radius / r$_0$")]
    fig, axes = plt.subplots(2, 3, figsize=(10, 5.6), sharex=True)
    colours = dict(zip(values(mine, "smoothing_length"), ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000")))
    dashes = dict(zip(diffusions, (":", "-", "--")))
    finest = max(values(mine, "particles_per_radius"))
    for geometry, line in zip(("plane_strain", "axisymmetric"), axes):
        for (key, label), ax in zip(quantities, line):
            for h, colour in colours.items():
                for d in diffusions:
                    part = {r["viscosity"]: r for r in where(mine, geometry=geometry, smoothing_length=h,
                                                             stress_diffusion=d, particles_per_radius=finest)}
                    y = [part[v][key] if v in part and part[v]["ended"] == "end" else np.nan for v in viscosities]
                    ax.plot(range(len(viscosities)), y, dashes[d], color=colour, marker="o", ms=3, lw=1)
                    for x, v in enumerate(viscosities):
                        if v in part and part[v]["ended"] == "end" and part[v]["verdict"] != "holds":
                            ax.plot(x, y[x], "x", color="red", ms=7)
            held = [r[key] for r in where(mine, geometry=geometry, particles_per_radius=finest, verdict="holds")]
            margin = 0.3 * (max(held) - min(held))
            ax.set_ylim(min(held) - margin, max(held) + margin)  # what fails may be anywhere
            ax.set_ylabel(label)
            ax.set_xticks(range(len(viscosities)), [f"{v:g}" for v in viscosities])
            ax.grid(True, color="#dddddd", lw=0.5)
        line[0].set_title(geometry.replace("_", " "), loc="left", fontsize=9)
    for ax in axes[-1]:
        ax.set_xlabel("viscosity over the recommended one")
    handles = [plt.Line2D([], [], color=c, marker="o", ms=3, label=f"h = {h:g} dx") for h, c in colours.items()]
    handles += [plt.Line2D([], [], color="grey", ls=dashes[d], label=f"diffusion {d:g}") for d in diffusions]
    handles.append(plt.Line2D([], [], color="red", marker="x", lw=0, label="does not hold"))
    fig.legend(handles=handles, loc="lower center", ncols=len(handles))
    fig.tight_layout(rect=(0, 0.06, 1, 1))
    fig.savefig(folder / "stability_quality.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder; default: that of the table")
    options = parser.parse_args()
    folder = options.output or options.csv.parent
    folder.mkdir(parents=True, exist_ok=True)
    rows = read_rows(options.csv, WORDS)
    for material in values(rows, "material"):
        draw_map(rows, material, folder)
    draw_quality(rows, folder)


if __name__ == "__main__":
    main()
