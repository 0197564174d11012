# SPDX-License-Identifier: BSD-3-Clause
"""Geometry of many spheres: pairs, connected clusters, and the volume that their union fills."""
import numpy as np


def close_pairs(points, reach):
    """Index pairs (i, j), i and j at most `reach` apart, each pair once; by cells of that size."""
    cell = np.floor((points - points.min(0)) / reach).astype(np.int64) + 1
    size = cell.max(0) + 2
    key = (cell[:, 0] * size[1] + cell[:, 1]) * size[2] + cell[:, 2]
    order = np.argsort(key, kind="stable")
    sorted_key = key[order]
    found = []
    offsets = [o for o in np.ndindex(3, 3, 3) if o >= (1, 1, 1)]  # a half of the neighbours, and itself
    for a, b, c in np.array(offsets) - 1:
        other = sorted_key + (a * size[1] + b) * size[2] + c
        first, last = np.searchsorted(sorted_key, other), np.searchsorted(sorted_key, other, "right")
        count = last - first
        i = np.repeat(np.arange(len(points)), count)
        j = np.arange(count.sum()) - np.repeat(count.cumsum() - count, count) + np.repeat(first, count)
        if a == b == c == 0:
            i, j = i[i < j], j[i < j]
        i, j = order[i], order[j]
        near = ((points[i] - points[j]) ** 2).sum(1) <= reach**2
        found.append(np.column_stack([i[near], j[near]]))
    return np.concatenate(found)


def largest_cluster(n, pairs):
    """Mask of the members of the largest connected cluster: the smallest number spreads along pairs."""
    label = np.arange(n)
    i, j = pairs.T
    while True:
        smallest = np.minimum(label[i], label[j])
        new = label.copy()
        np.minimum.at(new, label[i], smallest)
        np.minimum.at(new, label[j], smallest)
        new = new[new]
        if (new == label).all():
            return label == np.bincount(label).argmax()
        label = new


def filled_cells(points, radius, low, counts, step):
    """Which cubic cells of a grid have their centre inside a sphere."""
    filled = np.zeros(counts, bool)
    base = np.floor((points - low) / step).astype(int)
    span = np.arange(-int(np.ceil(radius / step)), int(np.ceil(radius / step)) + 1)
    for o in np.stack(np.meshgrid(span, span, span), -1).reshape(-1, 3):
        cell = base + o
        inside = (((low + (cell + 0.5) * step - points) ** 2).sum(1) < radius**2)
        inside &= (cell >= 0).all(1) & (cell < counts).all(1)
        filled[tuple(cell[inside].T)] = True
    return filled
