# SPDX-License-Identifier: BSD-3-Clause
"""What the study of the 24 columns compares: runs, discrete elements, laboratory laws. SI units."""
import pathlib

import h5py
import numpy as np

from figures.result import Result, text
from figures.table import read_rows

SHAPES, PACKINGS, ASPECTS = ("SS", "TS", "ES"), ("dense", "loose"), (0.5, 1.0, 2.0, 4.0)
LAW_WORDS = ("flow", "source", "quantity", "sure", "note")  # columns of laws.csv that are no numbers
STILL = 0.5  # grains: what moved less is undisturbed


def fallen(time, height, share):
    """Time at which the height has made this share of its whole fall; nan where it does not fall by a percent."""
    fall = height[0] - height[-1]
    if fall < 0.01 * height[0]:
        return np.nan
    done = (height[0] - height) / fall
    last = np.flatnonzero(done < share)[-1]  # what follows stays beyond
    if last + 1 == len(time):
        return time[-1]
    part = (share - done[last]) / (done[last + 1] - done[last])
    return time[last] + part * (time[last + 1] - time[last])


def mean_top(result, r0):
    """Mean height of the final outline within 3 r0/17 of the axis, over r0: what the height of discrete elements is."""
    edges = np.linspace(0, 3 * r0 / 17, 61)
    r = 0.5 * (edges[1:] + edges[:-1])
    return float(np.average(np.interp(r, result.radii, result.final["outline"]), weights=r) / r0)


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
        self.top = mean_top(self.result, self.r0)
        self.void_ratio = scene["material"]["void_ratio"]
        self.grain, self.spacing = scene["output"]["grain_diameter"], scene["scene"]["spacing"]
        self.time, self.heights = self.result.series["time"], self.result.series["height"]
        measured = folder / "cpu_seconds"
        self.seconds = float(measured.read_text()) if measured.exists() else self.summary["wall_clock"]

    @property
    def key(self):
        return self.shape, self.packing, self.aspect

    def mass_radius(self, share):
        """Radius with a share of the mass inside, over r0, at the end."""
        r, masses = np.abs(self.result.final["position"][:, 0]), self.result.file["particles/mass"][()]
        order = np.argsort(r)
        inside = np.cumsum(masses[order]) / masses.sum()
        return float(r[order][np.searchsorted(inside, share)] / self.r0)

    def zone(self):
        """Undisturbed zone of the initial column: levels, and the radius of a disc with the area that stays."""
        start, still = self.result.initial_position, self.result.displacement() < STILL * self.grain
        level = np.round(start[:, 1], 9)
        z, row = np.unique(level, return_inverse=True)
        masses = self.result.file["particles/mass"][()]
        share = np.bincount(row, weights=masses * still) / np.bincount(row, weights=masses)
        return z, self.r0 * np.sqrt(share)


class Dem:
    """One column by discrete elements (schema: data/dem/README.md)."""

    def __init__(self, path):
        self.file = h5py.File(path, "r")
        a = self.file.attrs
        self.shape, self.packing = text(a["shape"]), text(a["packing"])
        self.aspect, self.r0, self.h0 = float(a["aspect_ratio"]), float(a["radius_m"]), float(a["height_m"])
        self.seed, self.variables, self.void_ratio = int(a["seed"]), text(a["variables"]), float(a["void_ratio"])
        self.time, self.heights = self["time"], self["height/surface"]
        self.fronts = self["front/one_grain"]
        self.height = self.top = self.heights[-1] / self.r0
        self.runout = self.fronts[-1] / self.r0 - 1
        self.mass95 = self["front/mass95"][-1] / self.r0
        self.undisturbed = float(a["undisturbed_fraction_0.5d"])
        self.collapse_seconds = float(a["cpu_s_collapse"])
        self.seconds = self.collapse_seconds + float(a["cpu_s_deposit"]) + float(a["cpu_s_settle"])

    def __getitem__(self, name):
        return self.file[name][()]

    @property
    def key(self):
        return self.shape, self.packing, self.aspect

    def zone(self):
        """As Run.zone."""
        grains, share = self["displacement/count"], self["displacement/undisturbed_0.5d"]
        still = np.nansum(grains * np.nan_to_num(share), axis=1) / grains.sum(axis=1)
        return self["displacement/z"], self.r0 * np.sqrt(still)


def undisturbed(body):
    """Share of the column that moved less than half a grain."""
    z, radius = body.zone()
    return float(np.mean(radius**2) / body.r0**2)


def read_runs(folder):
    """Runs below FOLDER/SPACINGmm/SET/COLUMN: (set, spacing in mm) -> (shape, packing, aspect ratio) -> run; only
    complete ones."""
    runs = {}
    for path in sorted(pathlib.Path(folder).glob("*mm/*/*_a*/result.h5")):
        try:
            run = Run(path.parent)
        except (OSError, ValueError, KeyError):  # being written
            continue
        if run.result.complete:
            of_set = runs.setdefault((path.parts[-3], float(path.parts[-4][:-2])), {})
            of_set[run.key] = run
    return runs


def finest(runs, name):
    """Spacing in mm and runs of a set at the finest spacing that has as many columns as any; (nan, {}) if none."""
    found = {spacing: columns for (of_set, spacing), columns in runs.items() if of_set == name}
    if not found:
        return np.nan, {}
    most = max(len(columns) for columns in found.values())
    spacing = min(s for s, columns in found.items() if len(columns) == most)
    return spacing, found[spacing]


def read_dem(data, variables="none"):
    """Discrete elements of the main set: first seed, nothing varied; or of a variant."""
    columns = {}
    for path in sorted((pathlib.Path(data) / "dem/results").glob("column_*.h5")):
        column = Dem(path)
        if column.seed == 1 and column.variables == variables:
            columns[column.key] = column
    return columns


def read_laws(data, flow="axisymmetric"):
    """Laws of a flow: (source, quantity, note) -> list of (a_min, a_max, coefficient, exponent)."""
    laws = {}
    for row in read_rows(pathlib.Path(data) / "experiments/laws.csv", LAW_WORDS):
        if row["flow"] == flow and np.isfinite(row["coefficient"]):
            reading = row["note"].split(";")[0] if "reading" in row["note"] else ""
            laws.setdefault((row["source"], row["quantity"], reading), []).append(
                tuple(row[k] for k in ("a_min", "a_max", "coefficient", "exponent")))
    return laws


def law_value(pieces, a):
    """Value of a law at aspect ratio a, nan where it says nothing."""
    for low, high, coefficient, exponent in pieces:
        if low <= a < high:
            return coefficient * a**exponent
    return np.nan


def deviation(run, dem):
    """Relative error of final height (of both the mean near the axis) and final radius against discrete elements of the
    same grains."""
    return run.top / dem.height - 1, (1 + run.runout) / (1 + dem.runout) - 1


def farthest(bodies):
    """Largest front, m; beyond the sampled radii it is not known and counts as five radii."""
    return max(body.r0 * (1 + body.runout if np.isfinite(body.runout) else 4) for body in bodies)


def outline_distance(run, dem):
    """Area between the final outlines over the area of the initial half section."""
    r = run.result.radii
    theirs = np.interp(r, dem["outline/radius"], dem["outline/height"][-1], right=0.0)
    difference = np.abs(run.result.final["outline"] - theirs)
    return float(np.sum(0.5 * (difference[1:] + difference[:-1]) * np.diff(r)) / (run.r0 * run.h0))
