# SPDX-License-Identifier: BSD-3-Clause
"""Sentences of the study of the 24 columns, made from its numbers."""
import numpy as np

from figures.study_rows import HEIGHT_LAW, RADIUS_LAW, values

AIM_MEAN, AIM_WORST = 5, 15  # %, of the errors against discrete elements of the same grains
LAW_SPREAD = {"height": 25, "runout": 15}  # %: laws differ by so much among themselves (data/experiments/README.md)


def name_of(row):
    return f"{row['shape']} {row['packing']} a = {row['a']:g}"


def verdict(errors):
    mean, worst = np.abs(errors).mean(), np.abs(errors).max()
    if mean <= AIM_MEAN and worst <= AIM_WORST:
        return f"within the aim (mean {AIM_MEAN} %, none above {AIM_WORST} %)"
    beyond = int((np.abs(errors) > AIM_WORST).sum())
    return (f"misses the aim: mean {mean - AIM_MEAN:+.1f} points from {AIM_MEAN} %, {beyond} of {errors.size} columns "
            f"above {AIM_WORST} %")


def against_dem(rows):
    """How far SPH is from discrete elements of the same grains."""
    lines = []
    for name, label in (("height_error_%", "final height"), ("radius_error_%", "final radius"),
                        ("mass95_error_%", "radius with 95 % of the mass")):
        errors = values(rows, name)
        if not errors.size:
            continue
        worst = max((row for row in rows if name in row), key=lambda row: abs(row[name]))
        lines.append(f"{label} against DEM, {errors.size} columns: mean {np.abs(errors).mean():.1f} %, largest "
                     f"{worst[name]:+.1f} % ({name_of(worst)}), mean with sign {errors.mean():+.1f} %; "
                     f"{verdict(errors)}")
        for grains, label_of in ((("SS",), "spheres"), (("TS", "ES"), "tetrahedral and elongated grains")):
            part = values([row for row in rows if row["shape"] in grains], name)
            if part.size:
                lines.append(f"{label}, {label_of}, {part.size} columns: mean {np.abs(part).mean():.1f} %, with sign "
                             f"{part.mean():+.1f} %; {verdict(part)}")
    distances = values(rows, "outline_distance_%")
    if distances.size:
        lines.append(f"area between the final outlines of SPH and DEM, over the section of the column: mean "
                     f"{distances.mean():.1f} %, largest {distances.max():.1f} %")
    return lines


def law_deviation(rows, quantity):
    """Mean deviation (per cent) of height or runout from each law that says something."""
    found = {}
    laws = [name for row in rows[:1] for name in row if name.endswith(f" {quantity}") and " 2004" in name]
    for law in laws:
        pairs = [(row[quantity], row[law]) for row in rows if np.isfinite(row.get(law, np.nan))]
        if pairs:
            found[law.removesuffix(f" {quantity}")] = 100 * np.mean([a / b - 1 for a, b in pairs])
    return found


def against_laws(rows):
    """Spheres and other grains beside the laws of the laboratory."""
    lines = []
    for quantity in ("height", "runout"):
        for grains, label in ((("SS",), "spheres"), (("TS", "ES"), "tetrahedral and elongated grains")):
            part = [row for row in rows if row["shape"] in grains]
            if not part:
                continue
            found = law_deviation(part, quantity)
            near = min((abs(x) for x in found.values()), default=np.nan)
            inside = near <= LAW_SPREAD[quantity]
            numbers = ", ".join(f"{law}: {x:+.0f} %" for law, x in found.items())
            lines.append(f"{quantity} of {label} from the laws in the mean: {numbers}. The nearest is "
                         f"{'within' if inside else 'beyond'} what an experiment can judge ({LAW_SPREAD[quantity]} %)")
    return lines


def between_sets(first, second, labels):
    """What another parameter set changes."""
    other = {name_of(row): row for row in second}
    pairs = [(row, other[name_of(row)]) for row in first if name_of(row) in other]
    if not pairs:
        return []
    lines = []
    for grains in ("SS", "TS", "ES"):
        some = [(a, b) for a, b in pairs if a["shape"] == grains]
        if some:
            h = np.array([100 * (b["height"] / a["height"] - 1) for a, b in some])
            r = np.array([100 * ((1 + b["runout"]) / (1 + a["runout"]) - 1) for a, b in some])
            lines.append(f"{grains}: with {labels[1]} in place of {labels[0]} heights change by {h.mean():+.1f} % in the "
                         f"mean ({h.min():+.1f} to {h.max():+.1f} %), final radii by {r.mean():+.1f} % "
                         f"({r.min():+.1f} to {r.max():+.1f} %)")
    return lines


