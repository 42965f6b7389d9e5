#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What users of collision libraries and of readers of meshes, maps and robots have reported as wrong, asked anew.

Each family stands for one kind of fault; its scenes and files are made from formulas and from numbers drawn with a
fixed seed, and the truth is a closed form (truth.py). A certified interval has to hold it, be as narrow as was asked,
and not hold a value 1 % beside it; what is wrong has to be refused with exit code 2 and one line that names it. Prints
the counts and every failure with its scene; exit code 1 if there is one.
"""
import argparse
import json
import pathlib
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

sys.dont_write_bytecode = True  # the source tree stays as it is

import bodies
import boxes
import brick_files
import exchange
import maps
import refused_files
import robots
import round_shapes
from checks import fault_of

SUBJECTS = {"boxes": boxes, "round_shapes": round_shapes, "bodies": bodies, "brick_files": brick_files,
            "exchange": exchange, "refused_files": refused_files, "maps": maps, "robots": robots}


def run_subject(subject, command, folder):
    """Asks all cases of a subject, two at a time; their number, and that of the failures."""
    started, cases = time.monotonic(), list(SUBJECTS[subject].cases())
    assert len({case.name for case in cases}) == len(cases), "two cases of one name"
    folders = [f"{folder}/{subject}/{index}" for index in range(len(cases))]
    with ThreadPoolExecutor(2) as pool:
        faults = list(pool.map(fault_of, cases, [command] * len(cases), folders))
    for case, fault in zip(cases, faults):
        if fault:
            print(f"FAILED {subject}: {case.name}: {fault}\n  {case.command} {json.dumps(case.scene)}")
    failed = sum(fault is not None for fault in faults)
    print(f"{subject}: {len(cases) - failed} of {len(cases)} as they should be, {time.monotonic() - started:.1f} s",
          flush=True)
    return len(cases), failed


def main(command, subjects):
    with tempfile.TemporaryDirectory() as folder:
        results = [run_subject(subject, command, folder) for subject in subjects]
    count, failed = sum(r[0] for r in results), sum(r[1] for r in results)
    print(f"{count} checks, {failed} failed")
    # Nothing asked is no success.
    return 1 if failed or not count else 0


def options():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("command", help="the fcl_prob to ask")
    parser.add_argument("subjects", nargs="*", help=f"of {', '.join(SUBJECTS)}; all by default")
    parser.add_argument("--without", choices=SUBJECTS, action="append", default=[], help="what this fcl_prob lacks")
    chosen = parser.parse_args()
    unknown = set(chosen.subjects) - set(SUBJECTS)
    if unknown:
        parser.error(f"no such subject: {', '.join(sorted(unknown))}")
    return chosen


if __name__ == "__main__":
    asked_for = options()
    command = str(pathlib.Path(asked_for.command).resolve())
    sys.exit(main(command, [s for s in asked_for.subjects or SUBJECTS if s not in asked_for.without]))
