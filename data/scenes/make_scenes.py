#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the 24 scenes of data/columns/columns.csv, default.toml, and the default column in three
dimensions, a quarter and the whole, into this folder."""
import csv
import pathlib

here = pathlib.Path(__file__).resolve().parent

SCENE = """\
# SPDX-License-Identifier: BSD-3-Clause
# Column {shape}, {packing}, aspect ratio {aspect_ratio}: porosity {porosity}, {height_mm} mm high.
# Written by make_scenes.py from data/columns/columns.csv.
[scene]
{geometry}
spacing = 0.002             # m
gravity = 9.81              # m/s2

[column]
radius = 0.05               # m
height = {height:<18} # m

[material]
file = "../materials/{shape}.toml"
void_ratio = {void_ratio}         # at the start

[floor]
friction = 0.5              # coefficient, as between grains and wall in the source's DEM

[gate]
motion = "lift"
speed = 1.6                 # m/s, upwards, as in the source

[end]
time = 1.5                  # s, latest end; collapse takes about 3 sqrt(height / gravity)
kinetic_energy_fraction = 1e-6   # of the initial potential energy: at rest below it

[output]
folder = "results/{folder}"
sample_interval = 0.005     # s
snapshot_interval = 0.05    # s
grain_diameter = 0.00295    # m, the front is where the deposit is this high
"""


AXISYMMETRIC = 'geometry = "axisymmetric"'
SOLID = 'geometry = "three_dimensional"\nsector = "{}"'


def write(name, row, geometry=AXISYMMETRIC):
    height = f"{float(row['height_mm']) / 1000:g}"
    text = SCENE.format(height=height, folder=name, geometry=geometry, **row)
    (here / f"{name}.toml").write_text(text, encoding="utf-8")


with open(here.parent / "columns" / "columns.csv", encoding="utf-8") as table:
    rows = list(csv.DictReader(line for line in table if not line.startswith("#")))
for row in rows:
    name = f"{row['shape'].lower()}_{row['packing']}_a{row['aspect_ratio']}"
    write(name, row)
    if name == "ts_dense_a1":
        write("default", row)
        for sector in ("quarter", "full"):
            write(f"{name}_{sector}", row, SOLID.format(sector))
