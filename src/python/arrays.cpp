// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/arrays.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include "fcl_prob/exceptions.h"
#include "gaussian/rotation.h"
#include "geometry/validation.h"

namespace fcl_prob::python {
namespace {

py::object numpy(const char* name) { return py::module_::import("numpy").attr(name); }

std::string shapeText(const py::ssize_t* sizes, int count) {
  std::string text = "(";
  for (int i = 0; i < count; ++i) text += (i > 0 ? ", " : "") + std::to_string(sizes[i]);
  return text + (count == 1 ? ",)" : ")");
}

/// An array of `kinds` of numbers ("f", "i", "u"), whatever numpy.asarray makes of `value`.
py::object numericArray(py::handle value, const std::string& kinds, const std::string& name,
                        const std::string& expected) {
  py::object array;
  try {
    array = numpy("asarray")(value);
  } catch (py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw py::type_error(name + " must be an array of " + expected + ", not " + textOf(value));
  }
  const std::string kind = array.attr("dtype").attr("kind").cast<std::string>();
  const bool is_empty = array.attr("size").cast<std::size_t>() == 0;
  if (kinds.find(kind) == std::string::npos && !(is_empty && kind == "f")) {
    throw py::type_error(name + " must hold " + expected + ", not " + textOf(array.attr("dtype")) +
                         ": " + textOf(value));
  }
  return array;
}

fcl::Transform3d rigid(const fcl::Transform3d& pose, const std::string& name) {
  detail::validatePose(pose, name);
  return pose;
}

/// Three numbers, six or seven.
fcl::Transform3d poseOfNumbers(const std::vector<double>& numbers, const std::string& name) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() << numbers[0], numbers[1], numbers[2];
  if (numbers.size() == 6) {
    pose.linear() = detail::rotationOfAngles({numbers[3], numbers[4], numbers[5]}, name);
  }
  if (numbers.size() == 7) {
    const Eigen::Quaterniond quaternion(numbers[3], numbers[4], numbers[5], numbers[6]);
    const double norm = quaternion.norm();
    if (!(norm > 0.0) || !std::isfinite(norm)) {
      throw InvalidPose(name + ": the quaternion has the norm " + std::to_string(norm));
    }
    pose.linear() = quaternion.normalized().toRotationMatrix();
  }
  return rigid(pose, name);
}

/// \param at  of row and column
template <class At>
fcl::Transform3d poseOfMatrix(const At& at, const std::string& name) {
  constexpr double kTolerance = 1e-9;
  for (int column = 0; column < 4; ++column) {
    const double expected = column == 3 ? 1.0 : 0.0;
    if (!(std::abs(at(3, column) - expected) <= kTolerance)) {
      throw InvalidPose(name + ": the last row of the matrix must be 0, 0, 0, 1, but has " +
                        std::to_string(at(3, column)));
    }
  }
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.linear()(row, column) = at(row, column);
    pose.translation()[row] = at(row, 3);
  }
  return rigid(pose, name);
}

bool isPoseLength(std::size_t length) { return length == 3 || length == 6 || length == 7; }

constexpr const char* kPoseShapes = "(4, 4), (3,), (6,) or (7,)";

fcl::Transform3d onePose(const Numbers& numbers) {
  if (numbers.hasShape({4, 4})) {
    return poseOfMatrix([&](int i, int j) { return numbers.at(i, j); }, numbers.name());
  }
  if (numbers.dimensions() != 1 || !isPoseLength(numbers.size(0))) {
    numbers.refuseShape(kPoseShapes);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < numbers.size(0); ++i) values.push_back(numbers.at(i));
  return poseOfNumbers(values, numbers.name());
}

std::vector<fcl::Transform3d> manyPoses(const Numbers& numbers) {
  std::vector<fcl::Transform3d> poses;
  poses.reserve(numbers.size(0));
  for (std::size_t i = 0; i < numbers.size(0); ++i) {
    const auto name = [&] { return numbers.name() + "[" + std::to_string(i) + "]"; };
    if (numbers.dimensions() == 3) {
      poses.push_back(poseOfMatrix([&](int r, int c) { return numbers.at(i, r, c); }, name()));
    } else {
      std::vector<double> values;
      for (std::size_t j = 0; j < numbers.size(1); ++j) values.push_back(numbers.at(i, j));
      poses.push_back(poseOfNumbers(values, name()));
    }
  }
  return poses;
}

}  // namespace

