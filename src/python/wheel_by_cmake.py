# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""What pip calls to build the package (PEP 517): CMake builds it, and a wheel is a zip file of what CMake
installs. Needs nothing but Python's own library, so that nothing has to be fetched.

Environment: FCL_PROB_CMAKE_ARGS, options for CMake (-DFCL_PROB_WITH_ASSIMP=OFF, ...); FCL_PROB_BUILD_DIR, a
build tree to use and to keep; if it is there already it is taken with the options that it has.
"""
import base64
import hashlib
import os
import pathlib
import re
import shlex
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile

SOURCE_DIR = pathlib.Path(__file__).resolve().parent.parent.parent


def project():
    """The table of pyproject.toml, with the version of the project."""
    table = tomllib.loads((SOURCE_DIR / "pyproject.toml").read_text())["project"]
    table["version"] = re.search(r"<version>(.*)</version>", (SOURCE_DIR / "package.xml").read_text())[1]
    return table


def run(*command):
    print("+", shlex.join(map(str, command)), flush=True)
    subprocess.run(list(map(str, command)), check=True)


def build(build_dir, stage):
    """Installs the package below `stage`. Returns its folder."""
    if not (build_dir / "CMakeCache.txt").exists():
        run(
            *("cmake", "-S", SOURCE_DIR, "-B", build_dir, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON"),
            *("-DFCL_PROB_BUILD_PYTHON=ON", "-DFCL_PROB_BUILD_TESTS=OFF", "-DFCL_PROB_BUILD_CLI=OFF"),
            f"-DPython_EXECUTABLE={sys.executable}",
            *shlex.split(os.environ.get("FCL_PROB_CMAKE_ARGS", "")),
        )
    run("cmake", "--build", build_dir, "--target", "fcl_prob_python", "--parallel", os.cpu_count() or 1)
    run("cmake", "--install", build_dir, "--component", "python", "--prefix", stage)
    return next(stage.rglob("fcl_prob/__init__.py")).parent


def metadata():
    table = project()
    lines = ["Metadata-Version: 2.1", f"Name: {table['name']}", f"Version: {table['version']}"]
    lines += [f"Summary: {table['description']}", f"License: {table['license']['text']}"]
    lines += [f"Requires-Python: {table['requires-python']}"]
    lines += [f"Author: {one['name']}" for one in table["authors"]]
    lines += [f"Classifier: {one}" for one in table["classifiers"]]
    lines += [f"Project-URL: {name}, {address}" for name, address in table["urls"].items()]
    lines += [f"Requires-Dist: {one}" for one in table["dependencies"]]
    lines += ["Description-Content-Type: text/markdown", "", (SOURCE_DIR / table["readme"]).read_text()]
    return "\n".join(lines)


def tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = re.sub(r"[-.]", "_", sysconfig.get_platform())
    return f"{version}-{version}-{platform}"


def write_wheel(path, package):
    table = project()
    info = f"{table['name']}-{table['version']}.dist-info"
    files = {f"fcl_prob/{file.name}": file.read_bytes() for file in sorted(package.iterdir()) if file.is_file()}
    files[f"{info}/METADATA"] = metadata().encode()
    files[f"{info}/WHEEL"] = (
        f"Wheel-Version: 1.0\nGenerator: wheel_by_cmake\nRoot-Is-Purelib: false\nTag: {tag()}\n".encode()
    )
    files[f"{info}/LICENSE"] = (SOURCE_DIR / "LICENSE").read_bytes()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, content in files.items():
            wheel.writestr(name, content)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    table = project()
    name = f"{table['name']}-{table['version']}-{tag()}.whl"
    with tempfile.TemporaryDirectory(prefix="fcl_prob-") as folder:
        temporary = pathlib.Path(folder)
        build_dir = pathlib.Path(os.environ.get("FCL_PROB_BUILD_DIR") or temporary / "build")
        package = build(build_dir, temporary / "stage")
        write_wheel(pathlib.Path(wheel_directory) / name, package)
    return name


def build_sdist(sdist_directory, config_settings=None):
    table = project()
    top = f"{table['name']}-{table['version']}"
    parts = ["CMakeLists.txt", "LICENSE", "README.md", "package.xml", "pyproject.toml", "cmake", "include", "src"]
    with tarfile.open(pathlib.Path(sdist_directory) / f"{top}.tar.gz", "w:gz") as archive:
        for part in parts:
            archive.add(SOURCE_DIR / part, f"{top}/{part}")
    return f"{top}.tar.gz"
