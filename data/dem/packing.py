#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes dilute starting packings for LAMMPS: grains at random places and orientations.

    packing.py column SHAPE GRAINS SEED OUT   in the cylinder, radius 50 mm, from the plate up
    packing.py cell   SHAPE GRAINS SEED OUT   in a periodic box

Writes OUT.data (spheres, atom style hybrid sphere bond; the molecule number is the grain) and, for
shapes of several spheres, OUT.rigid (mass, centre and inertia of every grain, for `infile` of
fix rigid/small).
"""
import sys

import numpy as np

from grains import MASS, grain

RADIUS = 0.05  # m, of the cylinder
HALF_WIDTH = 0.06  # m, of the column's box while pouring: the cylinder and a margin
FILLING = 0.25  # volume of the circumscribed spheres over that of the room for their centres


def random_rotations(rng, n):
    """Uniform in orientation: from normalised Gaussian quaternions."""
    w, x, y, z = (q := rng.normal(size=(4, n))) / np.linalg.norm(q, axis=0)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]).transpose(2, 0, 1)


def scatter(rng, n, reach, draw):
    """Random sequential addition: points from `draw()`, each kept if farther than 2 reach from all
    before it."""
    size = 2 * reach
    buckets, points = {}, []
    offsets = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    while len(points) < n:
        p = draw(rng)
        cell = tuple(int(c // size) for c in p)
        near = (q for o in offsets for q in buckets.get((cell[0] + o[0], cell[1] + o[1], cell[2] + o[2]), ()))
        if all((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2 > size**2 for q in near):
            buckets.setdefault(cell, []).append(p)
            points.append(p)
    return np.array(points)


def in_column(g, n, rng):
    """n grains in the cylinder, clear of the wall, the plate and each other."""
    inside = RADIUS - g.reach
    height = n * 4 / 3 * g.reach**3 / (FILLING * inside**2) + 2 * g.reach

    def draw(rng):
        while True:
            x, y = rng.uniform(-inside, inside, 2)
            if x * x + y * y < inside * inside:
                return x, y, rng.uniform(g.reach, height - g.reach)

    box = [(-HALF_WIDTH, HALF_WIDTH), (-HALF_WIDTH, HALF_WIDTH), (-0.005, height + 0.01)]
    return scatter(rng, n, g.reach, draw), box


def in_cell(g, n, rng, slenderness=1.7):
    """n grains in a box `slenderness` times as high as wide, which becomes periodic: no centre is
    closer than its reach to a face."""
    free = (n * 4 / 3 * np.pi * g.reach**3 / FILLING / slenderness) ** (1 / 3)
    sides = np.array([free, free, free * slenderness])
    points = scatter(rng, n, g.reach, lambda rng: tuple(rng.uniform(0, sides)))
    return points + g.reach, [(0.0, s + 2 * g.reach) for s in sides]


def write_packing(out, g, centres, box, rng, speed):
    """Every grain gets a random orientation and a random velocity, each component below `speed`."""
    n, spheres = len(centres), len(g.centres)
    rotations = random_rotations(rng, n)
    velocities = rng.uniform(-speed, speed, (n, 3))
    velocities -= velocities.mean(0)
    positions = centres[:, None, :] + np.einsum("nij,sj->nsi", rotations, g.centres)
    write_spheres(out + ".data", g, positions, box, velocities)
    if spheres > 1:
        inertia = np.einsum("nij,j,nkj->nik", rotations, g.inertia, rotations)
        write_bodies(out + ".rigid", centres, inertia, velocities)


def write_spheres(path, g, positions, box, velocities):
    n, spheres = positions.shape[:2]
    with open(path, "w") as f:
        f.write(f"grains\n\n{n * spheres} atoms\n1 atom types\n\n")
        for (low, high), axis in zip(box, "xyz"):
            f.write(f"{low:.9g} {high:.9g} {axis}lo {axis}hi\n")
        f.write("\nAtoms # hybrid\n\n")
        for i in range(n):
            for s in range(spheres):
                x, y, z = positions[i, s]
                f.write(f"{i * spheres + s + 1} 1 {x:.12g} {y:.12g} {z:.12g} {2 * g.radius:.12g} "
                        f"{g.sphere_density:.12g} {i + 1}\n")
        f.write("\nVelocities\n\n")
        for i in range(n):
            for s in range(spheres):
                f.write("%d %.9g %.9g %.9g 0 0 0\n" % (i * spheres + s + 1, *velocities[i]))


def write_bodies(path, centres, inertia, velocities):
    """LAMMPS's order: number, mass, centre, xx yy zz xy xz yz, velocity, angular momentum, image."""
    with open(path, "w") as f:
        f.write(f"{len(centres)}\n")
        for i, (c, j, v) in enumerate(zip(centres, inertia, velocities)):
            f.write("%d %.12g %.12g %.12g %.12g " % (i + 1, MASS, *c))
            f.write("%.9g %.9g %.9g %.9g %.9g %.9g " % (j[0, 0], j[1, 1], j[2, 2], j[0, 1], j[0, 2], j[1, 2]))
            f.write("%.9g %.9g %.9g 0 0 0 0 0 0\n" % tuple(v))


def main():
    kind, shape, grains, seed, out = sys.argv[1:]
    g, rng = grain(shape), np.random.default_rng(int(seed))
    place = {"column": in_column, "cell": in_cell}[kind]
    centres, box = place(g, int(grains), rng)
    write_packing(out, g, centres, box, rng, speed=0.2)


if __name__ == "__main__":
    main()
