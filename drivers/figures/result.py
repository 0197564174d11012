# SPDX-License-Identifier: BSD-3-Clause
"""Reads a result file (schema: host/files/OUTPUT.md) as numpy arrays in SI units."""
import tomllib

import h5py
import numpy as np


def text(attribute):
    return attribute.decode() if isinstance(attribute, bytes) else str(attribute)


class Snapshot:
    """One time: fields are read when asked for."""

    def __init__(self, group):
        self.group = group
        self.time = float(group.attrs["time"])

    def has(self, name):
        return name in self.group

    def __getitem__(self, name):
        return self.group[name][()]


class Result:
    def __init__(self, path):
        self.file = h5py.File(path, "r")
        version = self.file.attrs.get("format_version")
        if version != 1:
            raise ValueError(f"format version {version}, this program reads 1")
        self.geometry = text(self.file.attrs["geometry"])
        self.dimension = int(self.file.attrs["dimension"])
        self.complete = bool(self.file.attrs["complete"])
        self.scene = tomllib.loads(self.file["scene"].asstr()[()])
        self.initial_position = self.file["particles/initial_position"][()]
        groups = [g for _, g in sorted(self.file["snapshots"].items())]
        self.snapshots = [Snapshot(g) for g in groups if "time" in g.attrs]
        if not self.snapshots:
            raise ValueError("no snapshot in the file")
        self.radii = self.file["outline/r"][()] if "r" in self.file["outline"] else np.empty(0)
        columns = {name: d[()] for name, d in self.file["series"].items()}
        rows = min((len(c) for c in columns.values()), default=0)
        self.series = {name: c[:rows] for name, c in columns.items()}

    def scene_value(self, table, key):
        value = self.scene.get(table, {}).get(key)
        if value is None:
            raise ValueError(f"the stored scene has no {table}.{key}")
        return value

    @property
    def horizontal(self):
        """Symbol of the horizontal coordinate."""
        return "x" if self.geometry == "plane_strain" else "r"

    @property
    def final(self):
        return self.snapshots[-1]

    def in_plane(self, position):
        """Horizontal coordinate (three dimensions: distance from the axis) and height of each particle."""
        if self.dimension == 2:
            return position
        return np.column_stack([np.hypot(position[:, 0], position[:, 1]), position[:, 2]])

    def azimuthal_mean(self, values):
        """Places in the plane at the last snapshot and one value for each. In three dimensions the means over the
        azimuth: over all particles of a ring of the size of a spacing."""
        places = self.in_plane(self.final["position"])
        if self.dimension == 2:
            return places, values
        cells = np.floor(places / self.scene_value("scene", "spacing")).astype(int)
        _, ring, count = np.unique(cells, axis=0, return_inverse=True, return_counts=True)
        mean = lambda quantity: np.bincount(ring.ravel(), weights=quantity) / count
        return np.column_stack([mean(places[:, 0]), mean(places[:, 1])]), mean(values)

    def displacement(self):
        """Length of the displacement of each particle at the last snapshot, m."""
        return np.linalg.norm(self.final["position"] - self.initial_position, axis=1)
