#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks the result files against the schema in README.md.  schema.py FILE...; exit code 1 on a fault."""
import sys

import h5py
import numpy as np

from extract_triaxial import COLUMNS

HEADER = ["shape", "packing", "seed", "variables", "confining_pressure_Pa", "grains",
          "normal_stiffness_N_per_m", "time_step_s", "axial_strain_rate_per_s", "inertial_number",
          "void_ratio_prepared", "void_ratio_start", "contacts_per_grain_end", "overlap_mean_over_d",
          "overlap_max_over_d", "cpu_s"]
ATTRIBUTES = ["shape", "packing", "aspect_ratio", "seed", "variables", "radius_m", "height_m", "grains",
              "grain_volume_m3", "porosity", "void_ratio", "porosity_core", "solid_above_height_fraction",
              "normal_stiffness_N_per_m", "time_step_s", "overlap_mean_over_d", "overlap_mean_over_d_end",
              "overlap_max_over_d", "settlement_m", "cpu_s_deposit", "cpu_s_settle", "cpu_s_collapse",
              "undisturbed_fraction_0.1d", "undisturbed_fraction_0.5d", "undisturbed_fraction_1d"]
# Letters are extents that must agree: t frames, r rings, e energies, o overlaps, z slabs, i and j cells.
DATASETS = {
    "time": "t", "height/highest": "t", "height/surface": "t",
    "front/one_grain": "t", "front/cluster": "t", "front/mass95": "t", "front/mass99": "t",
    "outline/radius": "r", "outline/height": "tr", "outline/thickness": "tr",
    "energy/time": "e", "energy/kinetic": "e", "energy/rotational": "e", "energy/potential": "e",
    "overlap/time": "o", "overlap/mean": "o", "overlap/max": "o",
    "porosity/z": "z", "porosity/cut": "z", "porosity/cut_core": "z",
    "porosity/start": "z", "porosity/start_core": "z",
    "displacement/r": "i", "displacement/z": "j", "displacement/count": "ji", "displacement/u": "ji",
    "displacement/u_r": "ji", "displacement/u_z": "ji", "displacement/undisturbed_0.1d": "ji",
    "displacement/undisturbed_0.5d": "ji", "displacement/undisturbed_1d": "ji", "displacement/final_u": "jr",
}
MAY_BE_EMPTY = "displacement/"  # a cell without grains has no mean: NaN


def check_triaxial(path):
    lines = open(path).read().splitlines()
    header = dict(l[2:].split(": ", 1) for l in lines if l.startswith("# "))
    yield from (f"header '{k}' is missing" for k in HEADER if k not in header)
    body = [l for l in lines if not l.startswith("#")]
    if body[0].split(",") != COLUMNS:
        yield f"columns {body[0]}, expected {','.join(COLUMNS)}"
        return
    table = dict(zip(COLUMNS, np.loadtxt(body[1:], delimiter=",", ndmin=2).T))
    yield from (f"column {k} is not finite" for k, v in table.items() if not np.isfinite(v).all())
    if (np.diff(table["axial_strain"]) <= 0).any():
        yield "axial strain does not grow"
    if float(header["inertial_number"]) >= 1e-3:
        yield "inertial number above 1e-3"
    e0, e = float(header["void_ratio_start"]), table["void_ratio"]
    if np.abs((1 + e0) * np.exp(-table["volumetric_strain"]) - 1 - e).max() > 1e-4:
        yield "void ratio and volumetric strain do not agree"


def check_column(path):
    with h5py.File(path) as f:
        yield from (f"attribute '{k}' is missing" for k in ATTRIBUTES if k not in f.attrs)
        extents = {}
        for name, letters in DATASETS.items():
            if name not in f:
                yield f"dataset '{name}' is missing"
                continue
            data = f[name]
            agree = [extents.setdefault(l, n) == n for l, n in zip(letters, data.shape)]
            if data.ndim != len(letters) or not all(agree):
                yield f"dataset '{name}' has shape {data.shape}, expected {letters} with {extents}"
            if "unit" not in data.attrs:
                yield f"dataset '{name}' has no unit"
            if not name.startswith(MAY_BE_EMPTY) and not np.isfinite(data[:]).all():
                yield f"dataset '{name}' is not finite"
        if "time" in f and (np.diff(f["time"][:]) <= 0).any():
            yield "time does not grow"


def main():
    faults = 0
    for path in sys.argv[1:]:
        for fault in (check_column if path.endswith(".h5") else check_triaxial)(path):
            print(f"{path}: {fault}", file=sys.stderr)
            faults += 1
    print(f"{len(sys.argv) - 1} files, {faults} faults")
    return 1 if faults or len(sys.argv) == 1 else 0


if __name__ == "__main__":
    sys.exit(main())
