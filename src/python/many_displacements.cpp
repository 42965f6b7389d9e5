// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "fcl_prob/exceptions.h"
#include "python/arrays.h"
#include "python/displacements.h"
#include "python/request.h"

namespace fcl_prob::python {
namespace {

/// Covariances as an array, one by one.
class Covariances {
 public:
  Covariances(py::handle covariances, py::handle means, const std::string& convention)
      : array_(numpy("asarray", covariances)), convention_(conventionFrom(convention)) {
    const Numbers numbers(array_, "covariances");
    const int axes = numbers.dimensions();
    size_ = axes >= 2 ? numbers.size(axes - 1) : 0;
    if (axes < 2 || axes > 3 || (size_ != 3 && size_ != 6) || numbers.size(axes - 2) != size_) {
      numbers.refuseShape("(3, 3), (6, 6), (n, 3, 3) or (n, 6, 6)");
    }
    many_ = axes == 3;
    count_ = many_ ? numbers.size(0) : 1;
    if (!means.is_none()) readMeans(means);
  }

  ManyDisplacements all() const {
    const Numbers numbers(array_, "covariances");
    ManyDisplacements result;
    result.many = many_ || many_means_;
    for (std::size_t i = 0; i < count_; ++i) result.all.push_back(one(numbers, i));
    return result;
  }

 private:
  static py::object numpy(const char* name, py::handle value) {
    return py::module_::import("numpy").attr(name)(value);
  }

  void readMeans(py::handle means) {
    const Numbers numbers(means, "means");
    const int axes = numbers.dimensions();
    if (axes < 1 || axes > 2 || numbers.size(axes - 1) != size_) {
      numbers.refuseShape("(" + std::to_string(size_) + ",) or (n, " + std::to_string(size_) + ")");
    }
    many_means_ = axes == 2;
    const std::size_t rows = many_means_ ? numbers.size(0) : 1;
    if (many_ && many_means_ && rows != count_) {
      throw py::value_error("there are " + std::to_string(count_) + " covariances, but " +
                            std::to_string(rows) + " means");
    }
    if (many_means_) count_ = rows;
    for (std::size_t i = 0; i < rows; ++i) {
      Eigen::VectorXd mean(static_cast<Eigen::Index>(size_));
      for (std::size_t j = 0; j < size_; ++j) {
        mean[static_cast<Eigen::Index>(j)] = many_means_ ? numbers.at(i, j) : numbers.at(j);
      }
      means_.push_back(mean);
    }
  }

  Randomness one(const Numbers& numbers, std::size_t i) const {
    Eigen::MatrixXd covariance(size_, size_);
    for (std::size_t r = 0; r < size_; ++r) {
      for (std::size_t c = 0; c < size_; ++c) {
        covariance(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
            many_ ? numbers.at(i, r, c) : numbers.at(r, c);
      }
    }
    const Eigen::VectorXd mean = means_.empty()
                                     ? Eigen::VectorXd(Eigen::VectorXd::Zero(covariance.rows()))
                                     : means_[many_means_ ? i : 0];
    try {
      if (size_ == 3) return GaussianDisplacement(mean, covariance);
      return PoseError(covariance, convention_, mean);
    } catch (const InvalidDistribution& error) {
      throw InvalidDistribution("covariances[" + std::to_string(i) + "]: " + error.what());
    }
  }

  py::object array_;
  PoseConvention convention_;
  std::size_t size_ = 0;
  std::size_t count_ = 0;
  bool many_ = false;
  bool many_means_ = false;
  std::vector<Eigen::VectorXd> means_;
};

}  // namespace

ManyDisplacements displacementsFrom(py::handle displacement, py::handle covariances,
                                    py::handle means, const std::string& convention) {
  if (displacement.is_none() == covariances.is_none()) {
    throw py::type_error("needs either displacement or covariances");
  }
  if (!covariances.is_none()) return Covariances(covariances, means, convention).all();
  if (!means.is_none()) throw py::type_error("means belong to covariances, not to displacement");
  ManyDisplacements result;
  if (py::isinstance<py::list>(displacement) || py::isinstance<py::tuple>(displacement)) {
    result.many = true;
    for (const py::handle one : displacement) {
      result.all.push_back(
          randomnessFrom(one, "displacement[" + std::to_string(result.all.size()) + "]"));
    }
  } else {
    result.all.push_back(randomnessFrom(displacement, "displacement"));
  }
  return result;
}

}  // namespace fcl_prob::python
