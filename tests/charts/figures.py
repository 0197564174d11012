#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the integrators' comparison: figures.py ELEMENT.csv [INCREMENTS.csv] [-o FOLDER]

ELEMENT.csv is written by `simsand-chart element`, which runs this script, INCREMENTS.csv by `simsand-chart increments`.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "drivers"))
from figures.style import plt, use
from figures.table import read_rows
import numpy as np

# Colours that stay apart for colour-blind readers (Okabe and Ito).
STYLE = {
    "explicit Euler": ("#999999", "v"),
    "corrected Euler": ("#E69F00", "^"),
    "cutting plane": ("#CC79A7", "D"),
    "backward Euler": ("#56B4E9", "s"),
    "modified Euler": ("#009E73", "P"),
    "product, one point": ("#0072B2", "o"),
    "product, blocks": ("#D55E00", "o"),
    "product, blocks, single": ("#000000", "o"),
}
WORDS = ("integrator", "setting", "group", "member", "phase")
use(font_size=9, dpi=130)


def failing(row):
    """Share of the cases whose answer is missing, or wrong by a tenth and said to be right."""
    return (row["not_finite"] + row["not_converged"] + row["over_a_tenth"]) / row["cases"]


def coarsest(row):
    """The setting at which a method is used as it comes."""
    return row["setting"] in ("parts=1", "tolerance=0.001")


def front_panel(ax, rows, title):
    for name, (colour, marker) in STYLE.items():
        mine = sorted((r for r in rows if r["integrator"] == name), key=lambda r: r["nanoseconds_per_update"])
        if not mine:
            continue
        cost = [r["nanoseconds_per_update"] / 1e3 for r in mine]
        error = [r["error_95"] for r in mine]
        ax.loglog(cost, error, "-", color=colour, lw=1)
        for r, x, y in zip(mine, cost, error):
            drifts = r["drifted"] > 0.01 * r["cases"]
            ax.loglog(x, y, marker, color=colour, ms=7 if coarsest(r) else 4, mfc="white" if drifts else colour)
            if failing(r) > 0:
                ax.loglog(x, y, "x", color="red", ms=3 + 10 * failing(r) ** 0.5, mew=1, zorder=5)
    ax.set_title(title, fontsize=9)
    ax.grid(True, which="major", color="#dddddd", lw=0.5)
    ax.set_axisbelow(True)


