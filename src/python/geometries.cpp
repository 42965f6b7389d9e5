// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/geometries.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <pybind11/stl.h>

#include <cmath>
#include <optional>
#include <sstream>

#include "geometry/validation.h"
#include "python/arrays.h"
#include "python/pickled.h"

namespace fcl_prob::python {

/// A mesh from a file about which something is to be said. Not in an unnamed namespace, where the
/// extension modules would each have a type of their own.
struct ReadModel : fcl::BVHModel<fcl::OBBRSSd> {
  ReadModel(const fcl::BVHModel<fcl::OBBRSSd>& model, ReadingNotes said)
      : fcl::BVHModel<fcl::OBBRSSd>(model), reading(std::move(said)) {}
  ReadingNotes reading;
};

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

static_assert(sizeof(fcl::Triangle) == 3 * sizeof(std::size_t), "seen from Python as (m, 3)");
static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "seen from Python as (n, 3)");

/// \throws InvalidGeometry if a size is not finite and positive
template <class Shape>
std::shared_ptr<Shape> checked(std::shared_ptr<Shape> shape, const char* name) {
  detail::validateGeometry(shape.get(), name);
  shape->computeLocalAABB();
  return shape;
}

std::string textOf(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return text.str();
}

py::object meshArray(const std::shared_ptr<Model>& model, const void* data, const char* format,
                     int rows) {
  return readOnlyArray({model, data, format, 8, {rows, 3}});
}

py::object verticesOf(const std::shared_ptr<Model>& model) {
  return meshArray(model, model->vertices, "d", model->num_vertices);
}

py::object trianglesOf(const std::shared_ptr<Model>& model) {
  return meshArray(model, model->tri_indices, "l", model->num_tris);
}

TriangleMesh meshOf(py::handle vertices, py::handle triangles) {
  TriangleMesh mesh;
  mesh.vertices = pointsFrom(vertices, "vertices");
  mesh.triangles = trianglesFrom(triangles, mesh.vertices.size(), "triangles");
  return mesh;
}

std::shared_ptr<Model> meshFromArrays(py::handle vertices, py::handle triangles) {
  return modelOf(meshOf(vertices, triangles));
}

