# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the study of the 24 columns: one row a column; cost and error by spacing."""
import numpy as np

from figures.study_data import SHAPES, deviation, fallen, law_value, outline_distance, undisturbed

HEIGHT_LAW, RUNOUT_LAW, RADIUS_LAW = "h_f / r_0", "(r_f - r_0) / r_0", "r_f / r_0"


def ordered(columns):
    return sorted(columns, key=lambda key: (SHAPES.index(key[0]), key[1], key[2]))


def volume(body, share):
    """Of a share of the column, cm3."""
    return 1e6 * share * np.pi * body.r0**2 * body.h0


def dem_part(run, other):
    """Numbers of discrete elements, and errors of the run against them in per cent."""
    height, radius = deviation(run, other)
    mass95 = run.mass_radius(0.95)
    return {"dem_void_ratio": other.void_ratio, "dem_height": other.height, "dem_runout": other.runout,
            "dem_fall_95_s": fallen(other.time, other.heights, 0.95), "dem_undisturbed": other.undisturbed,
            "dem_undisturbed_cm3": volume(other, other.undisturbed), "height_error_%": 100 * height,
            "radius_error_%": 100 * radius, "mass95_radius": mass95, "dem_mass95_radius": other.mass95,
            "mass95_error_%": 100 * (mass95 / other.mass95 - 1), "outline_distance_%": 100 * outline_distance(run, other)}


def law_part(aspect, laws):
    row = {}
    for (source, quantity, reading), pieces in laws.items():
        name = f"{source}{', ' + reading if reading else ''}"
        if quantity == HEIGHT_LAW:
            row[f"{name} height"] = law_value(pieces, aspect)
        elif quantity == RUNOUT_LAW:
            row[f"{name} runout"] = law_value(pieces, aspect)
        elif quantity == RADIUS_LAW:  # the reading that keeps the volume; below its range stands the other quantity
            row[f"{name} runout"] = row.get(f"{name} runout", np.nan)
            value = law_value(pieces, aspect) - 1
            row[f"{name} runout"] = value if np.isfinite(value) else row[f"{name} runout"]
    return row


def row_of(run, other, laws):
    share = undisturbed(run)
    row = {"shape": run.shape, "packing": run.packing, "a": run.aspect, "void_ratio": run.void_ratio,
           "height": run.height, "top": run.top, "runout": run.runout, "time_to_rest_s": run.rest,
           "fall_95_s": fallen(run.time, run.heights, 0.95), "undisturbed": share,
           "undisturbed_cm3": volume(run, share)}
    if other:
        row |= dem_part(run, other)
    row |= law_part(run.aspect, laws)
    row |= {"energy_imbalance": run.summary["energy_imbalance"], "particles": int(run.summary["particles"]),
            "steps": int(run.summary["steps"]), "cpu_s": run.seconds}
    if other:
        row |= {"dem_cpu_s": other.seconds, "dem_cost_over_ours": other.seconds / run.seconds,
                "dem_collapse_over_ours": other.collapse_seconds / run.seconds}
    return row


def dem_rows(dem, laws):
    """Discrete elements as rows of their own, beside the laws."""
    return [{"shape": key[0], "packing": key[1], "a": key[2], "height": dem[key].height, "runout": dem[key].runout,
             **law_part(key[2], laws)} for key in ordered(dem)]


def rows_of(runs, dem, laws):
    return [row_of(runs[key], dem.get(key), laws) for key in ordered(runs)]


def values(rows, name):
    """Of the rows that have the column as a finite number."""
    return np.array([row[name] for row in rows if np.isfinite(row.get(name, np.nan))])


def cost_rows(runs, dem, laws):
    """One row a set and spacing: error against discrete elements and against the set's finest spacing, processor time,
    and how many times that of discrete elements."""
    table = []
    for (name, spacing), columns in sorted(runs.items()):
        rows = [row for row in rows_of(columns, dem, laws) if "dem_height" in row]
        fine = min(s for of_set, s in runs if of_set == name)
        pairs = [(column, runs[name, fine][key]) for key, column in columns.items()
                 if key in runs[name, fine] and fine < spacing]
        row = {"set": name, "spacing_mm": spacing, "columns": len(columns), "columns_with_dem": len(rows)}
        for label, of in (("height", "height_error_%"), ("radius", "radius_error_%")):
            errors = np.abs(values(rows, of))
            if errors.size:
                row |= {f"mean_{label}_error_%": errors.mean(), f"largest_{label}_error_%": errors.max()}
        if pairs:
            row |= {f"to_{fine:g}mm_height_%": 100 * np.mean([abs(a.height / b.height - 1) for a, b in pairs]),
                    f"to_{fine:g}mm_radius_%": 100 * np.mean([abs((1 + a.runout) / (1 + b.runout) - 1)
                                                              for a, b in pairs])}
        row["cpu_s_all"] = sum(column.seconds for column in columns.values())
        if rows:
            row |= {"median_dem_cpu_s": np.median(values(rows, "dem_cpu_s")),
                    "median_cpu_s": np.median(values(rows, "cpu_s")),
                    "median_dem_cost_over_ours": np.median(values(rows, "dem_cost_over_ours")),
                    "median_dem_collapse_over_ours": np.median(values(rows, "dem_collapse_over_ours"))}
        table.append(row)
    return table
