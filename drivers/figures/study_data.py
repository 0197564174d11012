# SPDX-License-Identifier: BSD-3-Clause
"""What the study of the 24 columns compares: runs, discrete elements, laboratory laws. SI units."""
import csv
import pathlib

import h5py
import numpy as np

from result import Result

SHAPES, PACKINGS, ASPECTS = ("SS", "TS", "ES"), ("dense", "loose"), (0.5, 1.0, 2.0, 4.0)


class Run:
    """One column by SPH: numbers at once, fields when asked for."""

    def __init__(self, folder):
        shape, self.packing, aspect = folder.name.split("_")
        self.shape, self.aspect = shape.upper(), float(aspect[1:])
        self.result = Result(folder / "result.h5")
        summary = self.result.file["summary"]
        self.summary = {name: float(summary[name][()]) for name in summary}
        self.height, self.runout = self.summary["final_height"], self.summary["runout"]
        self.rest = self.summary["time_to_rest"]
        scene = self.result.scene
        self.r0, self.h0 = scene["column"]["radius"], scene["column"]["height"]
        self.void_ratio = scene["material"]["void_ratio"]
        self.grain = scene["output"]["grain_diameter"]
        masses = self.result.file["particles/mass"][()]
        still = self.result.displacement() < 0.5 * self.grain
        self.undisturbed = masses[still].sum() / masses.sum()

    @property
    def key(self):
        return self.shape, self.packing, self.aspect


class Dem:
    """One column by discrete elements (schema: data/dem/README.md)."""

    def __init__(self, path, row):
        self.file = h5py.File(path, "r")
        self.height, self.runout = float(row["h_surface_over_r0"]), float(row["runout_one_grain"])
        self.undisturbed, self.seconds = float(row["undisturbed_fraction_0.5d"]), float(row["cpu_s"])

    def __getitem__(self, name):
        return self.file[name][()]


def read_runs(folder):
    """Runs of a set by (shape, packing, aspect ratio); only complete ones."""
    runs = {}
    for path in sorted(pathlib.Path(folder).glob("*/result.h5")):
        run = Run(path.parent)
        if run.result.complete:
            runs[run.key] = run
    return runs


def read_dem(data):
    """Discrete elements of the main set: first seed, nothing varied."""
    folder = pathlib.Path(data) / "dem/results"
    columns = {}
    with open(folder / "columns.csv", encoding="utf-8") as table:
        for row in csv.DictReader(table):
            path = folder / f"{row['case']}.h5"
            if row["seed"] == "1" and row["variables"] == "none" and path.exists():
                columns[row["shape"], row["packing"], float(row["aspect_ratio"])] = Dem(path, row)
    return columns


def read_laws(data, flow="axisymmetric"):
    """Laws of a flow: (source, quantity, note) -> list of (a_min, a_max, coefficient, exponent)."""
    laws = {}
    with open(pathlib.Path(data) / "experiments/laws.csv", encoding="utf-8") as table:
        for row in csv.DictReader(line for line in table if not line.startswith("#")):
            if row["flow"] == flow and row["coefficient"]:
                reading = row["note"].split(";")[0] if "reading" in row["note"] else ""
                laws.setdefault((row["source"], row["quantity"], reading), []).append(
                    tuple(float(row[k]) for k in ("a_min", "a_max", "coefficient", "exponent")))
    return laws


def law_value(pieces, a):
    """Value of a law at aspect ratio a, nan where it says nothing."""
    for low, high, coefficient, exponent in pieces:
        if low <= a < high:
            return coefficient * a**exponent
    return np.nan


def deviation(run, dem):
    """Relative error of final height and final radius against discrete elements of the same grains."""
    return run.height / dem.height - 1, (1 + run.runout) / (1 + dem.runout) - 1


def outline_distance(run, dem):
    """Area between the final outlines over the area of the initial half section."""
    r = run.result.radii
    ours = run.result.final["outline"]
    theirs = np.interp(r, dem["outline/radius"], dem["outline/height"][-1], right=0.0)
    return np.trapezoid(np.abs(ours - theirs), r) / (run.r0 * run.h0) if hasattr(np, "trapezoid") else \
        np.trapz(np.abs(ours - theirs), r) / (run.r0 * run.h0)
