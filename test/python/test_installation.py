# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
"""pip installs the package, from what CMake has built, without a network."""
import email
import os
import subprocess
import sys
import tomllib

import pytest
from scenes import SOURCE_DIR

import fcl_prob


@pytest.mark.parametrize("isolation", [[], ["--no-build-isolation"]])
def test_pip_installs_without_fetching(isolation, tmp_path):
    pytest.importorskip("pip")
    environment = {**os.environ, "FCL_PROB_BUILD_DIR": os.environ["FCL_PROB_BUILD_DIR"], "PIP_NO_INDEX": "1"}
    run = subprocess.run(
        [sys.executable, "-m", "pip", "install", "--no-index", "--no-cache-dir", "--disable-pip-version-check"]
        + [*isolation, "--no-deps", "--target", str(tmp_path / "site"), str(SOURCE_DIR)],
        capture_output=True,
        text=True,
        env=environment,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    code = "import fcl_prob; print(fcl_prob.__file__, fcl_prob.__version__, fcl_prob.Box(1, 2, 3))"
    environment["PYTHONPATH"] = str(tmp_path / "site")
    out = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, env=environment, check=True, cwd=tmp_path
    ).stdout
    assert out.startswith(str(tmp_path)) and f" {fcl_prob.__version__} Box(1, 2, 3)" in out
    metadata = email.message_from_string(
        (tmp_path / "site" / f"fcl_prob-{fcl_prob.__version__}.dist-info" / "METADATA").read_text()
    )
    project = tomllib.loads((SOURCE_DIR / "pyproject.toml").read_text())["project"]
    assert metadata.get_all("Classifier") == project["classifiers"]
    assert metadata.get_payload() == (SOURCE_DIR / "README.md").read_text()