def why(rows, runs, dem):
    """Where SPH and DEM part: time, definition, and what a continuum leaves out."""
    lines = []
    seen = [(runs[key], other) for key, other in dem.items() if key in runs]
    for grains, label in ((("SS",), "spheres"), (("TS", "ES"), "tetrahedral and elongated grains")):
        pairs = [(run, other) for run, other in seen if run.shape in grains]
        if not pairs:
            continue
        at_end = np.array([run.top / other.height - 1 for run, other in pairs])
        at_rest = np.array([run.top / (np.interp(run.rest, other.time, other.heights) / other.r0) - 1
                            for run, other in pairs if np.isfinite(run.rest)])
        energy = [(other["energy/kinetic"] + other["energy/rotational"])[-1] / other["energy/potential"][0]
                  for _, other in pairs]
        lines.append(f"{label}: height of SPH over DEM at the end {100 * at_end.mean():+.0f} % in the mean; over DEM at the "
                     f"time at which SPH comes to rest {100 * at_rest.mean():+.0f} %. At its end DEM still holds "
                     f"{100 * np.mean(energy):.2g} % of the first potential energy as motion")
        if at_end.mean() > 0.15 and np.mean(energy) > 0.005:
            lines.append(f"{label}: DEM has not come to rest. Ideal spheres roll; nothing at their contacts resists rolling, and a "
                         "rate-independent continuum with the strength of slow triaxial tests stands where they still "
                         "creep. The experiments of simsand study causes tell parameters, boundary, model and scheme apart")
        offset = np.mean([other.heights[0] / other.h0 - 1 for _, other in pairs])
        levelled = np.array([run.top / (other.height - (other.heights[0] - other.h0) / other.r0) - 1
                             for run, other in pairs])
        lines.append(f"{label}: what is called the surface of DEM, the mean of the highest grain tops, lies {100 * offset:+.1f} % "
                     "above the initial height before anything moves; errors smaller than that are of the definition. Less what the tops "
                     f"stand above each column at first, heights are off by {100 * np.abs(levelled).mean():.1f} % in the mean, with sign "
                     f"{100 * levelled.mean():+.1f} %")
        thick = {packing: np.mean([np.average(other["outline/thickness"][-1][:3], weights=(1, 3, 5)) / other.heights[-1] - 1
                                   for run, other in pairs if run.packing == packing])
                 for packing in sorted({run.packing for run, _ in pairs})}
        lines.append(f"{label}: by the volume of the grains over the solid fraction of the cut column, in place of their tops, "
                     "DEM's heights would differ by " + ", ".join(f"{100 * x:+.1f} % ({packing})" for packing, x in thick.items()))
        same = [row for row in rows if row["shape"] in grains and "dem_undisturbed" in row]
        if same:
            lines.append(f"{label}: undisturbed share of the column {np.mean([r['undisturbed'] for r in same]):.2f} in SPH and "
                         f"{np.mean([r['dem_undisturbed'] for r in same]):.2f} in DEM, in the mean of {len(same)}")
    return lines


def thrown(runs):
    """Columns above which a particle flew: their height in time is not that of the deposit."""
    rises = {key: ((np.maximum.accumulate(run.heights[::-1])[::-1] - run.heights).max() / run.r0, run)
             for key, run in runs.items()}
    high = {key: rise for key, (rise, _) in rises.items() if rise > 0.2}
    if not high:
        return []
    named = ", ".join(f"{shape} {packing} a = {a:g} ({rise:.1f} r0)" for (shape, packing, a), rise in high.items())
    return [f"in {len(high)} of {len(runs)} columns a light particle next to the axis is thrown up while the sand closes on the axis, "
            f"which the height in time shows: {named}. It falls back; the energy is closed to "
            f"{max(abs(rises[key][1].summary['energy_imbalance']) for key in high):.1g} of the first potential energy"]


def spent(table, name):
    """Cost of a set beside discrete elements, at each spacing."""
    lines = []
    for row in (row for row in table if row["set"] == name and "mean_height_error_%" in row):
        lines.append(f"{row['spacing_mm']:g} mm: {row['columns']} columns took {row['cpu_s_all'] / 60:.1f} minutes of one "
                     f"processor. DEM took {row['median_dem_cost_over_ours']:.0f} times as long as SPH (median of "
                     f"{row['columns_with_dem']}; {row['median_dem_collapse_over_ours']:.0f} times without preparing the packing); SPH's "
                     f"mean error is then {row['mean_height_error_%']:.1f} % in height and {row['mean_radius_error_%']:.1f} % in radius")
    return lines


def simpler(rows, sand):
    """Where Drucker-Prager does as well as SIMSAND with the same critical friction angle."""
    other = {name_of(row): row for row in sand}
    pairs = [(row, other[name_of(row)]) for row in rows if name_of(row) in other]
    if not pairs:
        return []
    lines = []
    for packing in ("dense", "loose"):
        some = [(a, b) for a, b in pairs if a["packing"] == packing]
        if some:
            h = [100 * (a["height"] / b["height"] - 1) for a, b in some]
            r = [100 * ((1 + a["runout"]) / (1 + b["runout"]) - 1) for a, b in some]
            lines.append(f"{packing}: Drucker-Prager from SIMSAND by {np.mean(h):+.1f} % in height ({min(h):+.1f} to {max(h):+.1f}), "
                         f"{np.mean(r):+.1f} % in radius ({min(r):+.1f} to {max(r):+.1f})")
    known = [(a, b) for a, b in pairs if "dem_height" in a and "dem_height" in b]
    if known:
        better = [name_of(a) for a, b in known
                  if max(abs(a["height_error_%"]), abs(a["radius_error_%"])) <=
                  max(abs(b["height_error_%"]), abs(b["radius_error_%"])) + 1]
        lines.append(f"against DEM ({len(known)} columns) mean errors are, Drucker-Prager and SIMSAND: height "
                     f"{np.mean([abs(a['height_error_%']) for a, _ in known]):.1f} and "
                     f"{np.mean([abs(b['height_error_%']) for _, b in known]):.1f} %, radius "
                     f"{np.mean([abs(a['radius_error_%']) for a, _ in known]):.1f} and "
                     f"{np.mean([abs(b['radius_error_%']) for _, b in known]):.1f} %. The simple model does as well, to one "
                     f"point, in {len(better)} of {len(known)}: {', '.join(better) or 'none'}")
    ratio = np.median([b["cpu_s"] / a["cpu_s"] for a, b in pairs])
    per_step = np.median([(b["cpu_s"] / b["steps"] / b["particles"]) / (a["cpu_s"] / a["steps"] / a["particles"])
                          for a, b in pairs])
    lines.append(f"SIMSAND's runs take {ratio:.2g} times the processor time of Drucker-Prager's (median), "
                 f"{per_step:.2g} times per particle and step")
    return lines
