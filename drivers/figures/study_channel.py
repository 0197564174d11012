#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table, picture and page of `simsand study channel`: final surfaces and failure lines, SIMSAND and Drucker-Prager.

    study_channel.py FOLDER --data DATA      FOLDER/RUN/result.h5 -> FOLDER/channel.csv, *.png, index.html"""
import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from figures import GREY, MM, particles, surface
from result import Result
from study_data import law_value, read_laws
from study_page import PAGE, embedded, page_table, write_table

MOVED = 0.002  # m: one rod; the failure line bounds what moved farther
STYLES = {"simsand": ("viridis", "-"), "drucker": ("autumn", "--")}


def failure_line(run):
    """Lower envelope, over the initial columns of particles, of what moved more than a rod: x, z in the deposit."""
    position, still = run.final["position"], run.displacement() <= MOVED
    start = run.initial_position
    x, z = [], []
    for column in np.unique(np.round(start[:, 0], 6)):
        here = np.abs(start[:, 0] - column) < 1e-6
        if (here & still).any() and not (here & still).all():
            top = np.argmax(np.where(here & still, start[:, 1], -1))
            x.append(position[top, 0])
            z.append(position[top, 1])
    return np.array(x), np.array(z)


def row_of(name, run, laws):
    summary = {key: float(value[()]) for key, value in run.file["summary"].items()}
    kinetic, potential = run.series["kinetic_energy"], run.series["potential_energy"]
    column = run.scene["column"]
    aspect = column["height"] / column["radius"]
    masses = run.file["particles/mass"][()]
    return {"run": name, "height_over_l0": summary["final_height"], "runout_over_l0": summary["runout"],
            "toe_m": column["radius"] * (1 + summary["runout"]), "time_to_rest_s": summary["time_to_rest"],
            "undisturbed": masses[run.displacement() <= MOVED].sum() / masses.sum(),
            "final_over_initial_energy": (kinetic[-1] + potential[-1]) / (kinetic[0] + potential[0]),
            "energy_imbalance": summary["energy_imbalance"],
            "Lube 2005 runout": law_value(laws, aspect), "seconds": summary["wall_clock"],
            "rate": summary["rate"]}


def lines_figure(runs):
    fig, ax = plt.subplots(figsize=(10, 4), layout="constrained")
    families = {family: [n for n in runs if n.startswith(family)] for family in STYLES}
    for family, names in families.items():
        colours = plt.get_cmap(STYLES[family][0])(np.linspace(0.1, 0.85, max(len(names), 1)))
        for name, colour in zip(names, colours):
            run = runs[name]
            x, z = surface(run.radii, run.final["outline"])
            ax.plot(x, z, STYLES[family][1], color=colour, lw=1.8, label=name.replace("_", " "))
            ax.plot(*(MM * np.array(failure_line(run))), STYLES[family][1], color=colour, lw=0.9)
    any_run = next(iter(runs.values()))
    length, height = (MM * any_run.scene["column"][k] for k in ("radius", "height"))
    ax.plot([0, length, length], [height, height, 0], ":", color=GREY, label="before")
    ax.set_aspect("equal")
    ax.set_ylim(0, 1.1 * height)
    ax.set_xlim(left=0)
    ax.set_xlabel("$x$ / mm")
    ax.set_ylabel("$z$ / mm")
    ax.set_title("final surfaces (thick) and failure lines (thin; below them no particle moved by a rod)", fontsize=10)
    ax.legend(fontsize=8, loc="upper right")
    return fig


def fields_figure(runs):
    fig, axes = plt.subplots(len(runs), 1, figsize=(9, 1.9 * len(runs)), sharex=True, squeeze=False,
                             layout="constrained")
    for ax, (name, run) in zip(axes[:, 0], runs.items()):
        spacing = MM * run.scene_value("scene", "spacing")
        discs = particles(ax, MM * run.final["position"], MM * run.displacement(), spacing, "viridis", 0, 150)
        ax.set_aspect("equal")
        ax.set_xlim(0, 480)
        ax.set_ylim(0, 110)
        ax.set_ylabel("$z$ / mm")
        ax.set_title(name.replace("_", " "), fontsize=9)
        fig.colorbar(discs, ax=ax, label="displacement / mm", pad=0.01)
    axes[-1, 0].set_xlabel("$x$ / mm")
    return fig


def main():
    parser = argparse.ArgumentParser(description="Table, pictures and page of the channel study.")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, required=True, help="data folder of the project")
    arguments = parser.parse_args()
    runs = {p.parent.name: Result(p) for p in sorted(arguments.folder.glob("*/result.h5"), reverse=True)}
    runs = {name: run for name, run in sorted(runs.items(), key=lambda item: (item[0][0] != "s", item[0]))
            if run.complete}
    if not runs:
        sys.exit(f"{arguments.folder}: expected folders of runs such as simsand_e0.85, found none complete")
    laws = [p for (source, quantity, _), p in read_laws(arguments.data, "channel").items()
            if (source, quantity) == ("Lube 2005", "(d_f - d_0) / d_0")][0]
    rows = [row_of(name, run, laws) for name, run in runs.items()]
    write_table(arguments.folder / "channel.csv", rows)
    body = ""
    for picture, fig in (("lines", lines_figure(runs)), ("fields", fields_figure(runs))):
        path = arguments.folder / f"channel_{picture}.png"
        fig.savefig(path, dpi=130, bbox_inches="tight")
        body += embedded(path, f"Channel: {picture}")
    page = arguments.folder / "index.html"
    page.write_text(PAGE.format(title="The channel of rods", intro=INTRO, body=body + page_table(rows)),
                    encoding="utf-8")
    print(page)


INTRO = """Rods of Bui et al. (2008), 0.20 m x 0.10 m in plane strain against a smooth wall, the other wall taken away at
once: SIMSAND at four void ratios and Drucker-Prager with phi = 21.9 degrees through the same host. The front is where
the deposit is one rod, 2 mm, high."""

if __name__ == "__main__":
    main()
