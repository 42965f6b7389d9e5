// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Shapes and meshes as Python has them.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/collision_geometry.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::python {

namespace py = pybind11;

using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;

/// A Geometry of this package, or a mesh of anybody: whatever has `vertices` and `faces` or
/// `triangles`. \throws py::type_error for anything else, InvalidGeometry
Geometry geometryFrom(py::handle value, const std::string& name);
std::vector<Geometry> geometriesFrom(py::handle values, const std::string& name);

/// The mesh as a geometry of Python; its tree is built without the GIL.
std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> modelOf(const TriangleMesh& mesh);

/// What was said when a mesh was read: as in TriangleMesh.
struct ReadingNotes {
  double coordinate_error = 0.0;  ///< metres
  std::vector<std::string> notes;
};
/// Nothing to say for what was not read from a file.
ReadingNotes readingNotesOf(const fcl::CollisionGeometryd& geometry);

void bindGeometries(py::module_& module);

}  // namespace fcl_prob::python
