// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Results as Python has them.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <optional>
#include <string>

#include "base/decision.h"
#include "fcl_prob/probability_result.h"
#include "python/running.h"

namespace fcl_prob::python {

namespace py = pybind11;

template <class Value>
py::object orNone(const std::optional<Value>& value) {
  return value ? py::cast(*value) : py::none();
}

/// (lower, upper).
inline py::tuple pairOf(const Bounds& bounds) { return py::make_tuple(bounds.lower, bounds.upper); }

/// (lower, upper), or None.
inline py::object pairOf(const std::optional<Bounds>& bounds) {
  return bounds ? py::object(pairOf(*bounds)) : py::none();
}

// In the order of their values.
inline constexpr std::array<Decision, 4> kDecisions = {Decision::none, Decision::below,
                                                       Decision::above, Decision::undecided};
inline constexpr std::array<ProbabilityStatus, 11> kStatuses = {
    ProbabilityStatus::converged,        ProbabilityStatus::exact,
    ProbabilityStatus::decided,          ProbabilityStatus::bound_only,
    ProbabilityStatus::sampled,          ProbabilityStatus::time_limit,
    ProbabilityStatus::cell_limit,       ProbabilityStatus::memory_limit,
    ProbabilityStatus::resolution_limit, ProbabilityStatus::cancelled,
    ProbabilityStatus::band_limit};

/// None, "below", "above" or "undecided".
py::object decisionOf(Decision decision);

/// Answers as arrays, of which an array is not written before it is asked for.
struct BatchArrays {
  Answers answers;
};

void bindResults(py::module_& module);
void bindBatchResult(py::module_& module);

/// Queries of pairs and groups, which give them.
void bindQueries(py::module_& module);

}  // namespace fcl_prob::python
