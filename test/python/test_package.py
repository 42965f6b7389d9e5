# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""The package as such: what it imports, its types and documentation."""
import ast
import importlib
import inspect
import os
import pathlib
import subprocess
import sys

import pytest
from scenes import DATA, needs_io, needs_robot

import fcl_prob

PACKAGE = pathlib.Path(fcl_prob.__file__).parent
MODULES = ["_core"] + ["_io"] * needs_io.args.count(False) + ["_robot"] * needs_robot.args.count(False)


def test_version_is_the_projects():
    assert fcl_prob.__version__ == os.environ["FCL_PROB_VERSION"]


def test_import_takes_no_library_that_only_parts_need():
    code = (
        "import fcl_prob; fcl_prob.collision_probability(fcl_prob.Box(1, 1, 1), fcl_prob.Box(1, 1, 1),"
        " fcl_prob.GaussianDisplacement()); print(open('/proc/self/maps').read())"
    )
    maps = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout
    for library in ("libassimp", "libpcl", "libompl", "libxml2", "liborocos", "libminizip"):
        assert library not in maps
    assert "libfcl" in maps


@needs_io
def test_meshes_from_files():
    mesh = fcl_prob.load_mesh(DATA / "mug.obj")
    assert len(mesh.triangles) == 3424
    normalized = fcl_prob.load_mesh(str(DATA / "mug.obj"), normalize=True, scale=2.0)
    extent = normalized.vertices.max(axis=0) - normalized.vertices.min(axis=0)
    assert extent.max() == pytest.approx(2.0)
    with pytest.raises(fcl_prob.FileError, match="none.stl"):
        fcl_prob.load_mesh("none.stl")
    with pytest.raises(fcl_prob.InvalidRequest, match="scale"):
        fcl_prob.load_mesh(DATA / "mug.obj", scale=-1.0)
    with pytest.raises(fcl_prob.FileError):
        fcl_prob.load_mesh(b"\xff\xfe.stl")
    with pytest.raises(TypeError):
        fcl_prob.load_mesh(3)


def test_parts_that_are_missing_are_named():
    with pytest.raises(AttributeError, match="nothing"):
        fcl_prob.nothing
    assert "load_mesh" in dir(fcl_prob)


def stub_of(module):
    """Names of a stub: {class: its members}, functions as classes without members."""
    names = {}
    for node in ast.parse((PACKAGE / f"{module}.pyi").read_text()).body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        elif isinstance(node, ast.FunctionDef):
            names[node.name] = set()
    return names


@pytest.mark.parametrize("module", MODULES)
def test_stubs_name_what_there_is(module):
    runtime = importlib.import_module(f"fcl_prob.{module}")
    stub = stub_of(module)
    public = {name for name in vars(runtime) if not name.startswith("_")}
    assert public == set(stub)
    for name in public:
        value = getattr(runtime, name)
        assert value.__doc__, name
        if inspect.isclass(value):
            members = {member for member in vars(value) if not member.startswith("_")}
            assert members == {member for member in stub[name] if not member.startswith("_")}, name


def test_keywords_are_those_of_the_stub():
    """A request with every keyword that the stub has, at its default."""
    tree = ast.parse((PACKAGE / "_core.pyi").read_text())
    function = next(n for n in tree.body if isinstance(n, ast.FunctionDef) and n.name == "collision_probability")
    defaults = {
        argument.arg: ast.literal_eval(value)
        for argument, value in zip(function.args.kwonlyargs, function.args.kw_defaults)
        if not (isinstance(value, ast.Constant) and value.value is ...)
    }
    box, still = fcl_prob.Box(1, 1, 1), fcl_prob.GaussianDisplacement()
    assert fcl_prob.collision_probability(box, box, still, **defaults) == fcl_prob.collision_probability(box, box, still)
    with pytest.raises(TypeError) as error:
        fcl_prob.collision_probability(box, box, still, unknown=1)
    known = str(error.value).split("request are ")[1].split()
    assert known == [argument.arg for argument in function.args.kwonlyargs]


def test_types_are_checked_by_mypy():
    pytest.importorskip("mypy")
    # mypy does not look into site packages without installing them: the build tree is a path to it.
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir=/dev/null", "-p", "fcl_prob"],
        capture_output=True,
        text=True,
        env={**os.environ, "MYPYPATH": str(PACKAGE.parent)},
        cwd=PACKAGE.parent,
    )
    assert run.returncode == 0, run.stdout
