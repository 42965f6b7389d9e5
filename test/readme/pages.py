#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Runs the commands of pages, as a reader would, and compares the answers with what stands there.

Lines of `sh` blocks that begin with `fcl_prob` are run, one after the other. Where the text right above a block says
"P = x", the answer of `--json` has to agree with it to the digits given, or to four standard errors. `json` blocks are
scenes, which are asked. Files that a reader would bring along (part.stl, cloud.pcd, ...) are small ones of
the project, or made here.
"""
import json
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SOURCE_DIR = pathlib.Path(__file__).resolve().parents[2]
PAGES = ["data/README.md", "README.md"]
PAGES += [f"docs/{name}.md" for name in ("start", "robots", "planning", "pose", "sweep", "cloud", "scene_format")]
# What needs models that are not here or GNU parallel, or takes a minute; other tests run it.
ELSEWHERE = ["bench", "--shard", "compare"]
BLOCK = re.compile(r"(?:P = (?P<said>[\d.]+)\.)?\n+```(?P<kind>sh|json)\n(?P<lines>.*?)^```", re.DOTALL | re.MULTILINE)


def answer(record):
    """The probability of a result, and how far it may be off."""
    whole = record.get("persistent", record)
    if whole["estimate"] is not None and whole["standard_error"]:
        return whole["estimate"], 4 * whole["standard_error"]
    return 0.5 * (whole["lower"] + whole["upper"]), 0.5 * (whole["upper"] - whole["lower"])


def fault_of(command, line, said, folder):
    words = [command, *shlex.split(line, comments=True)[1:]]
    if said:
        words.append("--json")
    run = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return f"exit code {run.returncode}: {run.stderr.strip()}"
    if said:
        value, error = answer(json.loads(run.stdout))
        error += 0.5 * 10.0 ** -len(said.partition(".")[2])
        if abs(value - float(said)) > error:
            return f"P is {value}, the page says {said}"
    return None


def depth_image():
    """What a depth camera sees of a box of 10 cm, 0.8 m away, before a wall: an organised cloud."""
    width, height, focal_length = 160, 120, 131.0
    points = []
    for row in range(height):
        for column in range(width):
            x, y = (column - 0.5 * width) / focal_length, (row - 0.5 * height) / focal_length
            z = 0.8 if max(abs(x), abs(y)) < 0.05 / 0.8 else 1.2
            points.append(f"{x * z:.6f} {y * z:.6f} {z:.6f}")
    head = "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
    head += f"WIDTH {width}\nHEIGHT {height}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA ascii\n"
    return head + "\n".join(points) + "\n"


def bring_along(folder):
    data = SOURCE_DIR / "data"
    for name in ("mug.obj", "gripper_finger.off"):
        (folder / name).symlink_to(data / name)
    (folder / "gripper.stl").symlink_to(data / "bracket.stl")
    (folder / "cloud.pcd").write_text(depth_image())
    (folder / "data").symlink_to(data)
    (folder / "part.stl").symlink_to(data / "bracket.stl")
    (folder / "fixture.obj").symlink_to(data / "mug.obj")
    scene = json.loads((data / "two_boxes.json").read_text())
    del scene["displacement"]
    scene["pose_error"] = {"sigma": [0.02, 0.02, 0.02, 0.002, 0.002, 0.002]}
    (folder / "scene.json").write_text(json.dumps(scene))
    queries = [{"id": number, "scene": "data/two_boxes.json"} for number in range(3)]
    (folder / "queries.jsonl").write_text("".join(json.dumps(query) + "\n" for query in queries))


def lines_of(block, folder, number):
    """The commands of a block; of a scene one that checks it. (Queries of a sweep: test/python.)"""
    if block["kind"] == "json":
        scene = f"block_{number}.json"
        (folder / scene).write_text(block["lines"])
        return [] if block["lines"].startswith('{"id"') else [f"fcl_prob check --scene {scene}"]
    return block["lines"].replace("\\\n", " ").splitlines()


def main(command, without):
    checks = faults = 0
    for page in PAGES:
        with tempfile.TemporaryDirectory() as folder:
            bring_along(pathlib.Path(folder))
            for number, block in enumerate(BLOCK.finditer((SOURCE_DIR / page).read_text())):
                for line in lines_of(block, pathlib.Path(folder), number):
                    if not line.startswith("fcl_prob ") or any(word in line for word in without + ELSEWHERE):
                        continue
                    checks += 1
                    fault = fault_of(command, line, block["said"], folder)
                    if fault:
                        faults += 1
                        print(f"{page}: {line}: {fault}")
    print(f"{checks} commands, {faults} failed")
    return 1 if faults or not checks else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2:]))
