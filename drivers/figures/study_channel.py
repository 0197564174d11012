#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Table, pictures and page of `simsand study channel`: final surfaces and failure lines, SIMSAND and Drucker-Prager.

    study_channel.py FOLDER --data DATA      FOLDER/RUN/result.h5 -> FOLDER/channel.csv, *.png, index.html"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))  # the folder of this package
from figures.draw import particles, surface
from figures.result import Result
from figures.style import BLUE, GREEN, GREY, MM, ORANGE, PURPLE, SKY, plt, use
from figures.study_data import law_value, read_laws
from figures.study_page import PAGE, bullets, embedded, page_table, save
from figures.table import write_rows
import numpy as np

use(font_size=10, dpi=160)
MOVED = 0.002  # m: one rod; the failure line bounds what moved farther
PUBLISHED_TIME, PUBLISHED_ENERGY = 0.8, 0.690  # s; mechanical energy left of Drucker-Prager in an open SPH code
CRITICAL = "simsand_e0.85"  # the void ratio nearest below the critical state: least change of volume
COLOURS = {"simsand_e0.75": BLUE, "simsand_e0.85": SKY, "simsand_e0.95": GREEN, "simsand_e1.05": PURPLE,
           "drucker_prager_psi0": ORANGE, "drucker_prager_psi5": "black"}


def label_of(name):
    if name.startswith("simsand_e"):
        return f"SIMSAND, $e_0$ = {name.removeprefix('simsand_e')}"
    return f"Drucker-Prager, $\\psi$ = {name.removeprefix('drucker_prager_psi')}°"


def failure_line(run):
    """The highest particle of each initial column of particles that moved no more than a rod, where others above it
    did: x, z in the deposit."""
    position, still = run.final["position"], run.displacement() <= MOVED
    start = run.initial_position
    x, z = [], []
    for column in np.unique(np.round(start[:, 0], 6)):
        here = np.abs(start[:, 0] - column) < 1e-6
        if still[here].any() and not still[here].all():
            top = np.argmax(np.where(here & still, start[:, 1], -1))
            x.append(position[top, 0])
            z.append(position[top, 1])
    return np.array(x), np.array(z)


def line_slope(x, z):
    """Of the failure line, degrees below the horizontal outwards, by least squares."""
    return np.degrees(np.arctan(-np.polyfit(x, z, 1)[0])) if len(x) > 2 else np.nan


def row_of(name, run, laws, seconds):
    summary = {key: float(value[()]) for key, value in run.file["summary"].items()}
    time, kinetic, potential = (run.series[n] for n in ("time", "kinetic_energy", "potential_energy"))
    energy = (kinetic + potential) / (kinetic[0] + potential[0])
    column = run.scene["column"]
    masses = run.file["particles/mass"][()]
    x, z = failure_line(run)
    moved = run.displacement() > MOVED
    top = run.initial_position[:, 1] > run.initial_position[:, 1].max() - 1e-6
    standing = top & ~moved
    return {"run": name, "height_m": column["radius"] * summary["final_height"],
            "toe_m": column["radius"] * (1 + summary["runout"]), "runout_over_l0": summary["runout"],
            "Lube 2005 runout": law_value(laws, column["height"] / column["radius"]),
            "undisturbed": masses[~moved].sum() / masses.sum(),
            "undisturbed_surface_m": run.initial_position[standing, 0].max() if standing.any() else 0.0,
            "failure_line_deg": line_slope(x, z), "time_to_rest_s": summary["time_to_rest"],
            f"energy_left_{PUBLISHED_TIME}_s": float(np.interp(PUBLISHED_TIME, time, energy)),
            "energy_imbalance": summary["energy_imbalance"], "particles": int(summary["particles"]),
            "steps": int(summary["steps"]), "cpu_s": seconds}


def distance(run, other):
    """Area between the final surfaces over the section of the column."""
    column = run.scene["column"]
    difference = np.abs(run.final["outline"] - np.interp(run.radii, other.radii, other.final["outline"], right=0.0))
    return np.sum(0.5 * (difference[1:] + difference[:-1]) * np.diff(run.radii)) / (column["radius"] * column["height"])


