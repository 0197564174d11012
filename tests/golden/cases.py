# SPDX-License-Identifier: BSD-3-Clause
"""Runs one case of golden.py and takes hashes and numbers from its results."""
import csv
import hashlib
import pathlib
import signal
import subprocess
import time

import h5py
import numpy

HERE = pathlib.Path(__file__).resolve().parent
SCENES = ["plane_strain", "axisymmetric", "full", "half", "quarter", "walls", "foreign_vumat", "resumed"]
RESUMED = "resumed"  # the scene whose runs are interrupted
# Every control of the element driver; twenty do not cover them.
PATHS = [
    "axisymmetric", "components", "critical_state", "deformation_gradient", "envelopes", "mixed", "plane_strain_constant_p",
    "plane_strain_drained", "plane_strain_undrained", "principal", "proportional_strain", "proportional_stress",
    "reconsolidation", "replay_triaxial", "simple_shear_cyclic", "simple_shear_drained", "torsional_shear_drained",
    "torsional_shear_undrained", "triaxial_constant_p", "triaxial_constant_volume", "triaxial_cyclic_undrained",
    "triaxial_lateral", "true_triaxial_constant_p", "true_triaxial_drained", "true_triaxial_undrained"]
LAST_ROW = [
    "stage", "step", "strain_11", "strain_22", "strain_12", "stress_11_Pa", "stress_22_Pa", "stress_33_Pa", "stress_12_Pa",
    "void_ratio", "pore_pressure_Pa", "state_plastic_deviatoric_strain", "internal_energy_J_per_kg"]
EARLY = 0.03  # s, of the numbers whose names begin with early_: see TOLERANCES in answers.py


class Failure(Exception):
    """What a run did that it should not, in one line."""


class Answer:
    """`datasets`: hash of each by its path; `numbers`: by name."""

    def __init__(self, datasets, numbers):
        self.datasets, self.numbers = datasets, numbers

    def parts(self):
        """A hash for each of particles, every snapshot, outline, series (a path: its tables), in this order."""
        members = {}
        for name, value in sorted(self.datasets.items()):
            members.setdefault(part_of(name), []).append(f"{name} {value}\n")
        return {part: sha("".join(lines).encode()) for part, lines in members.items()}


def part_of(dataset):
    """snapshots/0001/velocity belongs to snapshots/0001, series/time to series."""
    words = dataset.split("/")
    return "/".join(words[:2] if words[0] == "snapshots" else words[:1])


def sha(content):
    return hashlib.sha256(content).hexdigest()[:16]


def hash_of_array(name, array):
    return sha(f"{name} {array.dtype.str} {array.shape} ".encode() + array.tobytes())


def call(command, status=0):
    """Runs a program to its end; Failure unless it ends with `status`."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != status:
        raise Failure(f"{' '.join(str(word) for word in command[:2])} ended with status {done.returncode}: "
                      f"{' '.join(done.stderr.split()[-40:])}")


def run_scene(program, name, threads, folder, settings, interrupted=False):
    """The answer of a scene; its results are written to `folder`."""
    command = [program, "run", "-q", "-t", threads]
    start = command + [HERE / f"scenes/{name}.toml", "-o", folder] + [word for s in settings for word in ("--set", s)]
    if interrupted:
        interrupt(start, folder)
        call(command + ["--resume", folder])
    else:
        call(start)
    return scene_answer(folder / "result.h5", threads)


def interrupt(command, folder, attempts=5):
    """Stops a run after its second snapshot. On a busy machine the run may be over before: then again."""
    for _ in range(attempts):
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and not (folder / "result.parts/0001.h5").exists():
            time.sleep(0.002)
        process.send_signal(signal.SIGTERM)
        error = process.communicate()[1]
        if process.returncode == 128 + signal.SIGTERM and (folder / "checkpoint.h5").exists():
            return
        if process.returncode != 0:
            raise Failure(f"a run that was interrupted ended with status {process.returncode}: {error.strip()}")
    raise Failure(f"the run ended {attempts} times before it was interrupted")


def scene_answer(path, threads):
    """Everything but /scene (paths), /summary (wall clock) and the attributes (compiler, build)."""
    datasets = {}
    with h5py.File(path) as file:
        def add(name, item):
            if "time" in item.attrs:
                datasets[f"{name}/@time"] = hash_of_array(name, numpy.float64(item.attrs["time"]))
            if isinstance(item, h5py.Dataset):
                datasets[name] = hash_of_array(name, item[()])
        for group in ("particles", "snapshots", "outline", "series"):
            file[group].visititems(lambda name, item, group=group: add(f"{group}/{name}", item))
        used = int(file["summary/threads"][()])
        if used != threads:
            raise Failure(f"ran on {used} threads, not {threads}")
        return Answer(datasets, scene_numbers(file))


def scene_numbers(file):
    """Some at the end, and those of the first snapshot from EARLY on."""
    summary, series = file["summary"], file["series"]
    snapshot = next(s for _, s in sorted(file["snapshots"].items()) if s.attrs["time"] >= EARLY)
    row = int(numpy.argmin(abs(series["time"][()] - snapshot.attrs["time"])))
    return {
        "steps": summary["steps"][()], "end_time": summary["end_time"][()], "final_height": series["height"][-1],
        "early_time": snapshot.attrs["time"], "early_height": series["height"][row],
        "early_front": series["front_radius"][row], "early_kinetic_energy": series["kinetic_energy"][row],
        "early_sum_of_stress": numpy.abs(snapshot["stress"][()]).sum()}


def run_paths(program, names, threads, folder):
    """The answers of element paths by name, computed `threads` at a time."""
    folder.mkdir(parents=True, exist_ok=True)
    call([program, "element", "-t", threads, "-o", folder] + [HERE.parents[1] / f"data/paths/{n}.toml" for n in names])
    return {name: path_answer(folder, name) for name in names}


def path_answer(folder, name):
    datasets = {part: sha(file.read_bytes())
                for part, file in (("table", folder / f"{name}.csv"), ("envelope", folder / f"{name}_envelope.csv"))
                if file.exists()}
    if "table" not in datasets:
        raise Failure("no table was written")
    with open(folder / f"{name}.csv", newline="") as file:
        last = list(csv.DictReader(file))[-1]
    return Answer(datasets, {column: float(last[column]) for column in LAST_ROW})
