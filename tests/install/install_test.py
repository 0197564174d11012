#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build, moves the installation, builds two programs outside of the tree against it, and runs these and the
installed program from another folder: install_test.py --build BUILD [--cmake CMAKE]"""
import argparse
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py

HERE = pathlib.Path(__file__).resolve().parent
SPACING = "scene.spacing=0.005"


def run(command, folder):
    """Standard output; what failed is shown and ends the test."""
    ran = subprocess.run([str(word) for word in command], cwd=folder, text=True, capture_output=True,
                         env={"PATH": os.environ["PATH"], "HOME": str(folder), "OMP_NUM_THREADS": "1"})
    if ran.returncode:
        sys.exit(f"install_test.py: {' '.join(map(str, command))} ended with {ran.returncode}:\n{ran.stdout}{ran.stderr}")
    return ran.stdout


def require(holds, message):
    if not holds:
        sys.exit(f"install_test.py: {message}")


def installed(cmake, build):
    """The folder of an installation that was moved after it was made."""
    place = build / "test_install"
    shutil.rmtree(place, ignore_errors=True)
    run([cmake, "--install", build, "--prefix", place / "first"], build)
    return (place / "first").rename(place / "moved")


def build_outside(cmake, prefix, folder):
    shutil.copytree(HERE / "outside", folder / "source")
    run([cmake, "-S", folder / "source", "-B", folder / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
         f"-DCMAKE_PREFIX_PATH={prefix}"], folder)
    run([cmake, "--build", folder / "build"], folder)
    return folder / "build"


def check_ten_steps(programs, prefix, folder):
    """The host by its library and by the installed program: the same energy after the same ten steps."""
    scene = prefix / "share/simsand/scenes/default.toml"
    steps, time, kinetic = map(float, run([programs / "ten_steps", scene, SPACING], folder).split())
    require(steps == 10 and kinetic > 0, f"ten_steps made {steps:g} steps, kinetic energy {kinetic:g}")
    run([prefix / "bin/simsand", "run", "-q", scene, "--set", SPACING, "--set", f"end.time={time!r}",
         "--set", "output.sample_interval=1e-9", "-o", folder / "run"], folder)
    with h5py.File(folder / "run/result.h5") as result:
        of_program = {name: float(result["summary"][name][()]) for name in ("steps", "end_time", "kinetic_energy")}
    require(of_program["steps"] == 10 and math.isclose(of_program["kinetic_energy"], kinetic, rel_tol=1e-9),
            f"ten_steps found the kinetic energy {kinetic!r} at {time!r} s, simsand run {of_program}")


def check_material(programs, folder):
    """The mean stress follows the bulk modulus K0 p_at (2.97 - e)^2 / (1 + e) (p / p_at)^n."""
    before, after, void_ratio = map(float, run([programs / "call_material"], folder).split())
    e, p_at, volumetric_strain = 0.4451, 101325, 3e-6
    p = (before + after) / 2
    expected = 100 * p_at * (2.97 - e)**2 / (1 + e) * (p / p_at)**0.51 * volumetric_strain
    require(math.isclose(after - before, expected, rel_tol=1e-4),
            f"the mean stress grew by {after - before:g} Pa, expected {expected:g} Pa")
    require(math.isclose(void_ratio, (1 + e) * math.exp(-volumetric_strain) - 1, rel_tol=1e-9),
            f"the void ratio is {void_ratio!r}")


def check_program(prefix, folder):
    """Scripts, data and the material's source are found from another folder."""
    simsand, share = prefix / "bin/simsand", prefix / "share/simsand"
    run([simsand, "element", share / "paths/triaxial_undrained.toml", "-o", "table.csv", "--figures", "pictures"], folder)
    require((folder / "pictures/overview.png").stat().st_size > 10000, "no picture of the element test")
    run([simsand, "abaqus", share / "scenes/default.toml", "--spacing", "0.005", "-o", "deck"], folder)
    require((folder / "deck/simsand_vumat.cpp").is_file(), "no source of the material beside the deck")
    for library in ("libelastic_vumat.so", "libsimsand_single_vumat.so"):
        require((prefix / "lib" / library).is_file(), f"{library} is not installed")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--cmake", default="cmake")
    arguments = parser.parse_args()
    prefix = installed(arguments.cmake, arguments.build.resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        programs = build_outside(arguments.cmake, prefix, folder)
        check_ten_steps(programs, prefix, folder)
        check_material(programs, folder)
        check_program(prefix, folder)


if __name__ == "__main__":
    main()
