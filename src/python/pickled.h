// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Pickling of values that derived classes of Python add attributes to.
#pragma once

#include <pybind11/pybind11.h>

#include <utility>

namespace fcl_prob::python {

/// \param get  the state of a `Self` (a reference or a shared pointer) as a tuple
/// \param set  what a state stands for
template <class Self, class Get, class Set>
auto pickledAs(Get get, Set set) {
  namespace py = pybind11;
  return py::pickle(
      [get](const py::object& self) {
        return py::make_tuple(get(self.cast<Self>()), py::getattr(self, "__dict__", py::dict()));
      },
      [set](const py::tuple& state) {
        return std::make_pair(set(state[0].cast<py::tuple>()), state[1].cast<py::dict>());
      });
}

}  // namespace fcl_prob::python
