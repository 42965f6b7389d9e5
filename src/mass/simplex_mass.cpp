// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/simplex_mass.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "base/symmetric_axes.h"
#include "mass/rule_kernel.h"

namespace fcl_prob::detail {
namespace {

// Enough for a tetrahedron as long as all that a cell can reach.
constexpr int kMostHalvings = 40;

// (2π)^{-3/2}
constexpr double kDensity = 0.06349363593424096978;

// Bound on what is left of exp(x s + q s²) at s = 1 behind s^degree, for x, q >= 0: its
// coefficients c are positive, and k c_k = x c_{k-1} + 2 q c_{k-2}.
double seriesTail(double x, double q, int degree) {
  if (!(x + q < 4.0)) return std::exp(std::min(x + q, 700.0));
  double before = 0.0;
  double last = 1.0;
  double sum = 1.0;
  for (int k = 1; k <= degree; ++k) {
    const double next = (x * last + 2 * q * before) / k;
    before = last;
    last = next;
    sum += next;
  }
  return std::max(std::exp(x + q) - sum, 0.0) + 1e-13;
}

// Nodes in barycentric coordinates: four with weight[0] at (a, a, a, 1 - 3a), four with weight[1],
// six with weight[2] at (b, b, 1/2 - b, 1/2 - b). They add up to 1.
constexpr double kNode[3] = {0.31088591926330060980, 0.092735250310891226402,
                             0.045503704125649649492};
constexpr double kWeight[3] = {0.11268792571801585080, 0.073493043116361949544,
                               0.042546020777081466438};

// What lies beyond the exponents of the kernels is no denser.
constexpr double kLeastDensity = 1e-304;  // exp(-kMostRuleExponent), rounded up

// Points given by their barycentric coordinates, in arrays of their own.
template <int points>
struct PointRule {
  static constexpr int kCount = (points + 3) / 4 * 4;  // as the kernels take them
  double share[4][kCount] = {};
  double weight[kCount] = {};

  // Of the density over the tetrahedron, but for the factor kDensity.
  double meanDensity(const SimplexMass::Corners& v) const {
    double corners[12];
    for (int k = 0; k < 12; ++k) corners[k] = v[static_cast<std::size_t>(k / 3)][k % 3];
    return weightedDensity(share[0], weight, corners, kCount);
  }
};

const PointRule<14>& lowRule() {
  static const PointRule<14> rule = [] {
    PointRule<14> points;
    int count = 0;
    const auto add = [&](const Eigen::Vector4d& at, double weight) {
      for (int corner = 0; corner < 4; ++corner) points.share[corner][count] = at[corner];
      points.weight[count++] = weight;
    };
    for (int kind = 0; kind < 2; ++kind) {
      for (int corner = 0; corner < 4; ++corner) {
        Eigen::Vector4d at = Eigen::Vector4d::Constant(kNode[kind]);
        at[corner] = 1 - 3 * kNode[kind];
        add(at, kWeight[kind]);
      }
    }
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        Eigen::Vector4d at = Eigen::Vector4d::Constant(0.5 - kNode[2]);
        at[i] = at[j] = kNode[2];
        add(at, kWeight[2]);
      }
    }
    return points;
  }();
  return rule;
}

// Gauss-Jacobi rules in a cone over a cone over an edge (Stroud 1971), exact to degree 9: 125
// points in barycentric coordinates.
constexpr int kNodes = 5;
constexpr int kConicalPoints = kNodes * kNodes * kNodes;
constexpr int kConicalDegree = 2 * kNodes - 1;

struct Rule {
  Eigen::VectorXd node;
  Eigen::VectorXd weight;  // adding up to 1
};

// On [0, 1] with the weight (1 - t)^power, from the eigenvalues of the matrix of the recurrence
// (Golub and Welsch 1969).
Rule jacobi(int power) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kNodes, kNodes);
  const double alpha = power;
  for (int n = 0; n < kNodes; ++n) {
    const double s = 2 * n + alpha;
    matrix(n, n) = power == 0 ? 0.0 : -alpha * alpha / (s * (s + 2));
    if (n == 0) continue;
    const double square = 4.0 * n * n * (n + alpha) * (n + alpha) / (s * s * (s + 1) * (s - 1));
    matrix(n, n - 1) = matrix(n - 1, n) = std::sqrt(square);
  }
  const auto solver = symmetricAxes(matrix);
  Rule rule;
  rule.node = 0.5 * (solver.eigenvalues().array() + 1.0);
  rule.weight = solver.eigenvectors().row(0).cwiseAbs2().transpose();
  return rule;
}

