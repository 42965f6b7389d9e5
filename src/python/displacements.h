// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Displacements and errors of poses as Python has them.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <variant>
#include <vector>

#include "fcl_prob/mixture.h"
#include "fcl_prob/pose_error.h"

namespace fcl_prob::python {

namespace py = pybind11;

/// A value with the call that made it, as (name of the maker, arguments): to make it again from its
/// numbers would not give the same last bits. What Python sees in place of the library's class.
template <class Value>
struct Made : Value {
  Made(Value value, py::tuple recipe) : Value(std::move(value)), made_by(std::move(recipe)) {}
  py::tuple made_by;
};

using MadeGaussian = Made<GaussianDisplacement>;
using MadeMixture = Made<GaussianMixture>;
using MadeTruncated = Made<TruncatedGaussian>;
using MadePoseError = Made<PoseError>;

/// What may be random of a pose.
using Randomness =
    std::variant<GaussianDisplacement, GaussianMixture, TruncatedGaussian, PoseError>;

/// A displacement of this package. \throws py::type_error
Randomness randomnessFrom(py::handle value, const std::string& name);

/// One, or one for each of several queries.
struct ManyDisplacements {
  bool many = false;
  std::vector<Randomness> all;
  const Randomness& at(std::size_t i) const { return all[many ? i : 0]; }
};

/// \param displacement  one or a list of them, or None where covariances are given
/// \param covariances   (n, 3, 3) or (3, 3), square metres; (n, 6, 6) or (6, 6) of pose errors
/// \param means         None: 0; (n, 3) or (3,), or of six
ManyDisplacements displacementsFrom(py::handle displacement, py::handle covariances,
                                    py::handle means, const std::string& convention);

void bindDisplacements(py::module_& module);

}  // namespace fcl_prob::python
