// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries of pairs and groups as Python has them.
#pragma once

#include <pybind11/pybind11.h>

namespace fcl_prob::python {

void bindQueries(pybind11::module_& module);

}  // namespace fcl_prob::python