def density_lines(rows):
    """What the void ratio does."""
    sand = sorted((row for row in rows if row["run"].startswith("simsand")), key=lambda row: row["run"])
    if len(sand) < 2:
        return []
    first, last = sand[0], sand[-1]
    lines = [f"from {first['run']} to {last['run']}: toe {first['toe_m']:.3f} to {last['toe_m']:.3f} m, undisturbed share "
             f"{first['undisturbed']:.3f} to {last['undisturbed']:.3f}, undisturbed surface "
             f"{first['undisturbed_surface_m']:.3f} to {last['undisturbed_surface_m']:.3f} m, slope of the failure line "
             f"{first['failure_line_deg']:.0f} to {last['failure_line_deg']:.0f} degrees, time to rest "
             f"{first['time_to_rest_s']:.2f} to {last['time_to_rest_s']:.2f} s"]
    for name, quantity, sign in (("undisturbed share", "undisturbed", -1), ("toe", "toe_m", 1)):
        steps = sign * np.diff([row[quantity] for row in sand])
        word = {1: "grows", -1: "shrinks"}[sign]
        lines.append(f"the {name} {word} with each step of the void ratio" if (steps > 0).all() else
                     f"the {name} does not {word.removesuffix('s')} with each step of the void ratio: in {int((steps > 0).sum())} of {len(steps)}")
    return lines


def comparison_lines(rows, runs):
    """Drucker-Prager beside SIMSAND."""
    of = {row["run"]: row for row in rows}
    simple = of.get("drucker_prager_psi0")
    if not simple:
        return []
    lines = []
    sand = [row for row in rows if row["run"].startswith("simsand")]
    for row in sand:
        lines.append(f"{row['run']} from Drucker-Prager without dilation: toe {100 * (row['toe_m'] / simple['toe_m'] - 1):+.1f} %, "
                     f"undisturbed share {row['undisturbed'] - simple['undisturbed']:+.3f}, area between the surfaces "
                     f"{100 * distance(runs[row['run']], runs['drucker_prager_psi0']):.1f} % of the section")
    if sand:
        like = min(sand, key=lambda row: distance(runs[row["run"]], runs["drucker_prager_psi0"]))
        ratio = np.median([row["cpu_s"] / row["steps"] for row in sand]) / (simple["cpu_s"] / simple["steps"])
        lines.append(f"Drucker-Prager without dilation comes nearest to {like['run']}. One number, the friction angle, makes it; what "
                     f"the four void ratios do is out of its reach. SIMSAND takes {ratio:.2f} times its processor time per step, "
                     f"{np.median([row['cpu_s'] for row in sand]) / simple['cpu_s']:.2f} times per run (median)")
    if wide := of.get("drucker_prager_psi5"):
        lines.append(f"dilation of 5 degrees that never ends changes Drucker-Prager's toe by "
                     f"{100 * (wide['toe_m'] / simple['toe_m'] - 1):+.1f} % and its height by "
                     f"{100 * (wide['height_m'] / simple['height_m'] - 1):+.1f} %")
    energy = simple[f"energy_left_{PUBLISHED_TIME}_s"]
    lines.append(f"mechanical energy left at {PUBLISHED_TIME} s: {energy:.3f} (Drucker-Prager without dilation); an open SPH code with the "
                 f"same model has {PUBLISHED_ENERGY:.3f}, {100 * (energy / PUBLISHED_ENERGY - 1):+.1f} % from it")
    return lines


def farthest_toe(runs):
    """mm; a toe beyond the sampled radii is not known and counts as two lengths."""
    toes = [(run.scene["column"]["radius"], float(run.file["summary/runout"][()])) for run in runs.values()]
    return MM * max(length * (1 + runout if np.isfinite(runout) else 2) for length, runout in toes)


