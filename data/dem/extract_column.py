#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""LAMMPS's output of a collapse -> the compact HDF5 file that README.md describes.

    extract_column.py WORK OUT.h5
"""
import pathlib
import sys

import h5py
import numpy as np

from cut import read_atoms
from geometry import close_pairs, filled_cells, largest_cluster
from grains import DIAMETER, VOLUME, grain

R0 = 0.05  # m
RING = R0 / 17  # m: rings of one grain, with an edge at r0
RINGS = 102  # to 0.3 m
ONE_GRAIN = 2.95e-3  # m: the deposit ends where it is thinner
CLUSTER_GAP = 0.25 * DIAMETER  # grains closer than this are connected
UNDISTURBED = {"0.1d": 0.1, "0.5d": 0.5, "1d": 1.0}  # displacement over d
VOXEL = 0.25e-3  # m


def read_frames(work, spheres):
    """Yields (step, positions [grain, sphere, 3]).  Every start (restart) has its own file, whose
    last frame may be cut short; of a step written twice either will do."""
    where = {}
    for path in work.glob("collapse.frames.*"):
        with open(path) as f:
            while f.readline():  # ITEM: TIMESTEP
                step, _, n = f.readline(), f.readline(), f.readline()
                for _ in range(5):
                    f.readline()
                start, line = f.tell(), ""
                for _ in range(int(n or 0)):
                    line = f.readline()
                if line.endswith("\n"):
                    where[int(step)] = (path, start, int(n))
    for step, (path, start, n) in sorted(where.items()):
        with open(path) as f:
            f.seek(start)
            rows = np.fromstring("".join(f.readline() for _ in range(n)), sep=" ").reshape(n, 4)
        yield step, rows[:, 1:].reshape(-1, spheres, 3)


def read_series(work, name):
    """Rows of a LAMMPS time series: one file for every start (restart), of a repeated step one row."""
    lines = [l for p in work.glob(name + ".*") for l in open(p) if l.endswith("\n") and not l.startswith("#")]
    rows = np.loadtxt(lines, ndmin=2)
    return rows[np.unique(rows[:, 0], return_index=True)[1]][:, 1:]


def surface(points, radius):
    """Mean over the circumference of the highest grain surface, ring by ring; 0 where there is none."""
    r = np.hypot(points[:, 0], points[:, 1])
    ring = (r / RING).astype(int)
    angle = np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) + 0.5
    sectors = np.maximum(1, np.round(np.pi * (np.arange(RINGS) + 0.5))).astype(int)  # cells of about 2 d
    first = np.concatenate([[0], sectors.cumsum()])
    near = ring < RINGS
    cell = first[ring[near]] + (angle[near] * sectors[ring[near]]).astype(int) % sectors[ring[near]]
    highest = np.zeros(first[-1])
    np.maximum.at(highest, cell, points[near, 2] + radius)
    return np.add.reduceat(highest, first[:-1]) / sectors


def thickness(centres, solid_fraction):
    """Height, ring by ring, of the grains there packed as at the start."""
    r = np.hypot(centres[:, 0], centres[:, 1])
    edges = RING * np.arange(RINGS + 1)
    return np.histogram(r, edges)[0] * VOLUME / (np.pi * np.diff(edges**2)) / solid_fraction


def outermost_crossing(profile, level):
    """Radius where the profile falls below the level for the last time."""
    above = np.flatnonzero(profile >= level)
    if len(above) == 0:
        return 0.0
    k = above[-1]
    beyond = profile[k + 1] if k + 1 < len(profile) else 0.0
    return RING * (k + 0.5 + (profile[k] - level) / (profile[k] - beyond))


def cluster_front(positions, radius):
    """Mean over 72 sectors of the outermost surface of the largest connected cluster."""
    points = positions.reshape(-1, 3)
    grain_of = np.arange(len(points)) // positions.shape[1]
    pairs = grain_of[close_pairs(points, 2 * radius + CLUSTER_GAP)]
    member = largest_cluster(len(positions), np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0))
    points = points[member[grain_of]]
    sector = ((np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) + 0.5) * 72).astype(int) % 72
    front = np.zeros(72)
    np.maximum.at(front, sector, np.hypot(points[:, 0], points[:, 1]) + radius)
    return front.mean()


def solid_fraction_profile(points, radius, height, slab=2.5e-3):
    """Solid fraction of the union in horizontal slabs, over the whole section and within 40 mm."""
    cells = int(round(2 * R0 / VOXEL))
    per_slab = int(round(slab / VOXEL))
    levels = int(round(height / VOXEL)) // per_slab * per_slab
    filled = filled_cells(points, radius, np.array([-R0, -R0, 0.0]), (cells, cells, levels), VOXEL)
    x = (np.arange(cells) + 0.5) * VOXEL - R0
    r = np.hypot(*np.meshgrid(x, x))
    profile = [filled[r < limit].mean(0).reshape(-1, per_slab).mean(1) for limit in (R0, 0.8 * R0)]
    return slab * (np.arange(levels // per_slab) + 0.5), *profile


def displacement_grid(start, end, height):
    """Cell means over the grains that began in it: count, u_r, u_z, |u|, fraction undisturbed."""
    r = np.hypot(start[:, 0], start[:, 1])
    move = end - start
    size = np.linalg.norm(move, axis=1)
    u_r = np.hypot(end[:, 0], end[:, 1]) - r
    rows = int(np.ceil(height / RING))
    ring, level = np.minimum((r / RING).astype(int), 16), np.minimum((start[:, 2] / RING).astype(int), rows - 1)
    cell = ring * rows + level

    def mean(w):
        with np.errstate(invalid="ignore"):
            return (np.bincount(cell, w, 17 * rows) / count).reshape(17, rows).T

    count = np.bincount(cell, minlength=17 * rows).astype(float)
    grid = {"count": count.reshape(17, rows).T, "u_r": mean(u_r), "u_z": mean(move[:, 2]), "u": mean(size)}
    for name, limit in UNDISTURBED.items():
        grid["undisturbed_" + name] = mean((size < limit * DIAMETER).astype(float))
    return grid, size


def final_grid(end, size, rows):
    """Mean displacement of the grains that ended in a cell: the picture of the deposit."""
    ring = (np.hypot(end[:, 0], end[:, 1]) / RING).astype(int)
    level = (end[:, 2] / RING).astype(int)
    near = (ring < RINGS) & (level < rows)
    cell = ring[near] * rows + level[near]
    with np.errstate(invalid="ignore"):
        mean = np.bincount(cell, size[near], RINGS * rows) / np.bincount(cell, minlength=RINGS * rows)
    return mean.reshape(RINGS, rows).T


def words_after(path, key):
    line = next(l for l in reversed(path.read_text().splitlines()) if l.startswith(key))
    words = line.split()[1:]
    return dict(zip(words[::2], map(float, words[1::2])))


def cpu_seconds(work, stage):
    return sum(float(t) for t in (work / f"{stage}.cpu").read_text().split())


def follow(work, g, solid_fraction):
    """All that is measured frame by frame, by its name in the file; the first and the last frame."""
    series = {name: [] for name in ("time", "height/highest", "height/surface",
                                    "front/one_grain", "front/cluster", "front/mass95", "front/mass99",
                                    "outline/height", "outline/thickness")}
    first = None
    for step, positions in read_frames(work, len(g.centres)):
        first = positions if first is None else first
        points, centres = positions.reshape(-1, 3), positions.mean(1)
        outline, thick = surface(points, g.radius), thickness(centres, solid_fraction)
        inner = np.hypot(points[:, 0], points[:, 1]) < 0.4 * R0
        r = np.hypot(centres[:, 0], centres[:, 1])
        series["time"].append(step)
        series["height/highest"].append(points[inner, 2].max() + g.radius)
        series["height/surface"].append(np.average(outline[:3], weights=[1, 3, 5]))  # by area, r < 8.8 mm
        series["front/one_grain"].append(outermost_crossing(thick, ONE_GRAIN))
        series["front/cluster"].append(cluster_front(positions, g.radius))
        series["front/mass95"].append(np.quantile(r, 0.95))
        series["front/mass99"].append(np.quantile(r, 0.99))
        series["outline/height"].append(outline)
        series["outline/thickness"].append(thick)
    return series, first, positions


def main():
    work, out = pathlib.Path(sys.argv[1]), sys.argv[2]
    case = dict(l.split(maxsplit=1) for l in (work / "case").read_text().splitlines())
    g = grain(case["shape"])
    cut, run = words_after(work / "cut.log", "CUT"), words_after(work / "collapse.log", "COLLAPSED")
    height, grains = cut["height"], int(cut["grains"])
    solid = grains * VOLUME / (np.pi * R0**2 * height)
    series, first, last = follow(work, g, solid)
    series["time"] = np.array(series["time"]) * run["timestep"]

    poured = read_atoms(work / "cut.data")[:, 1:4]
    z, cut_all, cut_core = solid_fraction_profile(poured, g.radius, height)
    _, start_all, start_core = solid_fraction_profile(first.reshape(-1, 3), g.radius, height)
    core = cut_core[2:-2] if len(cut_core) > 4 else cut_core  # 5 mm from plate and surface
    grid, size = displacement_grid(first.mean(1), last.mean(1), height)
    energy, overlap = read_series(work, "collapse.energy"), read_series(work, "collapse.overlap")
    overlap[:, 1:] = np.maximum(0, 2 * g.radius - overlap[:, 1:]) / DIAMETER

    with h5py.File(out, "w") as f:
        def put(name, data, unit):
            made = f.create_dataset(name, data=np.asarray(data, "f4"), compression="gzip", shuffle=True)
            made.attrs["unit"] = unit

        f.attrs.update({
            "shape": case["shape"], "packing": case["packing"], "aspect_ratio": float(case["value"]),
            "seed": int(case["seed"]), "variables": case["variables"],
            "radius_m": R0, "height_m": height, "grains": grains, "grain_volume_m3": VOLUME,
            "porosity": 1 - solid, "void_ratio": 1 / solid - 1, "porosity_core": 1 - core.mean(),
            "solid_above_height_fraction": 1 - cut_all.mean() / solid,
            "normal_stiffness_N_per_m": run["kn"], "time_step_s": run["timestep"],
            "overlap_mean_over_d": overlap[0, 1], "overlap_mean_over_d_end": overlap[-1, 1],
            "overlap_max_over_d": overlap[:, 2].max(),
            "settlement_m": poured[:, 2].mean() - first[:, :, 2].mean(),
            **{f"cpu_s_{stage}": cpu_seconds(work, stage) for stage in ("deposit", "settle", "collapse")},
            **{f"undisturbed_fraction_{name}": (size < limit * DIAMETER).mean()
               for name, limit in UNDISTURBED.items()},
        })
        for name, values in series.items():
            put(name, values, "s" if name == "time" else "m")
        put("outline/radius", RING * (np.arange(RINGS) + 0.5), "m")
        for k, name in enumerate(("time", "kinetic", "rotational", "potential")):
            put("energy/" + name, energy[:, k], "J" if k else "s")
        for k, name in enumerate(("time", "mean", "max")):
            put("overlap/" + name, overlap[:, k], "d" if k else "s")
        put("porosity/z", z, "m")
        for name, solid_profile in (("cut", cut_all), ("cut_core", cut_core),
                                    ("start", start_all), ("start_core", start_core)):
            put("porosity/" + name, 1 - solid_profile, "1")
        rows = grid["count"].shape[0]
        put("displacement/r", RING * (np.arange(17) + 0.5), "m")
        put("displacement/z", RING * (np.arange(rows) + 0.5), "m")
        for name, values in grid.items():
            put("displacement/" + name, values, "m" if name in ("u", "u_r", "u_z") else "1")
        put("displacement/final_u", final_grid(last.mean(1), size, rows), "m")


if __name__ == "__main__":
    main()
