# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""A case is a question in numbers; here it is written to files, asked and judged."""
import dataclasses
import json
import pathlib
import subprocess


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    scene: dict
    # Probabilities that the interval has to hold, mostly one; without any the scene has to be refused.
    values: tuple = ()
    # Words that the refusal has to contain: what is wrong, and where.
    words: tuple = ()
    # Bytes of the files beside the scene, by name.
    files: dict = dataclasses.field(default_factory=dict)
    command: str = "check"
    # How far the values may be off, relative: formats in single precision.
    slack: float = 1e-9
    # The largest width of an interval around one value, relative to its upper end, and absolute.
    width: float = 1e-6
    narrow: float = 1e-14
    # Words that the notes of the answer have to contain.
    notes: tuple = ()


def asked(case, command, folder):
    """Writes the files of a case and runs the command on them."""
    folder.mkdir(parents=True)
    for name, content in case.files.items():
        (folder / name).write_bytes(content)
    (folder / "scene.json").write_text(json.dumps(case.scene))
    return subprocess.run([command, case.command, "--scene", "scene.json", "--json"], cwd=folder,
                          capture_output=True, text=True, timeout=120)


def fault_of_refusal(case, run):
    message = run.stderr.strip()
    if run.returncode != 2:
        return f"should be refused, for {', '.join(case.words)}: exit code {run.returncode}, {run.stdout[:200]}"
    if len(message.splitlines()) != 1 or run.stdout:
        return f"a refusal is one line on standard error: {message} {run.stdout[:200]}"
    missing = [word for word in case.words if word not in message]
    return f"the refusal does not name {missing}: {message}" if missing else None


def fault_of_values(case, values, answer):
    low, high = answer["lower"], answer["upper"]
    if low is None or high is None:
        return "no interval"
    for value in values:
        slack = case.slack * value + 1e-300
        if not low - slack <= value <= high + slack:
            return f"P = {value!r} is not in [{low!r}, {high!r}]"
    # Several values are what shapes within a band may have: nothing says how wide the interval then is.
    if len(values) == 1:
        if high - low > max(case.narrow, case.width * high) + case.slack * high:
            return f"[{low!r}, {high!r}] is wider than asked for"
        said = answer["probability"]
        if abs(said - values[0]) > max(case.narrow, case.width * high) + case.slack * high:
            return f"the answer is {said!r}, P = {values[0]!r}"
    return None


def wrong_values(values, narrow):
    """Values near the right ones, which a check that can fail tells from them."""
    shift = 0.01
    for i, value in enumerate(values):
        # Below the lowest of several there may be nothing that could be told from it.
        if len(values) > 1 and value < narrow:
            continue
        for wrong in (value * (1 - shift), value * (1 + shift) if value < 1 - shift else 0.0, 0.5 * (1 + value)):
            # The lowest and the highest of several are ends of an interval: only what is beyond is wrong.
            within = len(values) > 1 and min(values) <= wrong <= max(values)
            if wrong != value and not within:
                yield values[:i] + (wrong,) + values[i + 1:]


def fault_of_answer(case, run):
    if run.returncode != 0:
        return f"exit code {run.returncode}: {run.stderr.strip()}"
    answer = json.loads(run.stdout)
    fault = fault_of_values(case, case.values, answer)
    if fault:
        return fault
    for wrong in wrong_values(case.values, case.narrow):
        if fault_of_values(case, wrong, answer) is None:
            return f"[{answer['lower']!r}, {answer['upper']!r}] would pass for {wrong} as well as for {case.values}"
    plan = " ".join(answer["plan"])
    missing = [word for word in case.notes if word not in plan]
    return f"no note of {missing} in {answer['plan']}" if missing else None


def fault_of(case, command, folder):
    """What is wrong with the command's answer, or None."""
    try:
        run = asked(case, command, pathlib.Path(folder))
    except subprocess.TimeoutExpired:
        return "no answer within two minutes"
    if case.values:
        return fault_of_answer(case, run)
    assert case.words, "a refusal has to name something"
    return fault_of_refusal(case, run)
