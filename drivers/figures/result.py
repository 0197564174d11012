# SPDX-License-Identifier: BSD-3-Clause
"""Reads a result file (schema: host/OUTPUT.md) as numpy arrays in SI units."""
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
        if self.dimension != 2:
            raise ValueError(f"{self.dimension} dimensions: only results of 2 can be drawn")
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
        return "r" if self.geometry == "axisymmetric" else "x"

    @property
    def final(self):
        return self.snapshots[-1]

    def displacement(self):
        """Length of the displacement of each particle at the last snapshot, m."""
        return np.linalg.norm(self.final["position"] - self.initial_position, axis=1)
