# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Every Python block of the documentation runs, and prints what stands below it.

Blocks of a page share their names. A `text` block right after one is its output; numbers may differ by
what the queries' tolerance of 1 % leaves open.
"""
import contextlib
import io
import json
import os
import pathlib
import re
import subprocess

import pytest
from scenes import SOURCE_DIR, boxes_truth, needs_command, needs_io, needs_robot

BLOCK = re.compile(r"^```python\n(.*?)^```\n(?:\n?```text\n(.*?)^```\n)?", re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
PAGES = ["README.md", *sorted(f"docs/{path.name}" for path in (SOURCE_DIR / "docs").glob("*.md"))]


def blocks_of(page):
    return BLOCK.findall((SOURCE_DIR / page).read_text())


def assert_alike(printed, expected):
    assert NUMBER.sub("#", printed) == NUMBER.sub("#", expected)
    for one, other in zip(NUMBER.findall(printed), NUMBER.findall(expected)):
        assert float(one) == pytest.approx(float(other), rel=0.02)


@needs_io
@needs_command
def test_queries_of_the_page_on_sweeps_are_answered(tmp_path):
    page = (SOURCE_DIR / "docs/sweep.md").read_text()
    queries = SOURCE_DIR / "data"
    text = re.search(r"^```json\n(.*?)^```", page, re.DOTALL | re.MULTILINE)[1]
    (tmp_path / "queries.jsonl").write_text(text.replace("finger_mug.json", str(queries / "finger_mug.json")))
    command = [os.environ["FCL_PROB_CLI"], "sweep", "queries.jsonl", "--output", "results.jsonl"]
    subprocess.run(command, check=True, cwd=tmp_path)
    records = [json.loads(line) for line in (tmp_path / "results.jsonl").read_text().splitlines()]
    assert len(records) == 4 and not any("error" in record for record in records)
    assert records[3]["probability"] == pytest.approx(0.158655, rel=1e-3)
    keys = re.findall(r"`(\w+)`", re.search(r"A result has (.*?), as", page, re.DOTALL)[1])
    assert keys == list(records[0])


@needs_io
@needs_robot
@pytest.mark.parametrize("page", [page for page in PAGES if blocks_of(page)])
def test_blocks_run(page, tmp_path, monkeypatch):
    # Where the reader stands: beside data/, with files of one's own.
    (tmp_path / "data").symlink_to(SOURCE_DIR / "data")
    monkeypatch.chdir(tmp_path)
    names = {"__name__": "__main__"}
    for code, expected in blocks_of(page):
        if "fcl_prob.plan(" in code and os.environ["FCL_PROB_WITH_PLANNING"] == "0":
            continue  # a build without planning
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(compile(code, page, "exec"), names)
        if expected:
            assert_alike(out.getvalue(), expected)


def test_the_readme_has_a_block_that_answers():
    (code, _), *_ = blocks_of("README.md")
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(code, {})
    lower, _, _, _, upper = out.getvalue().split()
    # What is printed is rounded, and so is the truth.
    truth = boxes_truth(0.5)
    assert float(lower) <= truth * (1 + 1e-14) and truth * (1 - 1e-14) <= float(upper) < 0.1057
    assert len(code.splitlines()) == 5
