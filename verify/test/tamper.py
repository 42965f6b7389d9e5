#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Single changes of certificates that the library wrote: those that make a claim false have to be refused.

    tamper.py PROGRAM CERTIFICATE... [--changes N] [--seed S]

Which do is told without the program: what is claimed free and in contact at once is false, whatever the objects are.
Kinds named "maybe" may leave every claim true; they are counted only.
"""
import argparse
import collections
import json
import random
import re
import subprocess
import sys
import tempfile


def run(program, lines):
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl") as file:
        file.write("\n".join(json.dumps(line) for line in lines) + "\n")
        file.flush()
        done = subprocess.run([program, file.name], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def highest(cell, m):
    rank = len(m)
    return sum(m[k] * (cell[rank + k] if m[k] > 0 else cell[k]) for k in range(rank))


class Certificate:
    def __init__(self, path, program):
        self.text = open(path).read().splitlines()
        lines = self.lines()
        code, said = run(program, lines)
        assert code == 0, path + ": " + said
        shown = re.search(r"\[([^,]+), ([^\]]+)\]", said)
        self.shown = float(shown[1]), float(shown[2])
        self.cells = [i for i, line in enumerate(lines) if "cell" in line]
        self.parts = [i for i, line in enumerate(lines) if "part" in line and "vertices" in line]

    def lines(self):
        return [json.loads(line) for line in self.text]


# Each changes `lines` and returns whether a claim is false now (None: that is not known); False: not possible here.
def lower_raised(of, lines, draw):
    lines[-1]["lower"] = of.shown[0] * (1 + 1e-12) + 1e-300
    return True


def upper_lowered(of, lines, draw):
    lines[-1]["upper"] = of.shown[1] * (1 - 1e-12)
    return True


def leaf_dropped(of, lines, draw):
    del lines[draw.choice(of.cells)]
    return True


def leaf_twice(of, lines, draw):
    lines.insert(-1, lines[draw.choice(of.cells)])
    lines[-1]["cells"] += 1
    return True


def verdicts_exchanged(of, lines, draw):
    free = [i for i in of.cells if lines[i].get("free") is True]
    contact = [i for i in of.cells if any(not r["planes"] for r in lines[i].get("contact", []))]
    if not free or not contact:
        return False
    i, j = draw.choice(free), draw.choice(contact)
    lines[i]["cell"], lines[j]["cell"] = lines[j]["cell"], lines[i]["cell"]
    return True


def facing(of, lines):
    """Cells with a free half-space and a contact region across the same single plane."""
    for i in of.cells:
        free = lines[i].get("free")
        for region in lines[i].get("contact", []):
            if len(region["planes"]) != 1 or not isinstance(free, list):
                continue
            for plane in free:
                if plane[:-1] == region["planes"][0][:-1]:
                    yield i, plane, region["planes"][0]


def level_into(of, lines, draw, which):
    found = list(facing(of, lines))
    if not found:
        return False
    i, free, contact = draw.choice(found)
    m = free[:-1]
    top, bottom = highest(lines[i]["cell"], m), -highest(lines[i]["cell"], [-x for x in m])
    if which == "free" and contact[-1] < top:
        free[-1] = 0.5 * (contact[-1] + top)
        return True
    if which == "contact" and free[-1] > bottom:
        contact[-1] = 0.5 * (min(free[-1], top) + bottom)
        return True
    return False


def set_of_nothing_free(of, lines, draw):
    """As { 0·y < 0 } has no points it would be free of anything, and would leave nothing of its cell open."""
    open_cells = [i for i in of.cells if lines[i].get("free") is not True]
    if not open_cells:
        return False
    line = lines[draw.choice(open_cells)]
    line["free"] = [*line.get("free", []), [0.0] * (len(line["cell"]) // 2 + 1)]
    return True


def free_level_into_contact(of, lines, draw):
    return level_into(of, lines, draw, "free")


def contact_level_into_free(of, lines, draw):
    return level_into(of, lines, draw, "contact")


def pair_maybe(of, lines, draw):
    regions = [r for i in of.cells for r in lines[i].get("contact", []) if "pair" in r["by"]]
    if not regions:
        return False
    pair = draw.choice(regions)["by"]["pair"]
    side = draw.randrange(2)
    pair[side] = max(0, pair[side] + draw.choice([-1, 1, 7, -7]))
    return None


def vertex_maybe(of, lines, draw, by):
    part = lines[draw.choice(of.parts)]
    vertex = draw.choice(part["vertices"])
    vertex[draw.randrange(3)] += draw.choice([-by, by])
    return None


def vertex_by_1e_12_maybe(of, lines, draw):
    return vertex_maybe(of, lines, draw, 1e-12)


def vertex_by_1_cm_maybe(of, lines, draw):
    return vertex_maybe(of, lines, draw, 1e-2)


def radius_maybe(of, lines, draw):
    swept = [i for i in of.parts if lines[i].get("radius")]
    if not swept:
        return False
    lines[draw.choice(swept)]["radius"] *= draw.choice([0.99, 1.01])
    return None


def deviation_maybe(of, lines, draw):
    k = draw.randrange(len(lines[0]["deviations"]))
    lines[0]["deviations"][k] *= draw.choice([0.99, 1.01])
    return None


def witness_vertex_maybe(of, lines, draw):
    regions = [r for i in of.cells for r in lines[i].get("contact", []) if "vertex" in r["by"]]
    if not regions:
        return False
    draw.choice(regions)["by"]["vertex"] = draw.randrange(50)
    return None


KINDS = [lower_raised, upper_lowered, leaf_dropped, leaf_twice, verdicts_exchanged, free_level_into_contact,
         contact_level_into_free, set_of_nothing_free, pair_maybe, vertex_by_1e_12_maybe, vertex_by_1_cm_maybe,
         radius_maybe, deviation_maybe, witness_vertex_maybe]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("certificates", nargs="+")
    parser.add_argument("--changes", type=int, default=120, help="of each certificate")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    draw = random.Random(arguments.seed)
    refused, passed, wrong = collections.Counter(), collections.Counter(), 0
    for path in arguments.certificates:
        of = Certificate(path, arguments.program)
        for change in range(arguments.changes):
            kind = KINDS[change % len(KINDS)]
            lines = of.lines()
            is_false = kind(of, lines, draw)
            if is_false is False:
                continue
            code, said = run(arguments.program, lines)
            (refused if code else passed)[kind.__name__] += 1
            if is_false and code == 0:
                wrong += 1
                print("PASSED:", path, kind.__name__, said)
    for kind in KINDS:
        print(f"{kind.__name__}: {refused[kind.__name__]} refused, {passed[kind.__name__]} passed")
    print(sum(refused.values()) + sum(passed.values()), "changes,", wrong, "false claims passed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
