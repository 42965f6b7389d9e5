// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Keyword arguments as a request.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

#include "fcl_prob/pose_error.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob::python {

namespace py = pybind11;

struct Question {
  ProbabilityRequest request;  ///< without on_progress, which is not called without the GIL
  std::optional<py::function> on_progress;
  bool threads_are_given = false;
};

/// Every keyword is a field of ProbabilityRequest. \throws py::type_error for another one or a
/// value of the wrong kind, InvalidRequest for a value out of range
Question questionFrom(const py::kwargs& keywords);

/// A name of a convention as the command line has it. \throws InvalidRequest
PoseConvention conventionFrom(const std::string& name);
std::string toString(PoseConvention convention);

/// A callable, or None for nothing. \throws py::type_error
std::optional<py::function> progressFrom(py::handle value);

/// 'fcl', 'solid' or 'contained'. \throws InvalidRequest
ContactMeaning contactFrom(py::handle value);

}  // namespace fcl_prob::python