def draw_fronts(rows, folder):
    everything = [r for r in rows if r["group"] == "all"]
    increments = sorted({r["strain_increment"] for r in everything})
    columns = min(3, len(increments))
    lines = -(-len(increments) // columns)
    fig, axes = plt.subplots(lines, columns, figsize=(3.6 * columns + 0.6, 3.3 * lines + 0.9), squeeze=False,
                             sharey=True, sharex=True)
    for ax, increment in zip(axes.flat, increments):
        part = [r for r in everything if r["strain_increment"] == increment]
        title = f"laboratory paths, strain increment {increment:g}" if increment else "updates of the collapse"
        front_panel(ax, part, f"{title} ({part[0]['cases']:.0f} cases)")
    for k, ax in enumerate(axes.flat):
        ax.set_visible(k < len(increments))
        if k + columns >= len(increments):  # nothing below it
            ax.set_xlabel("processor time per update / µs")
            ax.tick_params(labelbottom=True)
    for ax in axes[:, 0]:
        ax.set_ylabel("error of the stress, 95 % of cases below")
    handles = [plt.Line2D([], [], color=c, marker=m, lw=1, label=n) for n, (c, m) in STYLE.items()
               if any(r["integrator"] == n for r in rows)]
    handles += [plt.Line2D([], [], color="grey", marker="o", ms=8, lw=0, label="as it comes (modified Euler: tolerance"
                           " 0.001)"),
                plt.Line2D([], [], color="grey", marker="o", ms=4, lw=0, label="in 2 to 32 parts (tolerance 0.1 to 1e-6)"),
                plt.Line2D([], [], color="red", marker="x", lw=0, label="some cases without answer, or wrong by more"
                           " than\na tenth and said to be right; size by their share"),
                plt.Line2D([], [], color="grey", marker="o", mfc="white", lw=0,
                           label="f > 1e-6 p (single precision: 1e-5) in over 1 %")]
    fig.tight_layout(rect=(0, 0.25, 1, 1) if lines == 1 else None)
    corner = axes[-1, -1].get_position()
    free = len(increments) < axes.size
    fig.legend(handles=handles, loc="lower right" if free else "lower center", fontsize=8, ncols=1 if free else 4,
               bbox_to_anchor=(corner.x1, corner.y0) if free else (0.5, 0))
    fig.savefig(folder / "integrators.png")


def draw_histogram(ax, rows, low, high, label):
    """Shares of the updates of the collapse by answer, per class."""
    rows = [r for r in rows if r["phase"] == "collapse" and r[low] > 0]
    edges = sorted({r[low] for r in rows} | {r[high] for r in rows})
    total = sum(r[k] for r in rows for k in ANSWERS)
    base = np.zeros(len(edges) - 1)
    for answer, colour in ANSWERS.items():
        share = np.array([sum(r[answer] for r in rows if r[low] == e) for e in edges[:-1]]) / total
        ax.stairs(100 * (base + share), edges, baseline=100 * base, fill=True, color=colour,
                  label=answer.replace("_", " "))
        base += share
    ax.set_xscale("log")
    ax.set_xlabel(label)
    ax.set_ylabel("updates of the collapse / %")


ANSWERS = {"stress_free": "#DDDDDD", "elastic": "#56B4E9", "plastic": "#D55E00", "substepped": "#000000"}


def band(rows):
    """The strains between which 90 % of the plastic updates of the collapse lie."""
    sizes = {}
    for r in rows:
        if r["phase"] == "collapse":
            sizes[r["strain_to"]] = sizes.get(r["strain_to"], 0) + r["plastic"] + r["substepped"]
    strain = np.array(sorted(sizes))
    share = np.cumsum([sizes[s] for s in strain]) / sum(sizes.values())
    return strain[np.searchsorted(share, 0.05)], strain[np.searchsorted(share, 0.95)]


def without_stress(rows):
    """Share in per cent of the updates of the collapse that start without stress."""
    rows = [r for r in rows if r["phase"] == "collapse"]
    counts = [(sum(r[k] for k in ANSWERS), r["pressure_from_Pa"]) for r in rows]
    return 100 * sum(n for n, p in counts if p == 0) / sum(n for n, _ in counts)


def draw_sizes(rows, increments, folder):
    used = [r for r in rows if r["group"] == "all" and r["strain_increment"] > 0 and coarsest(r)]
    fig, axes = plt.subplots(2, 2, figsize=(10.5, 7))
    for name, (colour, marker) in STYLE.items():
        if name == "product, blocks":  # the numbers of one point
            continue
        mine = sorted((r for r in used if r["integrator"] == name), key=lambda r: r["strain_increment"])
        size = [r["strain_increment"] for r in mine]
        label = name + {"modified Euler": ", tolerance 0.001", "product, one point": " or blocks"}.get(name, "")
        line = "--" if "single" in name else "-"
        axes[0, 0].loglog(size, [r["error_95"] for r in mine], line + marker, color=colour, ms=4, lw=1)
        axes[0, 1].semilogx(size, [100 * failing(r) for r in mine], line + marker, color=colour, ms=4, lw=1,
                            label=label)
    axes[0, 0].set_ylabel("error of the stress, 95 % of cases below")
    axes[0, 1].legend(fontsize=8, loc="upper left")
    axes[0, 1].set_ylabel("cases without answer or error above 0.1 / %")
    for ax in axes[0]:
        ax.set_xlabel("strain increment $\\sqrt{d\\varepsilon:d\\varepsilon}$ of the laboratory paths")
        ax.axvspan(*band(increments), color="#FFF2CC", zorder=0)
        ax.grid(True, color="#dddddd", lw=0.5)
    axes[0, 0].set_title("shaded: 90 % of the plastic updates of a collapse", fontsize=9)
    draw_histogram(axes[1, 0], increments, "strain_from", "strain_to",
                   "strain increment $\\sqrt{d\\varepsilon:d\\varepsilon}$")
    draw_histogram(axes[1, 1], increments, "pressure_from_Pa", "pressure_to_Pa",
                   f"mean stress before the update / Pa ({without_stress(increments):.0f} % have none)")
    axes[1, 0].set_ylim(0, 1.4 * axes[1, 0].get_ylim()[1])
    axes[1, 0].legend(fontsize=8, loc="upper right", ncols=2)
    axes[1, 0].set_xlim(1e-9, 1e-2)
    axes[1, 1].set_xlim(1e-1, 1e5)
    fig.tight_layout()
    fig.savefig(folder / "increments.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("element", type=pathlib.Path, help="element.csv")
    parser.add_argument("increments", type=pathlib.Path, nargs="?", help="increments.csv")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder; default: that of element.csv")
    arguments = parser.parse_args()
    folder = arguments.output or arguments.element.parent
    folder.mkdir(parents=True, exist_ok=True)
    rows = read_rows(arguments.element, WORDS)
    draw_fronts(rows, folder)
    if arguments.increments:
        draw_sizes(rows, read_rows(arguments.increments, WORDS), folder)
    print(*sorted(folder.glob("*.png")), sep="\n")


if __name__ == "__main__":
    main()
