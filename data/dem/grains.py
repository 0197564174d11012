#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The three grains: spheres that overlap, all of one volume and density.

A grain is an array of sphere centres about its centre of mass, one common sphere radius, and the
mass and inertia of the union of the spheres (not of their sum: for the tetrahedron the sum has
twice the volume).  Run as a script, it prints the properties and the error of their integration.
"""
import os
from dataclasses import dataclass

import numpy as np

VOLUME = 13.455e-9  # m3, of the union
DENSITY = 2500.0  # kg/m3
DIAMETER = (6 * VOLUME / np.pi) ** (1 / 3)  # m, of the sphere of equal volume: 2.951 mm
MASS = DENSITY * VOLUME  # kg

# Distances of neighbouring centres over the radius of the spheres.
TETRAHEDRON_EDGE = float(os.environ.get("DEM_TETRAHEDRON_EDGE", 1.2))
ELONGATED_SPACING = float(os.environ.get("DEM_ELONGATED_SPACING", 0.75))  # three in a row


@dataclass
class Grain:
    centres: np.ndarray  # (n, 3) m, about the centre of mass, principal axes
    radius: float  # m, of every sphere
    inertia: np.ndarray  # (3,) kg m2, principal

    @property
    def reach(self):
        """Radius of the circumscribed sphere."""
        return np.linalg.norm(self.centres, axis=1).max() + self.radius

    @property
    def sphere_density(self):
        """Density that LAMMPS shall give each sphere so that their masses add up to the grain's."""
        return MASS / (len(self.centres) * 4 / 3 * np.pi * self.radius**3)


def unit_centres(shape):
    """Sphere centres for spheres of radius 1."""
    if shape == "SS":
        return np.zeros((1, 3))
    if shape == "TS":
        corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
        return corners * TETRAHEDRON_EDGE / np.sqrt(8)
    if shape == "ES":
        return np.array([[0, 0, -1], [0, 0, 0], [0, 0, 1]], float) * ELONGATED_SPACING
    raise SystemExit(f"grain shape '{shape}': SS, TS or ES expected")


def integrate_union(centres, cells):
    """Volume, centre and second moments <y2+z2>, <x2+z2>, <x2+y2> of the union of unit spheres,
    by the midpoint rule on cubes, `cells` of them along the longest side."""
    low, high = centres.min(0) - 1, centres.max(0) + 1
    step = (high - low).max() / cells
    axes = [np.arange(a + step / 2, b, step) for a, b in zip(low, high)]
    moments = np.zeros(7)  # count, x, y, z, x2, y2, z2
    y, z = np.meshgrid(axes[1], axes[2], indexing="ij")
    for x in axes[0]:  # slice by slice: little memory
        inside = np.zeros(y.shape, bool)
        for c in centres:
            inside |= (x - c[0]) ** 2 + (y - c[1]) ** 2 + (z - c[2]) ** 2 < 1
        n, yi, zi = inside.sum(), y[inside], z[inside]
        moments += [n, n * x, yi.sum(), zi.sum(), n * x * x, (yi**2).sum(), (zi**2).sum()]
    volume, centre = moments[0] * step**3, moments[1:4] / moments[0]
    second = moments[4:] / moments[0] - centre**2
    return volume, centre, second.sum() - second


def grain(shape, cells=200):
    centres = unit_centres(shape)
    if shape == "SS":
        volume, centre, second = 4 / 3 * np.pi, np.zeros(3), np.full(3, 0.4)
    else:
        volume, centre, second = integrate_union(centres, cells)
    radius = (VOLUME / volume) ** (1 / 3)
    return Grain((centres - centre) * radius, radius, MASS * second * radius**2)


def main():
    print(f"volume {VOLUME * 1e9:.3f} mm3, mass {MASS * 1e6:.4f} mg, equal sphere {DIAMETER * 1e3:.4f} mm")
    for shape in ("SS", "TS", "ES"):
        g, coarse = grain(shape), grain(shape, 100)
        extent = (np.ptp(g.centres, axis=0) + 2 * g.radius) * 1e3
        naive = len(g.centres) * 4 / 3 * np.pi * g.radius**3 / VOLUME
        error = np.abs(coarse.inertia / g.inertia - 1).max()
        print(f"{shape}: {len(g.centres)} spheres of radius {g.radius * 1e3:.4f} mm "
              f"(coarser grid: {coarse.radius / g.radius - 1:+.0e}), extent {extent.round(3)} mm, reach "
              f"{g.reach * 1e3:.3f} mm, inertia / mass {(g.inertia / MASS * 1e6).round(4)} mm2 "
              f"(coarser grid: {error:.0e}), sum of spheres / union {naive:.3f}")


if __name__ == "__main__":
    main()