Numbers::Numbers(py::handle value, std::string name)
    : name_(std::move(name)), owner_(py::reinterpret_borrow<py::object>(value)) {
  if (view(value)) return;
  owner_ = numericArray(value, "fiu", name_, "real numbers").attr("astype")("float64");
  if (!view(owner_)) throw py::type_error(name_ + " cannot be read as numbers");
}

bool Numbers::view(py::handle value) {
  if (PyObject_CheckBuffer(value.ptr()) == 0) return false;
  if (PyObject_GetBuffer(value.ptr(), &view_, PyBUF_FORMAT | PyBUF_STRIDES) != 0) {
    PyErr_Clear();
    return false;
  }
  held_.reset(&view_);
  // Without dimensions there is nothing to look at; asarray tells what it is instead.
  if (view_.format != nullptr && std::strcmp(view_.format, "d") == 0 && view_.itemsize == 8) {
    return true;
  }
  held_.reset();
  return false;
}

double Numbers::read(std::ptrdiff_t bytes) const {
  double value;
  std::memcpy(&value, static_cast<const char*>(view_.buf) + bytes, sizeof value);
  return value;
}

std::string Numbers::shape() const { return shapeText(view_.shape, view_.ndim); }

bool Numbers::hasShape(std::initializer_list<std::ptrdiff_t> sizes) const {
  if (static_cast<std::size_t>(view_.ndim) != sizes.size()) return false;
  int axis = 0;
  for (const std::ptrdiff_t size : sizes) {
    if (size >= 0 && view_.shape[axis] != size) return false;
    ++axis;
  }
  return true;
}

void Numbers::refuseShape(const std::string& expected) const {
  throw py::value_error(name_ + " must have the shape " + expected + ", not " + shape());
}

Eigen::Vector3d vectorFrom(py::handle value, const std::string& name) {
  const Numbers numbers(value, name);
  if (!numbers.hasShape({3})) numbers.refuseShape("(3,)");
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

Eigen::Matrix3d matrixFrom(py::handle value, const std::string& name) {
  const Numbers numbers(value, name);
  if (!numbers.hasShape({3, 3})) numbers.refuseShape("(3, 3)");
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix(i, j) = numbers.at(i, j);
  }
  return matrix;
}

fcl::Transform3d poseFrom(py::handle value, const std::string& name) {
  if (value.is_none()) return fcl::Transform3d::Identity();
  return onePose(Numbers(value, name));
}

Poses::Poses(py::handle value, const std::string& name) {
  if (value.is_none()) {
    poses_.push_back(fcl::Transform3d::Identity());
    return;
  }
  const Numbers numbers(value, name);
  if (numbers.hasShape({-1, 4, 4}) ||
      (numbers.dimensions() == 2 && isPoseLength(numbers.size(1)))) {
    many_ = true;
    poses_ = manyPoses(numbers);
  } else if (numbers.hasShape({0})) {
    many_ = true;
  } else if (numbers.hasShape({4, 4}) || numbers.dimensions() == 1) {
    poses_.push_back(onePose(numbers));
  } else {
    numbers.refuseShape(std::string(kPoseShapes) + ", or (n, 4, 4), (n, 3), (n, 6) or (n, 7)");
  }
}

std::vector<Eigen::Vector3d> pointsFrom(py::handle value, const std::string& name) {
  const Numbers numbers(value, name);
  if (numbers.hasShape({0})) return {};
  if (!numbers.hasShape({-1, 3})) numbers.refuseShape("(n, 3)");
  std::vector<Eigen::Vector3d> points;
  points.reserve(numbers.size(0));
  for (std::size_t i = 0; i < numbers.size(0); ++i) {
    points.emplace_back(numbers.at(i, 0), numbers.at(i, 1), numbers.at(i, 2));
  }
  return points;
}

