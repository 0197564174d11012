#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Cuts a deposit: keeps the grains whose centre lies below the height.

    cut.py SPHERES_PER_GRAIN HEIGHT_M DEPOSIT OUT

Reads DEPOSIT.data and, for clumps, DEPOSIT.restart.rigid; writes OUT.data and OUT.rigid, at rest.
"""
import sys

import numpy as np

MARGIN = 0.01  # m, of the box around the column


def read_atoms(path):
    """id, x, y, z, diameter, density, grain of every sphere of a LAMMPS data file, sorted by id."""
    text = open(path).read()
    body = text[text.index("\nAtoms"):]
    body = body[body.index("\n\n") + 2:]
    body = body[:body.find("\n\n")]
    rows = np.array([line.split()[:8] for line in body.splitlines()], float)
    return rows[np.argsort(rows[:, 0])][:, [0, 2, 3, 4, 5, 6, 7]]


def read_bodies(path, n):
    """The lines of LAMMPS's rigid-body file by grain number."""
    rows = [l.split() for l in open(path) if l.strip() and not l.startswith("#")]
    bodies = {int(r[0]): r[1:] for r in rows[1:]}
    if len(bodies) != n:
        raise SystemExit(f"{path}: {len(bodies)} bodies, {n} expected")
    return bodies


def main():
    spheres, height, deposit, out = int(sys.argv[1]), float(sys.argv[2]), sys.argv[3], sys.argv[4]
    atoms = read_atoms(deposit + ".data").reshape(-1, spheres, 7)
    centres = atoms[:, :, 1:4].mean(1)  # the grains are symmetric: also the centre of the union
    if (centres[:, 2].max()) < height:
        raise SystemExit(f"the deposit ends below {height} m: pour more grains")
    keep = np.flatnonzero(centres[:, 2] < height)
    with open(out + ".data", "w") as f:
        f.write(f"column\n\n{len(keep) * spheres} atoms\n1 atom types\n\n")
        side = 0.05 + MARGIN
        f.write(f"{-side} {side} xlo xhi\n{-side} {side} ylo yhi\n{-MARGIN} {height + MARGIN} zlo zhi\n")
        f.write("\nAtoms # hybrid\n\n")
        for i, k in enumerate(keep):
            for s in range(spheres):
                _, x, y, z, diameter, density, _ = atoms[k, s]
                f.write("%d 1 %.12g %.12g %.12g %.12g %.12g %d\n"
                        % (i * spheres + s + 1, x, y, z, diameter, density, i + 1))
    if spheres > 1:
        bodies = read_bodies(deposit + ".restart.rigid", len(atoms))
        with open(out + ".rigid", "w") as f:
            f.write(f"{len(keep)}\n")
            for i, k in enumerate(keep):
                mass_centre_inertia = " ".join(bodies[int(atoms[k, 0, 6])][:10])
                f.write(f"{i + 1} {mass_centre_inertia} 0 0 0 0 0 0 0 0 0\n")
    print(f"CUT grains {len(keep)} poured {len(atoms)} height {height}")


if __name__ == "__main__":
    main()
