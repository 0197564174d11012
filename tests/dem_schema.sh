#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The DEM reference: the shipped results follow the schema, and so does one tiny case of each kind
# that LAMMPS runs here.  Exit code 77 (skipped) after the first part where LAMMPS is not installed.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
dem=$root/data/dem
python=
for p in ${PYTHON:-python3 /usr/bin/python3}; do
  if "$p" -c 'import numpy, h5py' 2>/dev/null; then python=$p; break; fi
done
[[ -n $python ]] || { echo "skipped: no python3 with numpy and h5py" >&2; exit 77; }

shopt -s nullglob
shipped=("$dem"/results/triaxial_*.csv "$dem"/results/column_*.h5)
((${#shipped[@]})) || { echo "no results in $dem/results" >&2; exit 1; }
"$python" "$dem/schema.py" "${shipped[@]}"

if ! command -v "${LMP:-lmp}" > /dev/null; then
  echo "skipped: LAMMPS is not installed (the shipped results are in order)" >&2
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PYTHON=$python DEM_WORK=$work DEM_RESULTS=$work/results
# Few and soft grains: only the chain of programs is tested, not the numbers.
export DEM_GRAINS=100 DEM_STIFFNESS=300 DEM_END=0.03
for shape in SS ES; do
  DEM_VARS="-var end_strain 0.02" bash "$dem/run.sh" triaxial "$shape" dense 10
done
bash "$dem/run.sh" column SS loose 0.1
bash "$dem/run.sh" column TS dense 0.05
"$python" "$dem/schema.py" "$work"/results/*