/// Nothing if there is none; what else goes wrong in getting it comes out.
std::optional<py::object> attributeOf(py::handle object, const char* name) {
  PyObject* value = PyObject_GetAttrString(object.ptr(), name);
  if (value != nullptr) return py::reinterpret_steal<py::object>(value);
  if (PyErr_ExceptionMatches(PyExc_AttributeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  return std::nullopt;
}

/// What trimesh, Open3D and others have; nullptr if it is no mesh.
std::shared_ptr<Model> meshFromObject(py::handle object) {
  const auto vertices = attributeOf(object, "vertices");
  if (!vertices) return nullptr;
  for (const char* name : {"faces", "triangles"}) {
    if (const auto faces = attributeOf(object, name)) return meshFromArrays(*vertices, *faces);
  }
  return nullptr;
}

std::shared_ptr<Model> makeMesh(const py::object& vertices, const py::object& triangles) {
  if (!triangles.is_none()) return meshFromArrays(vertices, triangles);
  if (std::shared_ptr<Model> mesh = meshFromObject(vertices)) return mesh;
  throw py::type_error(
      "Mesh needs vertices and triangles, or an object that has vertices and "
      "faces or triangles, not " +
      python::textOf(vertices));
}

void bindMesh(py::module_& module) {
  py::class_<Model, fcl::CollisionGeometryd, std::shared_ptr<Model>>(
      module, "Mesh",
      "A surface of triangles, with a tree of bounding volumes over it.\n\n"
      "Mesh(vertices, triangles): vertices (n, 3) float64, metres, in the mesh's own frame;\n"
      "triangles (m, 3) whole numbers, three rows of vertices each. Mesh(mesh) takes a\n"
      "trimesh.Trimesh, an Open3D TriangleMesh, or anything that has `vertices` and `faces` or\n"
      "`triangles`. Immutable.\n\n"
      "Raises InvalidGeometry for no triangle, an index out of range, a coordinate that is not\n"
      "finite.")
      .def(py::init(&makeMesh), py::arg("vertices"), py::arg("triangles") = py::none())
      .def_property_readonly("vertices", &verticesOf,
                             "(n, 3) float64, metres: the mesh's own memory, read-only.")
      .def_property_readonly("triangles", &trianglesOf,
                             "(m, 3) int64: the mesh's own memory, read-only.")
      .def_property_readonly(
          "notes", [](const Model& mesh) { return readingNotesOf(mesh).notes; },
          "What load_mesh passed over in the file, in sentences; robots' answers repeat it of\n"
          "obstacles.")
      .def_property_readonly(
          "coordinate_error",
          [](const Model& mesh) { return readingNotesOf(mesh).coordinate_error; },
          "Metres: how far a coordinate may be from the file's, where it was read in single\n"
          "precision; 0 otherwise.")
      .def("__repr__",
           [](const Model& mesh) {
             return "<Mesh of " + std::to_string(mesh.num_vertices) + " vertices and " +
                    std::to_string(mesh.num_tris) + " triangles>";
           })
      .def(pickledAs<std::shared_ptr<Model>>(
          [](const std::shared_ptr<Model>& mesh) {
            const ReadingNotes reading = readingNotesOf(*mesh);
            return py::make_tuple(verticesOf(mesh), trianglesOf(mesh), reading.coordinate_error,
                                  reading.notes);
          },
          [](const py::tuple& state) {
            TriangleMesh mesh = meshOf(state[0], state[1]);
            mesh.coordinate_error = state[2].cast<double>();
            mesh.notes = state[3].cast<std::vector<std::string>>();
            return modelOf(mesh);
          }));
}

template <class Shape>
using ShapeClass = py::class_<Shape, fcl::CollisionGeometryd, std::shared_ptr<Shape>>;

std::shared_ptr<fcl::Boxd> makeBox(double x, double y, double z) {
  return checked(std::make_shared<fcl::Boxd>(x, y, z), "Box");
}

std::shared_ptr<fcl::Ellipsoidd> makeEllipsoid(double a, double b, double c) {
  return checked(std::make_shared<fcl::Ellipsoidd>(a, b, c), "Ellipsoid");
}

std::shared_ptr<fcl::Sphered> makeSphere(double radius) {
  return checked(std::make_shared<fcl::Sphered>(radius), "Sphere");
}

void bindBoxAndBalls(py::module_& module) {
  ShapeClass<fcl::Boxd>(module, "Box",
                        "Box(x, y, z): side lengths, metres; centred at its origin. A solid.")
      .def(py::init(&makeBox), py::arg("x"), py::arg("y"), py::arg("z"))
      .def_property_readonly(
          "sides", [](const fcl::Boxd& box) { return vectorArray(box.side); },
          "(3,) float64, metres.")
      .def("__repr__", [](const fcl::Boxd& box) { return "Box" + textOf(box.side); })
      .def(pickledAs<const fcl::Boxd&>(
          [](const fcl::Boxd& b) { return py::make_tuple(b.side[0], b.side[1], b.side[2]); },
          [](const py::tuple& s) {
            return makeBox(s[0].cast<double>(), s[1].cast<double>(), s[2].cast<double>());
          }));
  ShapeClass<fcl::Ellipsoidd>(module, "Ellipsoid",
                              "Ellipsoid(x, y, z): radii, metres; centred at its origin. A solid.")
      .def(py::init(&makeEllipsoid), py::arg("x"), py::arg("y"), py::arg("z"))
      .def_property_readonly(
          "radii", [](const fcl::Ellipsoidd& e) { return vectorArray(e.radii); },
          "(3,) float64, metres.")
      .def("__repr__", [](const fcl::Ellipsoidd& e) { return "Ellipsoid" + textOf(e.radii); })
      .def(pickledAs<const fcl::Ellipsoidd&>(
          [](const fcl::Ellipsoidd& e) {
            return py::make_tuple(e.radii[0], e.radii[1], e.radii[2]);
          },
          [](const py::tuple& s) {
            return makeEllipsoid(s[0].cast<double>(), s[1].cast<double>(), s[2].cast<double>());
          }));
  ShapeClass<fcl::Sphered>(module, "Sphere",
                           "Sphere(radius): metres; centred at its origin. A solid.")
      .def(py::init(&makeSphere), py::arg("radius"))
      .def_readonly("radius", &fcl::Sphered::radius, "Metres.")
      .def("__repr__",
           [](const fcl::Sphered& sphere) {
             std::ostringstream text;
             text << "Sphere(" << sphere.radius << ")";
             return text.str();
           })
      .def(pickledAs<const fcl::Sphered&>(
          [](const fcl::Sphered& s) { return py::make_tuple(s.radius); },
          [](const py::tuple& s) { return makeSphere(s[0].cast<double>()); }));
}

/// A shape around the axis z.
template <class Shape>
std::shared_ptr<Shape> makeRound(const char* name, double radius, double length) {
  return checked(std::make_shared<Shape>(radius, length), name);
}

template <class Shape>
void bindRound(py::module_& module, const char* name, const char* documentation) {
  ShapeClass<Shape>(module, name, documentation)
      .def(py::init([name](double radius, double length) {
             return makeRound<Shape>(name, radius, length);
           }),
           py::arg("radius"), py::arg("length"))
      .def_readonly("radius", &Shape::radius, "Metres.")
      .def_readonly("length", &Shape::lz, "Metres.")
      .def("__repr__",
           [name](const Shape& shape) {
             std::ostringstream text;
             text << name << "(radius=" << shape.radius << ", length=" << shape.lz << ")";
             return text.str();
           })
      .def(pickledAs<const Shape&>([](const Shape& s) { return py::make_tuple(s.radius, s.lz); },
                                   [name](const py::tuple& s) {
                                     return makeRound<Shape>(name, s[0].cast<double>(),
                                                             s[1].cast<double>());
                                   }));
}

/// Normalised before FCL does, which would scale the offset, too.
template <class Shape>
std::shared_ptr<Shape> makeFlat(const char* name, const Eigen::Vector3d& normal, double offset) {
  const double length = normal.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length) || !std::isfinite(offset)) {
    throw InvalidGeometry(std::string(name) + ": normal " + textOf(normal) + ", offset " +
                          std::to_string(offset));
  }
  return checked(std::make_shared<Shape>(Eigen::Vector3d(normal / length), offset), name);
}