std::vector<fcl::Triangle> trianglesFrom(py::handle value, std::size_t limit,
                                         const std::string& name) {
  py::object array = numericArray(value, "iu", name, "whole numbers");
  if (array.attr("dtype").attr("kind").cast<std::string>() == "u" && py::len(array) > 0 &&
      py::bool_(array.attr("max")().attr("__gt__")(INT64_MAX))) {
    throw InvalidGeometry(name + ": index " + textOf(array.attr("max")()) + ", but there are " +
                          std::to_string(limit) + " vertices");
  }
  array = numpy("ascontiguousarray")(array, "int64");
  const py::buffer_info info = py::reinterpret_borrow<py::buffer>(array).request();
  if (info.size == 0) return {};
  if (info.ndim != 2 || info.shape[1] != 3) {
    throw py::value_error(name + " must have the shape (m, 3), not " +
                          shapeText(info.shape.data(), static_cast<int>(info.ndim)));
  }
  const auto* index = static_cast<const std::int64_t*>(info.ptr);
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(info.shape[0]));
  for (py::ssize_t i = 0; i < info.shape[0]; ++i, index += 3) {
    for (int corner = 0; corner < 3; ++corner) {
      if (index[corner] < 0 || static_cast<std::size_t>(index[corner]) >= limit) {
        throw InvalidGeometry(name + "[" + std::to_string(i) + "] has the index " +
                              std::to_string(index[corner]) + ", but there are " +
                              std::to_string(limit) + " vertices");
      }
    }
    triangles.emplace_back(index[0], index[1], index[2]);
  }
  return triangles;
}

namespace {

template <class Value>
py::object filled(const py::object& array, const std::vector<Value>& values) {
  if (!values.empty()) {
    std::memcpy(py::reinterpret_borrow<py::buffer>(array).request(true).ptr, values.data(),
                values.size() * sizeof(Value));
  }
  return array;
}

}  // namespace

py::object arrayOf(const std::vector<double>& values) {
  return filled(numpy("empty")(values.size(), "float64"), values);
}

py::object arrayOf(const std::vector<std::int64_t>& values) {
  return filled(numpy("empty")(values.size(), "int64"), values);
}

py::object vectorArray(const Eigen::Ref<const Eigen::VectorXd>& values) {
  return arrayOf(std::vector<double>(values.data(), values.data() + values.size()));
}

py::object arrayOf(const Eigen::Ref<const Eigen::MatrixXd>& values) {
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) rows.push_back(values(i, j));
  }
  return arrayOf(rows).attr("reshape")(values.rows(), values.cols());
}

void bindMemoryView(py::module_& module) {
  py::class_<MemoryView>(module, "_MemoryView", py::buffer_protocol(), py::module_local())
      .def_buffer([](MemoryView& view) {
        std::vector<py::ssize_t> strides(view.shape.size());
        auto stride = static_cast<py::ssize_t>(view.item_size);
        for (std::size_t axis = view.shape.size(); axis-- > 0; stride *= view.shape[axis]) {
          strides[axis] = stride;
        }
        return py::buffer_info(
            const_cast<void*>(view.data), static_cast<py::ssize_t>(view.item_size), view.format,
            static_cast<py::ssize_t>(view.shape.size()), view.shape, strides, true);
      });
}

py::object readOnlyArray(MemoryView view) { return numpy("asarray")(py::cast(std::move(view))); }

std::string pathFrom(py::handle value) {
  const std::string path = py::module_::import("os").attr("fsencode")(value).cast<std::string>();
  if (path.find('\0') != std::string::npos) {
    throw py::value_error("there is a null byte in the path " + textOf(value));
  }
  return path;
}

std::string textOf(py::handle value) {
  constexpr std::size_t kLongest = 80;
  const auto representation = py::reinterpret_steal<py::object>(PyObject_ASCII(value.ptr()));
  if (!representation) {
    // Its fault shall not hide the one that is to be told.
    PyErr_Clear();
    return std::string("an object of type ") + Py_TYPE(value.ptr())->tp_name;
  }
  const std::string text = representation.cast<std::string>();
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace fcl_prob::python