const PointRule<kConicalPoints>& conicalRule() {
  static const PointRule<kConicalPoints> rule = [] {
    PointRule<kConicalPoints> points;
    const Rule edge = jacobi(0);
    const Rule triangle = jacobi(1);
    const Rule cone = jacobi(2);
    int count = 0;
    for (int i = 0; i < kNodes; ++i) {
      for (int j = 0; j < kNodes; ++j) {
        for (int k = 0; k < kNodes; ++k) {
          const double a = cone.node[i];
          const double b = triangle.node[j];
          const double c = edge.node[k];
          points.share[0][count] = a;
          points.share[1][count] = (1 - a) * b;
          points.share[2][count] = (1 - a) * (1 - b) * c;
          points.share[3][count] = (1 - a) * (1 - b) * (1 - c);
          points.weight[count++] = cone.weight[i] * triangle.weight[j] * edge.weight[k];
        }
      }
    }
    return points;
  }();
  return rule;
}

constexpr int kLowDegree = 5;

}  // namespace

void SimplexMass::add(const Corners& v, const MassAccuracy& accuracy, int halvings) {
  const Eigen::Vector3d middle = 0.25 * (v[0] + v[1] + v[2] + v[3]);
  double x = 0.0;
  double q = 0.0;
  double farthest = 0.0;
  for (const Eigen::Vector3d& corner : v) {
    farthest = std::max(farthest, 0.5 * corner.squaredNorm());
    const Eigen::Vector3d off = corner - middle;
    x = std::max(x, std::fabs(off.dot(middle)));
    q = std::max(q, 0.5 * off.squaredNorm());
  }
  const Eigen::Vector3d a = v[1] - v[0];
  const Eigen::Vector3d b = v[2] - v[0];
  const Eigen::Vector3d c = v[3] - v[0];
  const double volume = a.dot(b.cross(c)) / 6;
  const double around = std::fabs(volume) * kDensity * std::exp(-0.5 * middle.squaredNorm());
  const double enough = accuracy.relative + accuracy.absolute / std::max(around, 1e-300);
  double tail = 2 * seriesTail(x, q, kLowDegree);
  const bool conical = tail > enough;
  if (conical) tail = 2 * seriesTail(x, q, kConicalDegree);
  if (tail > enough && halvings < kMostHalvings) return addHalves(v, accuracy, halvings + 1);
  const double mean =
      kDensity * (conical ? conicalRule().meanDensity(v) : lowRule().meanDensity(v));
  // Corners that halving has made are off by an ulp of their coordinates.
  const double length = std::sqrt(8 * q);
  const double size = length * length * (length + middle.norm());
  mass_ += volume * mean;
  const double rounding = kRuleExpError + (32 + 4 * middle.squaredNorm()) * kEpsilon;
  error_ += std::max(around, std::numeric_limits<double>::denorm_min()) * tail +
            std::fabs(volume) * rounding * mean + 16 * kEpsilon * size * mean;
  if (farthest > 0.99 * kMostRuleExponent) error_ += std::fabs(volume) * kDensity * kLeastDensity;
}

// Halves the longest edge.
void SimplexMass::addHalves(const Corners& v, const MassAccuracy& accuracy, int halvings) {
  std::size_t from = 0;
  std::size_t to = 1;
  double longest = -1.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double length = (v[i] - v[j]).squaredNorm();
      if (length <= longest) continue;
      longest = length;
      from = i;
      to = j;
    }
  }
  const Eigen::Vector3d halfway = 0.5 * (v[from] + v[to]);
  for (const std::size_t moved : {from, to}) {
    Corners half = v;
    half[moved] = halfway;
    add(half, accuracy, halvings);
  }
}

Bounds SimplexMass::bounds() const {
  return {std::max(0.0, mass_ - error_), std::max(0.0, mass_ + error_)};
}

}  // namespace fcl_prob::detail
