#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Picture of `simsand run --posterior`.

    posterior.py FOLDER --data DATA      FOLDER/sets.csv, *_bands.csv -> FOLDER/posterior.png
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.style import BLUE, MM, plt, use
from figures.table import read_columns

use(font_size=9, dpi=130)


def band(ax, table, x, scale):
    ax.fill_between(scale * table[x], MM * table["lower_5"], MM * table["upper_95"], color=BLUE, alpha=0.25, lw=0,
                    label="5 to 95 %")
    ax.plot(scale * table[x], MM * table["median"], color=BLUE, label="median")
    ax.set_ylim(0, 1.08 * MM * table["upper_95"].max())
    ax.set_xlim(left=0)
    ax.grid(color="0.93")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--data", type=pathlib.Path, help="not used")
    folder = parser.parse_args().folder
    sets = read_columns(folder / "sets.csv")
    fig, axes = plt.subplots(1, 3, figsize=(12.5, 3.8), gridspec_kw={"width_ratios": (1.5, 1.2, 1)})
    band(axes[0], read_columns(folder / "outline_bands.csv"), "radius_m", MM)
    axes[0].set_xlabel("$r$ / mm")
    axes[0].set_ylabel("final height of the surface / mm")
    band(axes[1], read_columns(folder / "height_bands.csv"), "time_s", 1)
    axes[1].set_xlabel("time / s")
    axes[1].set_ylabel("height $h$ / mm")
    axes[1].legend(loc="lower right")
    complete = sets["failed"] == 0
    axes[2].plot(sets["radius"][complete], sets["height"][complete], "o", color=BLUE, ms=4, mfc="none")
    axes[2].set_xlabel("$r_f/r_0$")
    axes[2].set_ylabel("$h_f/r_0$")
    axes[2].grid(color="0.93")
    failed = int((~complete).sum())
    axes[2].set_title(f"{int(complete.sum())} sets of parameters" + (f", {failed} more failed" if failed else ""), fontsize=9)
    fig.tight_layout()
    fig.savefig(folder / "posterior.png")
    print(folder / "posterior.png")


if __name__ == "__main__":
    main()
