# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""Threads, progress, signals, processes."""
import concurrent.futures
import gc
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest
from scenes import ERROR, FIXTURE, PART, needs_robot, pose, torus

import fcl_prob

LONG = {"method": "interval", "relative_tolerance": 1e-9, "absolute_tolerance": 1e-12, "max_cells": 10**9}


def test_progress_is_told_and_cancels():
    seen = []

    def note(interval, fraction, seconds):
        seen.append((interval, fraction, seconds))
        return len(seen) < 4

    result = fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], on_progress=note, **LONG)
    assert result.status == "cancelled" and len(seen) == 4
    assert seen[0][0][0] <= result.lower <= result.upper <= seen[0][0][1]
    # A callable that returns nothing goes on; what it does not change is the answer.
    request = {"method": "interval", "relative_tolerance": 0.01}
    plain = fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], **request)
    told = fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], on_progress=lambda *now: None, **request)
    assert (told.lower, told.upper) == (plain.lower, plain.upper)


def test_who_said_no_is_not_asked_again():
    poses = np.full((6, 3), 0.12)
    group = fcl_prob.GroupQuery([torus()], [torus()])
    calls = [
        lambda **told: fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], **told, **LONG),
        lambda **told: fcl_prob.collision_probability(
            torus(), torus(), ERROR, [0.25, 0.1, 0], method="estimate", relative_tolerance=1e-6, **told
        ),
        lambda **told: fcl_prob.collision_probabilities(torus(), torus(), ERROR, poses, **told, **LONG),
        lambda **told: group.motion_gradient(ERROR, [[0.25, 0.1, 0]], lines=10**7, **told),
    ]
    for call in calls:
        for last in (1, 3):
            seen = []
            call(on_progress=lambda *now: seen.append(now) or len(seen) < last)
            assert len(seen) == last


class Refusal(Exception):
    pass


def test_errors_of_progress_come_out():
    def refuse(*now):
        raise Refusal("no")

    with pytest.raises(Refusal):
        fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], on_progress=refuse, **LONG)
    with pytest.raises(Refusal):
        fcl_prob.collision_probabilities(torus(), torus(), ERROR, np.full((4, 3), 0.2), on_progress=refuse, **LONG)
    with pytest.raises(TypeError):
        fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], on_progress=lambda: None, **LONG)
    group = fcl_prob.GroupQuery([torus()], [torus()])
    with pytest.raises(Refusal):
        group.motion_gradient(ERROR, [[0.25, 0.1, 0]], on_progress=refuse)
    with pytest.raises(TypeError, match="on_progress must be callable"):
        group.motion_gradient(ERROR, [[0.25, 0.1, 0]], on_progress=3)


def test_progress_of_batches():
    seen = []
    poses = np.linspace([0.3, 0, 0], [0.6, 0, 0], 50)
    batch = fcl_prob.collision_probabilities(
        torus(), FIXTURE, ERROR, poses, on_progress=lambda done, total: seen.append((done, total))
    )
    assert seen[-1] == (50, 50) and batch.done == 50
    poses = np.full((6, 3), 0.12)
    batch = fcl_prob.collision_probabilities(torus(), torus(), ERROR, poses, on_progress=lambda *now: False, **LONG)
    assert batch.cancelled and batch.done < 6
    assert set(batch.status) == {"cancelled"} and np.isnan(batch.lower).all() and batch[0] is None
    assert batch.path == (0.0, 1.0)


INTERRUPTED = """
    import os, signal, sys, threading
    sys.path.insert(0, {tests!r})
    from scenes import DATA, ERROR, torus
    import fcl_prob, numpy as np
    long = dict(method="interval", relative_tolerance=1e-9, absolute_tolerance=1e-12, max_cells=10**9)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    try:
        {call}
    except KeyboardInterrupt as interrupted:
        result = interrupted.result
        assert "interrupted" in str(interrupted)
    {check}
    print("left", result)
"""

