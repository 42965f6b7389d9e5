// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The extension module fcl_prob._core: all but files and robots.
#include <pybind11/pybind11.h>

#include "fcl_prob/version.h"
#include "python/displacements.h"
#include "python/exceptions.h"
#include "python/geometries.h"
#include "python/queries.h"
#include "python/results.h"

PYBIND11_MODULE(_core, module) {
  module.doc() = "Collision probabilities: see the package fcl_prob.";
  module.attr("__version__") = FCL_PROB_VERSION;
  fcl_prob::python::translateExceptions();
  fcl_prob::python::bindGeometries(module);
  fcl_prob::python::bindDisplacements(module);
  fcl_prob::python::bindResults(module);
  fcl_prob::python::bindQueries(module);
}
