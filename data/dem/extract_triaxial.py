#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""LAMMPS's output of a triaxial test -> the curve as CSV.  extract_triaxial.py WORK OUT.csv"""
import pathlib
import sys

import numpy as np

from grains import DIAMETER, grain

COLUMNS = ["axial_strain", "axial_strain_engineering", "volumetric_strain", "p_Pa", "q_Pa",
           "void_ratio", "sigma_axial_Pa", "sigma_radial_Pa", "kinetic_energy_J"]


def words_after(log, key):
    """The words of the log's line that starts with `key`, as a dictionary of pairs."""
    line = next(l for l in reversed(log.splitlines()) if l.startswith(key))
    words = line.split()[1:]
    return dict(zip(words[::2], words[1::2]))


def sphere_diameter(shape):
    return 2 * grain(shape).radius


def main():
    work, out = pathlib.Path(sys.argv[1]), sys.argv[2]
    case = dict(l.split(maxsplit=1) for l in (work / "case").read_text().splitlines())
    log = (work / "shear.log").read_text()
    prepared, shear = words_after(log, "PREPARED"), words_after(log, "SHEAR")
    _, axial, volumetric, s_axial, s_radial, void_ratio, kinetic = np.loadtxt(work / "test.curve").T
    _, f_axial, touches, distance, nearest = np.loadtxt(work / "test.fabric", ndmin=2).T
    overlap = (sphere_diameter(case["shape"]) - np.array([distance, nearest])) / DIAMETER
    grains, pressure = int(float(shear["grains"])), 1000 * float(case["value"])
    rate = float(shear["rate"])
    header = {
        **{k: case[k] for k in ("shape", "packing", "seed", "variables")},
        "confining_pressure_Pa": f"{pressure:.0f}",
        "grains": grains,
        "normal_stiffness_N_per_m": shear["kn"],
        "time_step_s": shear["timestep"],
        "axial_strain_rate_per_s": shear["rate"],
        "inertial_number": f"{rate * DIAMETER * np.sqrt(2500 / pressure):.3g}",
        "void_ratio_prepared": prepared["void_ratio"],
        "void_ratio_start": shear["void_ratio"],
        "contacts_per_grain_end": f"{touches[-1] / grains:.2f}",
        "overlap_mean_over_d": f"{overlap[0].mean():.2e}",
        "overlap_max_over_d": f"{overlap[1].max():.2e}",
        "cpu_s": f"{sum(float(t) for t in (work / 'shear.cpu').read_text().split()):.3f}",  # of all attempts
    }
    p, q = (s_axial + 2 * s_radial) / 3, s_axial - s_radial
    table = np.column_stack([axial, 1 - np.exp(-axial), volumetric, p, q,
                             void_ratio, s_axial, s_radial, kinetic])
    with open(out, "w") as f:
        f.writelines(f"# {k}: {v}\n" for k, v in header.items())
        f.write(",".join(COLUMNS) + "\n")
        np.savetxt(f, table, fmt="%.6g", delimiter=",")


if __name__ == "__main__":
    main()