template <class Shape>
void bindFlat(py::module_& module, const char* name, const char* documentation) {
  ShapeClass<Shape>(module, name, documentation)
      .def(py::init([name](const py::object& normal, double offset) {
             return makeFlat<Shape>(name, vectorFrom(normal, "normal"), offset);
           }),
           py::arg("normal"), py::arg("offset"))
      .def_property_readonly(
          "normal", [](const Shape& shape) { return vectorArray(shape.n); },
          "Unit normal, (3,) float64.")
      .def_readonly("offset", &Shape::d, "Metres.")
      .def("__repr__",
           [name](const Shape& shape) {
             std::ostringstream text;
             text << name << "(normal=" << textOf(shape.n) << ", offset=" << shape.d << ")";
             return text.str();
           })
      .def(pickledAs<const Shape&>(
          [](const Shape& s) { return py::make_tuple(vectorArray(s.n), s.d); },
          [name](const py::tuple& s) {
            const Eigen::Vector3d normal = vectorFrom(s[0], "normal");
            auto shape = makeFlat<Shape>(name, normal, s[1].cast<double>());
            // To normalise it once more would change its last bits.
            shape->n = normal;
            shape->d = s[1].cast<double>();
            return shape;
          }));
}

}  // namespace

std::shared_ptr<Model> modelOf(const TriangleMesh& mesh) {
  const py::gil_scoped_release released;
  std::shared_ptr<Model> model = buildModel<fcl::OBBRSSd>(mesh);
  if (mesh.notes.empty() && mesh.coordinate_error == 0.0) return model;
  return std::make_shared<ReadModel>(*model, ReadingNotes{mesh.coordinate_error, mesh.notes});
}

ReadingNotes readingNotesOf(const fcl::CollisionGeometryd& geometry) {
  const auto* read = dynamic_cast<const ReadModel*>(&geometry);
  return read == nullptr ? ReadingNotes() : read->reading;
}

Geometry geometryFrom(py::handle value, const std::string& name) {
  if (py::isinstance<fcl::CollisionGeometryd>(value)) {
    return value.cast<std::shared_ptr<fcl::CollisionGeometryd>>();
  }
  if (std::shared_ptr<Model> mesh = meshFromObject(value)) return mesh;
  throw py::type_error(name +
                       " must be a Geometry, or a mesh that has vertices and faces or "
                       "triangles, not " +
                       python::textOf(value));
}

std::vector<Geometry> geometriesFrom(py::handle values, const std::string& name) {
  if (!py::isinstance<py::iterable>(values)) {
    throw py::type_error(name + " must be a list of geometries, not " + python::textOf(values));
  }
  std::vector<Geometry> geometries;
  for (const py::handle value : py::reinterpret_borrow<py::iterable>(values)) {
    geometries.push_back(geometryFrom(value, name + "[" + std::to_string(geometries.size()) + "]"));
  }
  return geometries;
}

void bindGeometries(py::module_& module) {
  py::class_<fcl::CollisionGeometryd, std::shared_ptr<fcl::CollisionGeometryd>>(
      module, "Geometry", "A mesh or a shape, in its own frame, metres.");
  bindMesh(module);
  bindBoxAndBalls(module);
  bindRound<fcl::Capsuled>(module, "Capsule",
                           "Capsule(radius, length): metres; length is that of its cylinder along "
                           "z. Centred at its origin. A solid.");
  bindRound<fcl::Coned>(module, "Cone",
                        "Cone(radius, length): metres; along z, its origin half way up. A solid.");
  bindRound<fcl::Cylinderd>(module, "Cylinder",
                            "Cylinder(radius, length): metres; along z, centred at its origin. A "
                            "solid.");
  bindFlat<fcl::Halfspaced>(module, "Halfspace",
                            "Halfspace(normal, offset): normal·x <= offset, metres; the normal "
                            "(3,) is normalised. A solid.");
  bindFlat<fcl::Planed>(module, "Plane",
                        "Plane(normal, offset): normal·x = offset, metres; the normal (3,) is "
                        "normalised.");
}

}  // namespace fcl_prob::python