def lines_figure(runs):
    """Final surfaces and failure lines: SIMSAND above, Drucker-Prager (and one of SIMSAND) below."""
    groups = ([n for n in runs if n.startswith("simsand")],
              [n for n in runs if n.startswith("drucker")] + [n for n in runs if n == CRITICAL])
    fig, axes = plt.subplots(2, 1, figsize=(9.5, 6.2), sharex=True, layout="constrained")
    reach = farthest_toe(runs)
    for ax, names, title in zip(axes, groups, ("SIMSAND at four void ratios", "Drucker-Prager, and SIMSAND near critical")):
        for name in names:
            run, colour = runs[name], COLOURS.get(name, GREY)
            ax.plot(*surface(run.radii, run.final["outline"]), color=colour, lw=1.9, label=label_of(name))
            ax.plot(*(MM * np.array(failure_line(run))), "--", color=colour, lw=1.2)
        column = next(iter(runs.values())).scene["column"]
        length, height = MM * column["radius"], MM * column["height"]
        ax.plot([0, length, length], [height, height, 0], ":", color=GREY, label="before")
        ax.plot([], [], "--", color=GREY, lw=1.2, label="failure line: moved one rod, 2 mm")
        ax.set_aspect("equal")
        ax.set_xlim(0, 1.04 * reach)
        ax.set_ylim(0, 1.12 * height)
        ax.set_ylabel("$z$ / mm")
        ax.set_title(title, fontsize=10)
        ax.legend(fontsize=8, loc="upper right")
    axes[-1].set_xlabel("$x$ / mm")
    return fig


def fields_figure(runs):
    reach = farthest_toe(runs)
    fig, axes = plt.subplots(len(runs), 1, figsize=(8.5, 2.05 * len(runs)), sharex=True, squeeze=False,
                             layout="constrained")
    for ax, (name, run) in zip(axes[:, 0], runs.items()):
        spacing = MM * run.scene_value("scene", "spacing")
        discs = particles(ax, MM * run.final["position"], MM * run.displacement(), 1.15 * spacing, "viridis", 0, 150)
        ax.plot(*(MM * np.array(failure_line(run))), color=ORANGE, lw=1.5)
        ax.set_aspect("equal")
        ax.set_xlim(0, 1.04 * reach)
        ax.set_ylim(0, 110)
        ax.set_ylabel("$z$ / mm")
        ax.set_title(label_of(name), fontsize=9)
    fig.colorbar(discs, ax=axes, label="displacement / mm", pad=0.01, aspect=40, extend="max")
    axes[-1, 0].set_xlabel("$x$ / mm")
    return fig


def seconds_of(folder, run):
    measured = folder / "cpu_seconds"
    return float(measured.read_text()) if measured.exists() else float(run.file["summary/wall_clock"][()])


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
    rows = [row_of(name, run, laws, seconds_of(arguments.folder / name, run)) for name, run in runs.items()]
    write_rows(arguments.folder / "channel.csv", rows)
    found = {"What the void ratio does": density_lines(rows), "What the simple model does": comparison_lines(rows, runs)}
    body = ""
    for title, lines in found.items():
        body += f"<h2>{title}</h2>" + bullets(lines)
        print(title, *lines, sep="\n  ")
    for picture, caption, fig in (("lines", "Final surfaces and failure lines", lines_figure(runs)),
                                  ("fields", "Final displacement; line: failure line", fields_figure(runs))):
        path = arguments.folder / f"channel_{picture}.png"
        save(fig, path)
        body += embedded(path, caption)
    page = arguments.folder / "index.html"
    page.write_text(PAGE.format(title="The channel of rods", intro=INTRO, body=body + page_table(rows)),
                    encoding="utf-8")
    print(page)


INTRO = """Rods of Bui et al. (2008), 0.20 m x 0.10 m in plane strain against a smooth wall, the other wall taken away at
once: SIMSAND at four void ratios and Drucker-Prager with a friction angle of 21.9 degrees through the same host. The toe is where
the deposit is one rod, 2 mm, high; the failure line bounds what moved farther than one rod."""

if __name__ == "__main__":
    main()
