// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The extension module fcl_prob._core: all but files and robots.
#include <pybind11/pybind11.h>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/version.h"
#include "python/displacements.h"
#include "python/geometries.h"
#include "python/results.h"

namespace fcl_prob::python {
namespace {

void raise(const char* name, const char* message) {
  const py::object type = py::module_::import("fcl_prob._errors").attr(name);
  // Messages may hold names of files, which need not be UTF-8.
  const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
      message, static_cast<Py_ssize_t>(std::char_traits<char>::length(message)), "replace"));
  PyErr_SetObject(type.ptr(), text.ptr());
}

/// From now on each class of fcl_prob/exceptions.h becomes the one of its name in
/// fcl_prob._errors.
void translateExceptions() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InvalidDistribution& error) {
      raise("InvalidDistribution", error.what());
    } catch (const InvalidPose& error) {
      raise("InvalidPose", error.what());
    } catch (const InvalidGeometry& error) {
      raise("InvalidGeometry", error.what());
    } catch (const UnsupportedGeometry& error) {
      raise("UnsupportedGeometry", error.what());
    } catch (const OpenMesh& error) {
      raise("OpenMesh", error.what());
    } catch (const InvalidRequest& error) {
      raise("InvalidRequest", error.what());
    } catch (const FileError& error) {
      raise("FileError", error.what());
    } catch (const Exception& error) {
      raise("Error", error.what());
    }
  });
}

}  // namespace
}  // namespace fcl_prob::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "Collision probabilities: see the package fcl_prob.";
  module.attr("__version__") = FCL_PROB_VERSION;
  fcl_prob::python::translateExceptions();
  fcl_prob::python::bindGeometries(module);
  fcl_prob::python::bindDisplacements(module);
  fcl_prob::python::bindResults(module);
  fcl_prob::python::bindQueries(module);
}
