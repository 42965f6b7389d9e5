# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the fcl_prob authors
import os
from typing import Union

from ._core import Mesh

def load_mesh(
    path: Union[str, os.PathLike[str]], *, normalize: bool = False, scale: float = 1.0, isolated: bool = True
) -> Mesh: ...
