#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes TABLES.md from results/columns.csv and results/triaxial.csv (summary.py makes these).

    tables.py [OUT [RESULTS]]     OUT: TABLES.md beside this file
"""
import csv
import pathlib
import sys

HERE = pathlib.Path(__file__).parent
SHAPES, PACKINGS = ("SS", "TS", "ES"), ("dense", "loose")
ASPECTS, PRESSURES = ("0.5", "1.0", "2.0", "4.0"), ("10000", "5000", "2000")


def read(path):
    return list(csv.DictReader(open(path)))


def words(row, number, scale=1, digits=3):
    return f"{scale * float(row[number]):.{digits}f}"


def name(row):
    """Shape, packing, then what differs from the main set."""
    parts = row["case"].split("_")
    return " ".join(parts[1:4]) + ("".join(", " + p.replace("seed", "seed ") for p in parts[4:]))


def order(row):
    value = float(row.get("aspect_ratio") or 1e6 / float(row["pressure_Pa"]))
    main_set = row["variables"] == "none" and row["seed"] == "1" and len(row["case"].split("_")) == 4
    return not main_set, SHAPES.index(row["shape"]), PACKINGS.index(row["packing"]), value, row["case"]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


def overview(rows, key, values, heading, unit):
    """Which cases of the main set are in, with the CPU seconds of each."""
    cost = {(r["shape"], r["packing"], r[key]): r["cpu_s"] for r in rows if not order(r)[0]}
    body = [[f"{s} {p}"] + [f"{float(cost[s, p, v]):.0f} s" if (s, p, v) in cost else "missing" for v in values]
            for s in SHAPES for p in PACKINGS]
    return table([heading] + [f"{float(v) / (1e3 if unit else 1):g}{unit}" for v in values], body)


def packings(rows):
    head = ["case", "grains", "over Table 2", "porosity cut", "Table 2", "core", "e", "mean overlap / d", "largest"]
    return table(head, [[
        name(r), r["grains"], words(r, "grains_over_paper"), words(r, "porosity"), r["paper_porosity"],
        words(r, "porosity_core"), words(r, "void_ratio"), r["overlap_mean_over_d"], r["overlap_max_over_d"],
    ] for r in rows])


def deposits(rows):
    head = ["case", "h_f / r0: surface", "highest", "runout: one grain", "cluster", "95 %", "99 %",
            "one grain at 0.4 s", "unmoved part", "end, s", "motion left"]
    return table(head, [[
        name(r), r["h_surface_over_r0"], r["h_highest_over_r0"], r["runout_one_grain"], r["runout_cluster"],
        r["runout_mass95"], r["runout_mass99"], r["runout_one_grain_at_0.4s"], r["undisturbed_fraction_0.5d"],
        r["end_s"], r["kinetic_over_potential_end"],
    ] for r in rows])


def triaxial(rows):
    head = ["case", "e prepared", "start", "peak angle", "at strain", "critical angle", "critical e",
            "inertial number", "mean overlap / d"]
    return table(head, [[
        name(r), words(r, "void_ratio_prepared"), words(r, "void_ratio_start"),
        *((r["peak_angle_deg"], words(r, "peak_at_axial_strain", 100, 1) + " %")
          if r["packing"] == "dense" else ("-", "-")),
        f"{r['critical_angle_deg']} ± {r['critical_angle_error_deg']}",
        f"{r['critical_void_ratio']} ± {r['critical_void_ratio_error']}",
        r["inertial_number"], r["overlap_mean_over_d"],
    ] for r in rows])


def main():
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "TABLES.md"
    results = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else HERE / "results"
    columns = sorted(read(results / "columns.csv"), key=order)
    tests = sorted(read(results / "triaxial.csv"), key=order)
    out.write_text(f"""# The DEM cases in numbers

Written by `tables.py` from the result files. What each quantity is: `README.md`.

## CPU seconds of one core

The core was shared; an idle one does better. All stages, LAMMPS alone.

{overview(columns, "aspect_ratio", ASPECTS, "columns, aspect ratio", "")}

{overview(tests, "pressure_Pa", PRESSURES, "triaxial tests", " kPa")}

## Columns: packings

{packings(columns)}

## Columns: deposits

Heights and runouts over r0 at the end of the run. One grain high is the definition for comparison with SPH. Unmoved:
part of the grains that moved less than half a diameter. Motion left: kinetic over initial potential energy.

{deposits(columns)}

## Triaxial tests

Angles in degrees; a peak is taken where the sample is dense; errors are those of the mean above 35 % strain.

{triaxial(tests)}
""")


if __name__ == "__main__":
    main()
