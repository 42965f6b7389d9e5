// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/zonotope.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "base/constants.h"
#include "convex/perturbation.h"

namespace fcl_prob::detail {
namespace {

constexpr double kParallel = 1e-14;

/// Determinants below this times the lengths of their columns may have either sign.
constexpr double kCoplanar = 4e-15;

/// Of a product of two lengths, so that its square is neither lost nor infinite.
constexpr double kLeastProduct = 1e-100;
constexpr double kLargestProduct = 1e100;

Eigen::Vector3d aboutOne(const Eigen::Vector3d& v) {
  return v / powerOfTwoAt(v.cwiseAbs().maxCoeff());
}

bool parallelWithin(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double limit) {
  return a.cross(b).squaredNorm() <= limit * limit;
}

bool parallel(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double product = a.norm() * b.norm();
  if (product > kLeastProduct && product < kLargestProduct) {
    return parallelWithin(a, b, kParallel * product);
  }
  const Eigen::Vector3d p = aboutOne(a), q = aboutOne(b);
  return parallelWithin(p, q, kParallel * p.norm() * q.norm());
}

}  // namespace

Zonotope::Place Zonotope::addGenerator(const Eigen::Vector3d& generator) {
  if (generator.isZero(0.0)) return {};
  for (int i = 0; i < count_; ++i) {
    if (!parallel(generators_[i], generator)) continue;
    const double sign = generators_[i].dot(generator) >= 0.0 ? 1.0 : -1.0;
    generators_[i] += sign * generator;
    return {i, sign};
  }
  assert(count_ < kMaxGenerators);
  generators_[count_] = generator;
  return {count_++, 1.0};
}

std::vector<Eigen::Vector3d> Zonotope::corners() const {
  std::vector<Eigen::Vector3d> corners;
  for (unsigned signs = 0; signs < 1u << count_; ++signs) {
    Eigen::Vector3d corner = centre_;
    for (int i = 0; i < count_; ++i) {
      corner += ((signs >> i) & 1u ? 1.0 : -1.0) * generators_[i];
    }
    corners.push_back(corner);
  }
  return corners;
}

Zonotope Zonotope::mapped(const Eigen::Matrix3d& map) const {
  Zonotope image(map * centre_);
  image.count_ = count_;
  for (int i = 0; i < count_; ++i) image.generators_[i] = map * generators_[i];
  return image;
}

double Zonotope::support(const Eigen::Vector3d& direction) const {
  double sum = centre_.dot(direction);
  for (int i = 0; i < count_; ++i) sum += std::abs(generators_[i].dot(direction));
  return sum;
}

Eigen::Vector3d Zonotope::supportPoint(const Eigen::Vector3d& direction) const {
  Eigen::Vector3d point = centre_;
  for (int i = 0; i < count_; ++i) {
    point +=
        generators_[i].dot(direction) >= 0.0 ? generators_[i] : Eigen::Vector3d(-generators_[i]);
  }
  return point;
}

int Zonotope::vertexIndex(unsigned signs, std::array<int, 1u << kMaxGenerators>& indices,
                          FaceSet& faces, std::vector<unsigned>* signs_of_all) const {
  int& index = indices[signs];
  if (index >= 0) return index;
  if (signs_of_all) signs_of_all->push_back(signs);
  Eigen::Vector3d point = centre_;
  for (int i = 0; i < count_; ++i) {
    point += (signs >> i) & 1u ? generators_[i] : Eigen::Vector3d(-generators_[i]);
  }
  return index = faces.addVertex(point);
}

std::optional<double> Zonotope::faces(FaceSet& faces, std::vector<unsigned>* signs) const {
  for (int attempt = 0; attempt < kPerturbationAttempts; ++attempt) {
    if (const auto defect = facesPerturbed(attempt, faces, signs)) return defect;
  }
  return std::nullopt;
}

std::optional<double> Zonotope::facesPerturbed(int attempt, FaceSet& faces,
                                               std::vector<unsigned>* signs_of_all) const {
  faces.clear();
  if (signs_of_all) signs_of_all->clear();
  const double unit = lengthUnit();
  Generators scaled;
  Generators moved;
  std::array<double, kMaxGenerators> norms;
  for (int i = 0; i < count_; ++i) {
    scaled[i] = generators_[i] / unit;
    norms[i] = scaled[i].norm();
    moved[i] = scaled[i] + norms[i] * perturbation(i, attempt);
  }
  std::array<int, 1u << kMaxGenerators> indices;
  std::fill_n(indices.begin(), 1u << count_, -1);
  const unsigned all = (1u << count_) - 1u;
  double defect = 0.0;

  for (int i = 0; i < count_; ++i) faces.addEdgeVector(2.0 * generators_[i]);
  for (int i = 0; i < count_; ++i) {
    for (int j = i + 1; j < count_; ++j) {
      const Eigen::Vector3d normal = moved[i].cross(moved[j]);
      unsigned upper = 0;  // the signs of the face's centre on the side of `normal`
      for (int k = 0; k < count_; ++k) {
        if (k == i || k == j) continue;
        const double height = normal.dot(moved[k]);
        if (std::abs(height) <= kCoplanar * norms[i] * norms[j] * norms[k]) return std::nullopt;
        if (height > 0.0) upper |= 1u << k;
      }
      if (attempt > 0) defect = std::max(defect, defectOf(scaled, count_, i, j, upper));
      const unsigned gi = 1u << i;
      const unsigned gj = 1u << j;
      const unsigned lower = all & ~upper & ~gi & ~gj;
      const auto vertex = [&](unsigned signs) {
        return vertexIndex(signs, indices, faces, signs_of_all);
      };
      faces.addFace(
          {vertex(upper), vertex(upper | gi), vertex(upper | gi | gj), vertex(upper | gj)});
      faces.addFace(
          {vertex(lower), vertex(lower | gj), vertex(lower | gi | gj), vertex(lower | gi)});
    }
  }
  if (!faces.closed()) return std::nullopt;
  // Both the moved zonotope and the surface, whose vertices are not moved, are within one
  // perturbation of the zonotope's boundary.
  const double size = std::accumulate(norms.begin(), norms.begin() + count_, 0.0);
  return unit * std::min(defect, 2.0 * kLargestPerturbation * size);
}

double Zonotope::lengthUnit() const {
  double largest = 0.0;
  for (int i = 0; i < count_; ++i) {
    largest = std::max(largest, generators_[i].cwiseAbs().maxCoeff());
  }
  return powerOfTwoAt(largest);
}

double Zonotope::defectOf(const Generators& generators, int count, int i, int j, unsigned upper) {
  const Eigen::Vector3d normal = generators[i].cross(generators[j]).normalized();
  double defect = 0.0;
  for (int k = 0; k < count; ++k) {
    if (k == i || k == j) continue;
    const double height = normal.dot(generators[k]);
    if ((height > 0.0) != (((upper >> k) & 1u) != 0)) defect += 2.0 * std::abs(height);
  }
  return defect;
}

}  // namespace fcl_prob::detail
