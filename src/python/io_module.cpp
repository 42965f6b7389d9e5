// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The extension module fcl_prob._io: meshes from files, which takes assimp.
#include <pybind11/pybind11.h>

#include "fcl_prob/mesh_io.h"
#include "python/arrays.h"
#include "python/geometries.h"

namespace py = pybind11;

namespace {

py::object loadMesh(const py::object& path, bool normalize, double scale, bool isolated) {
  const std::string name = fcl_prob::python::pathFrom(path);
  fcl_prob::MeshOptions options;
  options.normalize = normalize;
  options.scale = scale;
  fcl_prob::TriangleMesh mesh;
  {
    const py::gil_scoped_release released;
    mesh = isolated ? fcl_prob::loadMeshIsolated(name, options) : fcl_prob::loadMesh(name, options);
  }
  return py::cast(fcl_prob::python::modelOf(mesh));
}

}  // namespace

PYBIND11_MODULE(_io, module) {
  // Of which Mesh is.
  py::module_::import("fcl_prob._core");
  module.def("load_mesh", &loadMesh, py::arg("path"), py::kw_only(), py::arg("normalize") = false,
             py::arg("scale") = 1.0, py::arg("isolated") = true,
             "The triangles of a STL, OBJ, PLY, OFF, DAE, glTF or GLB file as a Mesh, metres.\n\n"
             "normalize: centre the bounding box at the origin and make its longest side 1 m,\n"
             "before scale: a factor on every coordinate. isolated: read it in a process of its\n"
             "own, so that a crash of the importer on a malformed file is a FileError.\n\n"
             "Raises FileError, InvalidGeometry, InvalidRequest.");
}
