# SPDX-License-Identifier: BSD-3-Clause
"""Particles and outlines in pictures."""
import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.tri import Triangulation

from figures.style import MM, ORANGE


def surface(r, height):
    """The outline up to where it first meets the floor."""
    dry = np.flatnonzero(height <= 0)
    end = dry[0] + 1 if dry.size else len(r)
    return MM * r[:end], MM * height[:end]


def particles(ax, position, values, spacing, cmap, low, high):
    """Discs of one spacing at the positions, in the units of the axes."""
    discs = EllipseCollection(np.full(len(values), spacing), np.full(len(values), spacing), np.zeros(len(values)),
                              units="xy", offsets=position, transOffset=ax.transData, cmap=cmap, lw=0)
    discs.set_array(values)
    discs.set_clim(low, high)
    ax.add_collection(discs)
    return discs


def level_line(ax, position, values, level, longest):
    """Contour of a particle quantity; triangles with sides over `longest` bridge gaps and are left out."""
    mesh = Triangulation(position[:, 0], position[:, 1])
    corners = position[mesh.triangles]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    mesh.set_mask(sides.max(axis=1) > longest)
    ax.tricontour(mesh, values, levels=[level], colors="white", linewidths=3.2)
    ax.tricontour(mesh, values, levels=[level], colors=ORANGE, linewidths=1.8)
