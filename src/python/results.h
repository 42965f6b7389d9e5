// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Results as Python has them.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>

#include "fcl_prob/probability_result.h"
#include "python/running.h"

namespace fcl_prob::python {

namespace py = pybind11;

template <class Value>
py::object orNone(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::none();
}

/// None, "below", "above" or "undecided".
py::object decisionOf(Decision decision);

/// Answers as arrays, of which an array is not written before it is asked for.
struct BatchResult {
  Answers answers;
};

void bindResults(py::module_& module);

}  // namespace fcl_prob::python
