#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# One DEM case from the packing to the compact results.
#   bash data/dem/run.sh triaxial SS|TS|ES dense|loose PRESSURE_KPA [SEED]
#   bash data/dem/run.sh column   SS|TS|ES dense|loose ASPECT_RATIO [SEED]
# Environment: LMP (lmp), PYTHON (a python3 with numpy and h5py), DEM_WORK (results/dem),
# DEM_RESULTS (data/dem/results), DEM_VARS (LAMMPS options, such as "-var restitution 0.9"),
# DEM_GRAINS (1700, in the cell), DEM_STIFFNESS (N/m, column), DEM_END (s, column),
# DEM_TETRAHEDRON_EDGE and DEM_ELONGATED_SPACING (over the sphere radius),
# DEM_TAG (a word added to the name of the case when any of these changes it).
# A stage that ended leaves a mark and is not run again; a killed collapse goes on from its
# last checkpoint.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
lmp=${LMP:-lmp}
work_root=${DEM_WORK:-$here/../../results/dem}
results=${DEM_RESULTS:-$here/results}
export OMP_NUM_THREADS=1

fail() { echo "run.sh: $*" >&2; exit 1; }

find_python() {
  for p in ${PYTHON:-python3 /usr/bin/python3}; do
    if "$p" -c 'import numpy, h5py' 2>/dev/null; then echo "$p"; return; fi
  done
  fail "no python3 with numpy and h5py found; set PYTHON"
}

# What differs from the main set, for the record.
variables() {
  local changed=${DEM_VARS:-} name
  for name in DEM_GRAINS DEM_STIFFNESS DEM_END DEM_TETRAHEDRON_EDGE DEM_ELONGATED_SPACING; do
    [[ -z ${!name:-} ]] || changed+=" $name=${!name}"
  done
  echo "${changed:-none}"
}

# stage NAME COMMAND...: once; NAME.cpu gets a line with its CPU seconds (user) for every attempt
stage() {
  local name=$1; shift
  [[ -e $work/$name.done ]] && return
  echo "[$case] $name"
  local TIMEFORMAT=%U
  { time "$@" > "$work/$name.log" 2>&1; } 2>> "$work/$name.cpu" ||
    { tail -n 5 "$work/$name.log" >&2; fail "$case: $name failed, see $work/$name.log"; }
  touch "$work/$name.done"
}

# lammps INPUT VARIABLE VALUE ...
lammps() {
  local input=$1; shift
  local vars=()
  while (($#)); do vars+=(-var "$1" "$2"); shift 2; done
  # shellcheck disable=SC2086
  "$lmp" -log none -in "$here/lammps/$input" -var inputs "$here/lammps" \
    -var kind "$kind" -var spheres_per_grain "$spheres" "${vars[@]}" ${DEM_VARS:-}
}

triaxial() {
  local pressure=$1 seed=$2
  # The grains differ from pressure to pressure, else the rigid limit would make the curves equal.
  stage packing "$python" "$here/packing.py" cell "$shape" "${DEM_GRAINS:-1700}" \
    $((100 * seed + pressure)) "$work/packing"
  stage shear lammps triaxial.in grains "$work/packing" out "$work/test" pressure $((1000 * pressure)) \
    friction_preparation "$pouring_friction" compression_units "$compression"
  stage extract "$python" "$here/extract_triaxial.py" "$work" "$results/$case.csv"
}

column() {
  local aspect=$1 seed=$2 height kn pouring_kn end poured
  height=$(awk "BEGIN { print 0.05 * $aspect }")
  # Soft, but the weight of the column presses the grains by less than 1e-3 d; deeper, stiffer.
  kn=${DEM_STIFFNESS:-$(awk "BEGIN { print 1e4 * ($aspect > 1 ? $aspect : 1) }")}
  # Softer still while pouring, which takes the larger part of the time: 2.2 times fewer steps.
  pouring_kn=$(awk "BEGIN { print $kn / 5 }")
  # Rest comes at 3 sqrt(h/g) in the laboratory, here 0.15 to 0.43 s; spheres roll on longer, and dense clumps at 1
  # give way slowly (0.4 s, an earlier end, cut their fall short).
  end=${DEM_END:-$(awk "BEGIN { end = $aspect > 2 ? 1.0 : $aspect > 1 || ($aspect > 0.5 && $spheres > 1) ? 0.8 : 0.6
                                print end - ($spheres > 1 && $aspect != 1 ? 0.2 : 0) }")}
  # To be cut: 5 mm, or 5 % of the height.
  poured=$(awk "BEGIN { h = $height; h += h > 0.1 ? 0.05 * h : 0.005
                        print int($solid * 3.14159265 * 0.05^2 * h / 13.455e-9) }")
  stage packing "$python" "$here/packing.py" column "$shape" "$poured" "$seed" "$work/packing"
  stage deposit lammps deposit.in grains "$work/packing" out "$work/deposit" kn "$pouring_kn" \
    pouring_friction "$pouring_friction" height "$height" settling_speed "$settling_speed"
  stage cut "$python" "$here/cut.py" "$spheres" "$height" "$work/deposit" "$work/cut"
  stage settle lammps settle.in grains "$work/cut" out "$work/start" kn "$kn"
  local start=$work/start checkpoint
  checkpoint=$(ls -t "$work"/collapse.checkpoint.?.restart 2>/dev/null | head -n 1) || true
  [[ -z $checkpoint ]] || start=${checkpoint%.restart}
  stage collapse lammps collapse.in start "$start" out "$work/collapse" kn "$kn" end "$end"
  stage extract "$python" "$here/extract_column.py" "$work" "$results/$case.h5"
}

main() {
  (($# >= 4)) || fail "usage: run.sh triaxial|column SS|TS|ES dense|loose PRESSURE_KPA|ASPECT_RATIO [SEED]"
  test_kind=$1 shape=$2 packing=$3 value=$4 seed=${5:-1}
  command -v "$lmp" > /dev/null || fail "LAMMPS ($lmp) is not installed: apt-get install lammps"
  python=$(find_python)

  case $shape in
    SS) kind=sphere spheres=1 compression=100 dense_solid=0.65 settling_speed=0.1 ;;
    TS) kind=clump spheres=4 compression=120 dense_solid=0.71 settling_speed=0.3 ;;
    ES) kind=clump spheres=3 compression=140 dense_solid=0.71 settling_speed=0.3 ;;
    *) fail "shape '$shape': SS, TS or ES expected" ;;
  esac
  case $packing in
    dense) pouring_friction=0.0 solid=$dense_solid settling_speed=0 ;;  # falls freely
    loose) pouring_friction=1.0 solid=0.58 ;;
    *) fail "packing '$packing': dense or loose expected" ;;
  esac

  case=${test_kind}_${shape}_${packing}_${value}
  ((seed == 1)) || case+=_seed$seed
  [[ -z ${DEM_TAG:-} ]] || case+=_$DEM_TAG
  work=$work_root/$case
  mkdir -p "$work" "$results"
  printf '%s\n' "kind $test_kind" "shape $shape" "packing $packing" "value $value" "seed $seed" \
    "variables $(variables)" > "$work/case"

  case $test_kind in
    triaxial) triaxial "$value" "$seed" ;;
    column) column "$value" "$seed" ;;
    *) fail "test '$test_kind': triaxial or column expected" ;;
  esac
  echo "[$case] in $results"
}

main "$@"; exit  # one line: the file may change while it runs
