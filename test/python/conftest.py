# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
