#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""One line per case: results/columns.csv and results/triaxial.csv, from the result files beside them.

    summary.py [RESULTS]
"""
import csv
import pathlib
import sys

import h5py
import numpy as np

HERE = pathlib.Path(__file__).parent
PEAK_WINDOW = 0.01  # axial strain over which the stress ratio is averaged before its maximum is taken
CRITICAL_FROM = 0.35  # the critical state: means over all axial (logarithmic) strain above
BLOCK = 0.02  # axial strain of the blocks whose scatter gives the error of those means


def table2():
    """(porosity, grains) of the paper by (aspect ratio, shape, packing)."""
    lines = (l for l in open(HERE / "table2.csv") if not l.startswith("#"))
    return {(float(r["aspect_ratio"]), r["shape"], r["packing"]): (float(r["porosity"]), int(r["grains"]))
            for r in csv.DictReader(lines)}


def read_triaxial(path):
    header, names, rows = {}, None, []
    for line in open(path):
        if line.startswith("# "):
            key, value = line[2:].rstrip("\n").split(": ", 1)
            header[key] = value
        elif names is None:
            names = line.strip().split(",")
        else:
            rows.append(line.split(","))
    return header, dict(zip(names, np.array(rows, float).T))


def friction_angle(s_axial, s_radial):
    return np.degrees(np.arcsin((s_axial - s_radial) / (s_axial + s_radial)))


def running_mean(x, n):
    return np.convolve(x, np.ones(n) / n, "valid")


def triaxial_line(path):
    header, t = read_triaxial(path)
    strain, s_a, s_r = t["axial_strain"], t["sigma_axial_Pa"], t["sigma_radial_Pa"]
    n = min(len(strain), max(1, round(PEAK_WINDOW / np.diff(strain).mean())))
    phi = friction_angle(running_mean(s_a, n), running_mean(s_r, n))
    late = strain >= min(CRITICAL_FROM, strain[-1])
    block = ((strain[late] - strain[late][0]) / BLOCK).astype(int)
    parts = [block == b for b in np.unique(block)]
    angles = [friction_angle(s_a[late][p].mean(), s_r[late][p].mean()) for p in parts]
    ratios = [t["void_ratio"][late][p].mean() for p in parts]
    error = 1 / np.sqrt(max(1, len(parts)))
    return {
        "case": path.stem, "shape": header["shape"], "packing": header["packing"], "seed": header["seed"],
        "variables": header["variables"],
        "pressure_Pa": header["confining_pressure_Pa"], "grains": header["grains"],
        "void_ratio_prepared": header["void_ratio_prepared"], "void_ratio_start": header["void_ratio_start"],
        "peak_angle_deg": f"{phi.max():.1f}",
        "peak_at_axial_strain": f"{running_mean(strain, n)[phi.argmax()]:.4f}",
        "critical_angle_deg": f"{friction_angle(s_a[late].mean(), s_r[late].mean()):.1f}",
        "critical_angle_error_deg": f"{np.std(angles) * error:.1f}",
        "critical_void_ratio": f"{t['void_ratio'][late].mean():.3f}",
        "critical_void_ratio_error": f"{np.std(ratios) * error:.3f}",
        "inertial_number": header["inertial_number"], "overlap_mean_over_d": header["overlap_mean_over_d"],
        "contacts_per_grain_end": header["contacts_per_grain_end"], "cpu_s": header["cpu_s"],
    }


def column_line(path, paper_table):
    with h5py.File(path) as f:
        a, r0 = f.attrs, f.attrs["radius_m"]
        paper = paper_table.get((float(a["aspect_ratio"]), a["shape"], a["packing"]))
        t = f["time"][:]
        at_04 = np.abs(t - 0.4).argmin() if t[-1] > 0.395 else None

        moving = f["energy/kinetic"][-1] + f["energy/rotational"][-1]

        def runout(name, k):
            return "" if k is None else f"{f['front/' + name][k] / r0 - 1:.3f}"

        def height(name, k):
            return "" if k is None else f"{f['height/' + name][k] / r0:.3f}"

        return {
            "case": path.stem, "shape": a["shape"], "packing": a["packing"], "aspect_ratio": a["aspect_ratio"],
            "seed": a["seed"], "variables": a["variables"], "grains": a["grains"],
            "paper_porosity": paper[0] if paper else "", "paper_grains": paper[1] if paper else "",
            "grains_over_paper": f"{a['grains'] / paper[1]:.4f}" if paper else "",
            "porosity": f"{a['porosity']:.4f}", "void_ratio": f"{a['void_ratio']:.4f}",
            "porosity_core": f"{a['porosity_core']:.4f}",
            "h_surface_over_r0": height("surface", -1), "h_highest_over_r0": height("highest", -1),
            "h_surface_over_r0_at_0.4s": height("surface", at_04),
            **{f"runout_{k}": runout(k, -1) for k in ("one_grain", "cluster", "mass95", "mass99")},
            "runout_one_grain_at_0.4s": runout("one_grain", at_04),
            "end_s": f"{t[-1]:.2f}",
            "kinetic_over_potential_end": f"{moving / f['energy/potential'][0]:.1e}",
            "undisturbed_fraction_0.5d": f"{a['undisturbed_fraction_0.5d']:.3f}",
            "overlap_mean_over_d": f"{a['overlap_mean_over_d']:.1e}",
            "overlap_max_over_d": f"{a['overlap_max_over_d']:.1e}",
            "cpu_s": f"{a['cpu_s_deposit'] + a['cpu_s_settle'] + a['cpu_s_collapse']:.0f}",
        }


def write(path, lines):
    if not lines:
        return
    with open(path, "w", newline="") as f:
        table = csv.DictWriter(f, lines[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows(lines)


def main():
    results = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "results"
    paper = table2()
    write(results / "columns.csv", [column_line(p, paper) for p in sorted(results.glob("column_*.h5"))])
    write(results / "triaxial.csv", [triaxial_line(p) for p in sorted(results.glob("triaxial_*.csv"))])


if __name__ == "__main__":
    main()
