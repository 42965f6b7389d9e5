// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Arrays of numbers from Python and back, by the buffer protocol: whatever layout a float64 array
// has it is read where it lies, and nothing here depends on NumPy's own ABI.
#pragma once

#include <fcl/common/types.h>
#include <fcl/math/triangle.h>
#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace fcl_prob::python {

namespace py = pybind11;

/// An array of float64 in memory that belongs to Python. Needs the GIL all its life.
class Numbers {
 public:
  /// \param value  an array, or anything that numpy.asarray makes one of; integers and single
  ///               precision are converted, everything else is refused
  /// \param name   how messages call it
  /// \throws py::type_error if it does not hold real numbers
  Numbers(py::handle value, std::string name);
  Numbers(const Numbers&) = delete;
  Numbers& operator=(const Numbers&) = delete;

  const std::string& name() const { return name_; }
  int dimensions() const { return static_cast<int>(view_.ndim); }
  std::size_t size(int axis) const { return static_cast<std::size_t>(view_.shape[axis]); }

  /// "(2, 3)"
  std::string shape() const;

  /// Whether the sizes are these; -1 stands for any.
  bool hasShape(std::initializer_list<std::ptrdiff_t> sizes) const;

  /// \throws py::value_error that says what is expected and what was given
  [[noreturn]] void refuseShape(const std::string& expected) const;

  double at(std::size_t i) const { return read(offset(0, i)); }
  double at(std::size_t i, std::size_t j) const { return read(offset(0, i) + offset(1, j)); }
  double at(std::size_t i, std::size_t j, std::size_t k) const {
    return read(offset(0, i) + offset(1, j) + offset(2, k));
  }

 private:
  struct Release {
    void operator()(Py_buffer* view) const { PyBuffer_Release(view); }
  };

  bool view(py::handle value);
  std::ptrdiff_t offset(int axis, std::size_t i) const {
    return view_.strides[axis] * static_cast<std::ptrdiff_t>(i);
  }
  double read(std::ptrdiff_t bytes) const;

  std::string name_;
  py::object owner_;
  Py_buffer view_{};
  std::unique_ptr<Py_buffer, Release> held_;
};

Eigen::Vector3d vectorFrom(py::handle value, const std::string& name);
Eigen::Matrix3d matrixFrom(py::handle value, const std::string& name);

/// None: the identity. (4, 4), or (3,) x, y, z, or (6,) x, y, z, roll, pitch, yaw about fixed axes,
/// or (7,) x, y, z, qw, qx, qy, qz; metres, radians.
/// \throws InvalidPose if it is not rigid, with `name`
fcl::Transform3d poseFrom(py::handle value, const std::string& name);

/// One pose or several: (4, 4), (3,), (6,), (7,) or (n, ...) of these, or a list of poses.
class Poses {
 public:
  Poses(py::handle value, const std::string& name);
  bool areMany() const { return many_; }
  std::size_t size() const { return poses_.size(); }
  const fcl::Transform3d& at(std::size_t i) const { return poses_[many_ ? i : 0]; }
  const std::vector<fcl::Transform3d>& all() const { return poses_; }

 private:
  bool many_ = false;
  std::vector<fcl::Transform3d> poses_;
};

/// Rows of a (n, 3) array.
std::vector<Eigen::Vector3d> pointsFrom(py::handle value, const std::string& name);

/// Rows of a (m, 3) array of whole numbers within 0 … limit - 1. \throws InvalidGeometry,
/// py::type_error
std::vector<fcl::Triangle> trianglesFrom(py::handle value, std::size_t limit,
                                         const std::string& name);

/// New arrays of NumPy.
py::object arrayOf(const Eigen::Ref<const Eigen::MatrixXd>& values);
py::object vectorArray(const Eigen::Ref<const Eigen::VectorXd>& values);
py::object arrayOf(const std::vector<double>& values);
py::object arrayOf(const std::vector<std::int64_t>& values);

/// Memory of C++ that Python may look at, as a read-only array: keeps `owner` alive.
struct MemoryView {
  std::shared_ptr<const void> owner;
  const void* data;
  std::string format;
  std::size_t item_size;
  std::vector<py::ssize_t> shape;
};
void bindMemoryView(py::module_& module);
py::object readOnlyArray(MemoryView view);

/// A name of a file as the system has it: str, bytes or os.PathLike. \throws py::type_error
std::string pathFrom(py::handle value);

/// A short text of any object, for messages.
std::string textOf(py::handle value);

}  // namespace fcl_prob::python