CALLS = [
    (
        "fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], **long)",
        "assert result.status == 'cancelled' and 0 < result.lower < result.upper < 1",
    ),
    (
        "fcl_prob.collision_probabilities(torus(), torus(), ERROR, np.full((9, 3), 0.12), **long)",
        "assert result.cancelled and len(result) == 9",
    ),
    (
        "fcl_prob.collision_probability(torus(), torus(), fcl_prob.PoseError(np.eye(6) * 1e-3), [0.25, 0.1, 0],"
        " method='estimate', relative_tolerance=1e-7, absolute_tolerance=1e-12, max_cells=10**9)",
        "assert result.status == 'cancelled' and result.lower <= result.upper",
    ),
    (
        "fcl_prob.GroupQuery([torus()], [torus()]).motion_gradient(ERROR, [[0.25, 0.1, 0]], lines=10**7)",
        "assert result.status == 'cancelled' and 0 < result.lines < 10**7 and result.standard_error > 0",
    ),
    pytest.param(
        "query, at = fcl_prob.load_robot_scene(DATA / 'arm_path.json'); query.gradient(at, lines=10**6, threads=2)",
        "assert result.status == 'cancelled' and 0 < result.lines < 10**6 and result.gradient.shape == at.shape",
        marks=needs_robot,
    ),
]


def run_python(code):
    return subprocess.run([sys.executable, "-c", textwrap.dedent(code)], capture_output=True, text=True, timeout=120)


@pytest.mark.parametrize("call, check", CALLS)
def test_interrupt_leaves_a_valid_interval(call, check):
    tests = os.path.dirname(os.path.abspath(__file__))
    run = run_python(INTERRUPTED.format(tests=tests, call=call, check=check))
    assert run.returncode == 0 and run.stdout.startswith("left"), run.stderr


def test_other_signal_handlers_run_too():
    class Alarm(Exception):
        pass

    def ring(number, frame):
        raise Alarm

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    try:
        with pytest.raises(Alarm):
            fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], **LONG)
    finally:
        signal.signal(signal.SIGALRM, before)


def test_other_threads_run_meanwhile():
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.005):
            ticks.append(1)

    thread = threading.Thread(target=tick)
    thread.start()
    fcl_prob.collision_probability(torus(), torus(), ERROR, [0.25, 0.1, 0], time_limit=0.5, **LONG)
    stop.set()
    thread.join()
    assert len(ticks) > 5


def test_one_query_of_many_threads():
    query = fcl_prob.PreparedQuery(torus(), FIXTURE)
    poses = np.linspace([0.3, 0, 0], [0.5, 0.1, 0], 24)
    expected = query.collision_probabilities(ERROR, poses, threads=1)
    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        singles = list(pool.map(lambda at: query.collision_probability(ERROR, at), poses))
        batches = list(pool.map(lambda _: query.collision_probabilities(ERROR, poses, threads=2), range(4)))
    assert [one.lower for one in singles] == list(expected.lower)
    assert all(np.array_equal(batch.upper, expected.upper) for batch in batches)


def ask(x):
    return fcl_prob.collision_probabilities(PART, FIXTURE, ERROR, np.full((20, 3), x)).lower.sum()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_processes(method):
    expected = [ask(x) for x in (0.1, 0.2, 0.3)]  # so that threads have run before the fork
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map(ask, (0.1, 0.2, 0.3)) == expected


def test_geometries_outlive_their_names():
    query = fcl_prob.PreparedQuery(torus(), fcl_prob.Box(0.4, 0.4, 0.25))
    group = fcl_prob.GroupQuery([torus()], [fcl_prob.Box(0.4, 0.4, 0.25)])
    gc.collect()
    first = query.collision_probability(ERROR, [0.4, 0, 0])
    assert first == query.collision_probability(ERROR, [0.4, 0, 0])
    assert group.collision_probability(ERROR, [pose(0.4)]).lower == first.lower


def test_nothing_leaks():
    def once():
        mesh = fcl_prob.Mesh(torus().vertices, torus().triangles)
        query = fcl_prob.PreparedQuery(mesh, PART)
        query.collision_probabilities(ERROR, np.full((5, 3), 0.4)).to_dict()
        for bad in (lambda: fcl_prob.Box(-1, 1, 1), lambda: query.collision_probability(ERROR, method="x")):
            with pytest.raises(fcl_prob.Error):
                bad()

    once()
    gc.collect()
    before = sys.getallocatedblocks()
    for _ in range(50):
        once()
    gc.collect()
    assert sys.getallocatedblocks() - before < 500
