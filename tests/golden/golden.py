#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do scenes and element paths still give the same numbers, bit for bit?

    golden.py [--program build/simsand] [--only NAME]... [--update] [-o FOLDER] [--set TABLE.KEY=VALUE]...

Guards changes that must not change results: moved code, other data structures, other loops. It runs eight coarse scenes
(`scenes/`: plane strain, axisymmetry, three dimensions whole, half and quarter, a list of moving walls, a material that is
not SIMSAND, a run that is interrupted and resumed) and the element paths named in `cases.py`, on 1 and on 2 threads. It
hashes all their numbers (a scene: particles, snapshots, outline, series; a path: its tables) and compares

  - the hashes of 1 thread with those of 2, and of the resumed run with those of one that was not interrupted: always;
  - the hashes with `answers.csv`, where compiler, processor and C library are those in its first line;
  - elsewhere the few numbers in `answers.csv`, to the tolerances in `answers.py`, as rounding differs there. It says so.

Exit status 1 with a line for each case that differs, which names what differs first.

When results change on purpose, `golden.py --update` writes `answers.csv` anew; say in the commit why they change.
--only: a scene or path, repeatable. -o keeps the results. --set alters all scenes, to see that the test notices.
"""
import argparse
import concurrent.futures
import os
import pathlib
import sys
import tempfile

import answers
import cases

ALL = [f"scene {s}" for s in cases.SCENES] + [f"path {p}" for p in cases.PATHS]


def tasks_of(program, names, threads, folder, settings):
    """By variant and what it is about: a function that returns answers by case."""
    words = f"{threads} thread{'s' if threads > 1 else ''}"
    tasks = {}

    def add(scene, variant, interrupted):
        at = folder / f"{scene}, {variant}"
        tasks[variant, f"scene {scene}"] = lambda: {
            f"scene {scene}": cases.run_scene(program, scene, threads, at, settings, interrupted)}

    for scene in (s for s in cases.SCENES if f"scene {s}" in names):
        add(scene, words, scene == cases.RESUMED)
        if scene == cases.RESUMED and threads == 1:
            add(scene, "1 thread, not interrupted", False)
    if paths := [p for p in cases.PATHS if f"path {p}" in names]:
        at = folder / f"paths, {words}"
        tasks[words, "paths"] = lambda: {
            f"path {name}": answer for name, answer in cases.run_paths(program, paths, threads, at).items()}
    return tasks


def run(tasks, at_a_time):
    """Answers by case and variant, and what went wrong."""
    found, faults = {}, []
    with concurrent.futures.ThreadPoolExecutor(at_a_time) as pool:
        futures = {key: pool.submit(task) for key, task in tasks.items()}
    for (variant, about), future in futures.items():
        try:
            for case, answer in future.result().items():
                found.setdefault(case, {})[variant] = answer
        except cases.Failure as error:
            faults.append(f"{about}, {variant}: {error}")
    return found, faults


def run_all(options, names, folder):
    """As many runs at a time as there are cores for their threads."""
    found, faults = {case: {} for case in names}, []
    for threads in (2, 1):
        tasks = tasks_of(options.program, names, threads, folder, options.set)
        some, wrong = run(tasks, max(1, (os.cpu_count() or 1) // threads))
        faults += wrong
        for case, variants in some.items():
            found[case] |= variants
    return {case: variants for case, variants in found.items() if variants}, faults


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=cases.HERE.parents[1] / "build/simsand")
    parser.add_argument("--only", action="append", metavar="NAME", help="scene or path; repeatable")
    parser.add_argument("--update", action="store_true", help="write answers.csv anew")
    parser.add_argument("--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="for all scenes")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="FOLDER", help="keep the results there")
    options = parser.parse_args()
    options.program = options.program.resolve()
    if not options.program.is_file():
        parser.error(f"{options.program}: no such program")
    known = {name for case in ALL for name in (case, case.split(" ")[1])}
    if unknown := set(options.only or []) - known:
        parser.error(f"no case {', '.join(sorted(unknown))}; there are {', '.join(ALL)}")
    if options.update and options.set:
        parser.error("--update stores the answers of scenes as they are, without --set")
    return options, [c for c in ALL if not options.only or {c, c.split(" ")[1]} & set(options.only)]


def main():
    options, names = arguments()
    with tempfile.TemporaryDirectory() as temporary:
        here = answers.signature(options.program, pathlib.Path(temporary) / "signature")
        found, faults = run_all(options, names, (options.output or pathlib.Path(temporary)).resolve())
    for case, variants in found.items():
        faults += answers.compare_variants(case, variants)
    one_thread = {case: variants["1 thread"] for case, variants in found.items() if "1 thread" in variants}
    if not options.update:
        faults += answers.compare_stored(here, one_thread)
    elif not faults:
        answers.update(here, one_thread, ALL)
    for fault in faults:
        print(f"golden: {fault}")
    print(f"{len(names)} cases on 1 and 2 threads, {len(faults)} differences")
    return 1 if faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except cases.Failure as error:
        sys.exit(f"golden: {error}")
