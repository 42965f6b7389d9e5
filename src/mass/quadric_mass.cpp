// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/quadric_mass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/constants.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/gauss_rule.h"
#include "gaussian/normal_density.h"

namespace fcl_prob::detail {

namespace {

// Cells in which the boundary leaves too flatly are halved so often, across the axes that are not
// the steepest.
constexpr int kMostQuadricHalvings = 5;

// Of the room around the cell that is needed for complex arguments, how much is allowed for.
constexpr double kRoom = 1.5;

// The largest density at a distance of at most `margin` from [lo, hi].
double densityNear(double lo, double hi, double margin) {
  return normalDensity(std::max({lo - margin, -hi - margin, 0.0}));
}

// What a rule of n nodes leaves of an integrand of size 1 that is analytic at a distance of up to
// `height` from an interval of half this width: half · 64/15 ρ^-2n / (1 - ρ^-2).
struct RuleError {
  RuleError(double half, double height) {
    const double ratio = height / half;
    rho = ratio + std::sqrt(1.0 + ratio * ratio);
    constant = half * (64.0 / 15.0) / (1.0 - 1.0 / (rho * rho));
  }
  double with(int nodes) const { return constant * std::pow(rho, -2.0 * nodes); }

  double rho;
  double constant;
};

// The cell in coordinates (k, v, u) relative to its middle, each with the sign in which the form
// q = |axes (y - origin) + offset|² - 1 grows: k the axis along which it is steepest, u the
// flattest. What is in the quadric lies at k <= f(u, v), and f falls with v.
class QuadricCell {
 public:
  QuadricCell(const Cell& cell, const Quadric& quadric, double slack)
      : middle_(0.5 * (cell.lo + cell.hi)), half_(0.5 * (cell.hi - cell.lo)) {
    const Eigen::Vector3d off = quadric.axes * (middle_ - quadric.origin) + quadric.offset;
    gradient_ = quadric.axes.transpose() * off;
    form_ = quadric.axes.transpose() * quadric.axes;
    at_middle_ = off.squaredNorm() - 1.0;
    order();
    const Eigen::Matrix3d sizes = quadric.axes.cwiseAbs();
    const double reach =
        (sizes * (cell.largestCoordinates() + half_ + quadric.origin.cwiseAbs())).norm() +
        quadric.offset.norm();
    const double across = (sizes * half_).norm();
    // The terms of q: the point to within 16 ε of what it is a sum of, then sums of products.
    const double of_point = 16 * kEpsilon * reach;
    const double size = off.norm() + across;
    error_of_form_ = 2 * (size + of_point) * of_point + 64 * kEpsilon * (size * size + 1.0) +
                     2 * slack + slack * slack;
    cell_mass_ = cellMass(cell);
  }

  /// The axis to halve the cell along.
  int wider() const {
    return half_[kFlattest] > half_[kSlanted] ? axes_[kFlattest] : axes_[kSlanted];
  }

  std::optional<Bounds> mass(double accuracy) {
    if (!(half_.minCoeff() > 0.0) || !(gradient_[kSteepest] > 0.0)) return std::nullopt;
    const int outside = sideOfCell();
    if (outside > 0) return Bounds{0.0, 0.0};
    if (outside < 0) return cell_mass_;
    if (!plan(accuracy * cell_mass_.upper)) return std::nullopt;
    double sum = 0.0;
    integrate(sum);
    const double error =
        error_ + roundingError() + std::numeric_limits<double>::min();  // what underflows
    if (!std::isfinite(sum + error)) return std::nullopt;
    return Bounds{std::clamp(sum - error, 0.0, cell_mass_.lower),
                  std::clamp(sum + error, 0.0, cell_mass_.upper)};
  }

 private:
  // So that the largest slopes come first; reflected where q falls along an axis.
  void order() {
    const Eigen::Vector3d steepness = gradient_.cwiseAbs();
    std::sort(axes_.begin(), axes_.end(),
              [&](int i, int j) { return steepness[i] > steepness[j]; });
    Eigen::Matrix3d permuted;
    Eigen::Vector3d middle, half, gradient;
    for (int i = 0; i < 3; ++i) {
      const double sign = gradient_[axes_[i]] < 0.0 ? -1.0 : 1.0;
      middle[i] = sign * middle_[axes_[i]];
      half[i] = half_[axes_[i]];
      gradient[i] = sign * gradient_[axes_[i]];
      for (int j = 0; j < 3; ++j) {
        const double sign_j = gradient_[axes_[j]] < 0.0 ? -1.0 : 1.0;
        permuted(i, j) = sign * sign_j * form_(axes_[i], axes_[j]);
      }
    }
    middle_ = middle;
    half_ = half;
    gradient_ = gradient;
    form_ = permuted;
  }

  double form(double k, double v, double u) const {
    const Eigen::Vector3d t(k, v, u);
    return at_middle_ + 2 * gradient_.dot(t) + t.dot(form_ * t);
  }

  // Upper bound of half the size of the derivative of q along an axis within the cell, extended by
  // so much along each axis, in the complex as well; and a lower bound of its real part.
  double slopeAtMost(int axis, const Eigen::Vector3d& beyond) const {
    return gradient_[axis] + form_.row(axis).cwiseAbs().dot(half_ + 2 * beyond);
  }
  double slopeAtLeast(int axis, const Eigen::Vector3d& beyond) const {
    return gradient_[axis] - form_.row(axis).cwiseAbs().dot(half_ + beyond);
  }

  // 1: the cell is certainly outside of the quadric, -1: within, 0: neither is shown.
  int sideOfCell() const {
    // q is convex: above its tangent plane, and largest in a corner.
    const double rise = gradient_.dot(half_);
    if (at_middle_ - 2 * rise > error_of_form_) return 1;
    const double bulge = half_.dot(form_.cwiseAbs() * half_);
    return at_middle_ + 2 * rise + bulge < -error_of_form_ ? -1 : 0;
  }

  // Whether the boundary is between both ends along k everywhere.
  bool staysBetweenEnds() const {
    const double h = half_[kSteepest];
    const double top =
        at_middle_ + 2 * gradient_[kSteepest] * h + form_(kSteepest, kSteepest) * h * h;
    const Eigen::Vector3d slope = gradient_ + h * form_.col(kSteepest);
    if (top - 2 * (std::fabs(slope[kSlanted]) * half_[kSlanted] +
                   std::fabs(slope[kFlattest]) * half_[kFlattest]) <
        0.0) {
      return false;
    }
    for (const double v : {-half_[kSlanted], half_[kSlanted]}) {
      for (const double u : {-half_[kFlattest], half_[kFlattest]}) {
        if (form(-h, v, u) > 0.0) return false;
      }
    }
    return true;
  }

  // Chooses how far to go into the complex, and the rule that needs the fewest nodes.
  bool plan(double accuracy) {
    between_ = staysBetweenEnds();
    nodes_ = GaussRule::kMost + 1;
    const double widest = std::max(half_[kFlattest], half_[kSlanted]);
    for (const double factor : {8.0, 5.0, 3.0, 2.0, 1.4, 1.0}) tryHeight(factor * widest, accuracy);
    return nodes_ <= GaussRule::kMost;
  }

  /// How far points of the boundary move when u and v do by a height.
  struct Moved {
    double along_v;  ///< the ends of the interval along v, and what is within it
    double bulge;    ///< the boundary along k
  };

  // False where the slopes within so much around the cell do not bound that.
  bool moveBy(double height, const Eigen::Vector3d& beyond, Moved& moved) const {
    const double least_k = slopeAtLeast(kSteepest, beyond);
    const double least_v = slopeAtLeast(kSlanted, beyond);
    if (!(least_k > 0.0) || !(between_ || least_v > 0.0)) return false;
    const double slope_u = slopeAtMost(kFlattest, beyond);
    const double curve = between_ ? 0.0 : slope_u / least_v * height;
    moved.along_v = std::max(curve, height);
    moved.bulge = (slope_u * height + slopeAtMost(kSlanted, beyond) * moved.along_v) / least_k;
    return true;
  }

  // The boundary k = f(u, v) is continued from real points of the cell by df = -(q_u du + q_v dv) /
  // q_k, which stays finite as long as the real part of q_k is positive where it leads; the curves
  // v = g(u) in which it meets an end of the cell by dg = -q_u / q_v du.
  void tryHeight(double height, double accuracy) {
    Eigen::Vector3d beyond = Eigen::Vector3d::Zero();
    beyond[kFlattest] = beyond[kSlanted] = height;
    Moved moved;
    // What is allowed for is a guess, half as much again as is needed without it.
    if (!moveBy(height, beyond, moved)) return;
    beyond[kSlanted] = kRoom * moved.along_v;
    beyond[kSteepest] = kRoom * moved.bulge;
    if (!moveBy(height, beyond, moved)) return;
    if (!(moved.along_v <= beyond[kSlanted] && moved.bulge <= beyond[kSteepest])) return;
    const double along_v = moved.along_v;
    const double bulge = moved.bulge;
    const double largest = sizeOfIntegrand(height, along_v, bulge);
    const RuleError of_u(half_[kFlattest], height);
    const RuleError of_v(half_[kSlanted], height);
    const double across_u = 2 * half_[kFlattest];
    const double across_v = 2 * half_[kSlanted] + 2 * along_v;
    for (int nodes = GaussRule::kFewest; nodes < nodes_; ++nodes) {
      const double error = largest * (across_u * of_v.with(nodes) + across_v * of_u.with(nodes));
      if (!(error <= accuracy)) continue;
      nodes_ = nodes;
      error_ = error;
    }
  }

  // Of the masses along k, times the densities along v and u: at complex arguments z the density is
  // that of the real part times exp(½ Im z²). The mass up to the cell's end, where the boundary is
  // beyond it, is within that.
  double sizeOfIntegrand(double height, double along_v, double bulge) const {
    const auto near = [&](int axis, double margin) {
      return densityNear(middle_[axis] - half_[axis], middle_[axis] + half_[axis], margin);
    };
    const double along_k =
        near(kSteepest, bulge) * (2 * half_[kSteepest] + bulge * std::exp(0.5 * bulge * bulge));
    return along_k * near(kSlanted, along_v) * std::exp(0.5 * along_v * along_v) *
           near(kFlattest, height) * std::exp(0.5 * height * height) * (between_ ? 1.0 : 2.0);
  }

  // The larger root of the form along an axis at which it grows there, by its half derivative and
  // its value at 0, at which it grows.
  static double root(double square, double slope, double value) {
    const double discriminant = std::max(0.0, slope * slope - square * value);
    return -value / (slope + std::sqrt(discriminant));
  }

  // Where, along u, the boundary leaves the cell through one of its edges.
  std::array<double, 10> breaks(int& count) const {
    std::array<double, 10> result;
    count = 0;
    result[count++] = -half_[kFlattest];
    for (const double v : {-half_[kSlanted], half_[kSlanted]}) {
      for (const double k : {-half_[kSteepest], half_[kSteepest]}) {
        const double square = form_(kFlattest, kFlattest);
        const double slope =
            gradient_[kFlattest] + form_(kFlattest, kSlanted) * v + form_(kFlattest, kSteepest) * k;
        const double value = form(k, v, 0.0);
        const double discriminant = slope * slope - square * value;
        if (!(discriminant >= 0.0)) continue;
        const double q = -(slope + std::copysign(std::sqrt(discriminant), slope));
        for (const double u : {q / square, value / q}) {
          if (u > -half_[kFlattest] && u < half_[kFlattest]) result[count++] = u;  // false for NaN
        }
      }
    }
    std::sort(result.begin() + 1, result.begin() + count);
    result[count++] = half_[kFlattest];
    return result;
  }

  void integrate(double& sum) const {
    if (between_) return piece(-half_[kFlattest], half_[kFlattest], sum);
    int count = 0;
    const std::array<double, 10> ends = breaks(count);
    for (int i = 0; i + 1 < count; ++i) piece(ends[i], ends[i + 1], sum);
  }

  void piece(double begin, double end, double& sum) const {
    if (!(end > begin)) return;
    const GaussRule& rule = GaussRule::ofSize(nodes_);
    const double half = 0.5 * (end - begin);
    for (int i = 0; i < nodes_; ++i) {
      const double u = 0.5 * (begin + end) + half * rule.node[i];
      sum += half * rule.weight[i] * normalDensity(middle_[kFlattest] + u) * inner(u);
    }
  }

  // Where the boundary is at the height k, along v: at an end of the cell if it is not in it.
  double meeting(double k, double u) const {
    if (form(k, -half_[kSlanted], u) >= 0.0) return -half_[kSlanted];
    if (form(k, half_[kSlanted], u) <= 0.0) return half_[kSlanted];
    const double slope =
        gradient_[kSlanted] + form_(kSlanted, kFlattest) * u + form_(kSlanted, kSteepest) * k;
    return std::clamp(root(form_(kSlanted, kSlanted), slope, form(k, 0.0, u)), -half_[kSlanted],
                      half_[kSlanted]);
  }

  // Of what lies at one u.
  double inner(double u) const {
    const double lowest = middle_[kSteepest] - half_[kSteepest];
    const double highest = middle_[kSteepest] + half_[kSteepest];
    const double begin = between_ ? -half_[kSlanted] : meeting(half_[kSteepest], u);
    const double end = between_ ? half_[kSlanted] : meeting(-half_[kSteepest], u);
    double sum = 0.0;
    if (begin > -half_[kSlanted]) {
      sum += normalIntervalMass(middle_[kSlanted] - half_[kSlanted], middle_[kSlanted] + begin) *
             normalIntervalMass(lowest, highest);
    }
    if (!(end > begin)) return sum;
    const GaussRule& rule = GaussRule::ofSize(nodes_);
    const double half = 0.5 * (end - begin);
    for (int i = 0; i < nodes_; ++i) {
      const double v = 0.5 * (begin + end) + half * rule.node[i];
      const double slope =
          gradient_[kSteepest] + form_(kSteepest, kFlattest) * u + form_(kSteepest, kSlanted) * v;
      const double top = root(form_(kSteepest, kSteepest), slope, form(0.0, v, u));
      const double height = std::clamp(middle_[kSteepest] + top, lowest, highest);
      sum += half * rule.weight[i] * normalDensity(middle_[kSlanted] + v) *
             normalIntervalMass(lowest, height);
    }
    return sum;
  }

  // What the form's error moves the boundary by, and what sums round: terms are positive, each with
  // half an ε of the mass, and the ends of intervals and the places of densities, ε of themselves.
  double roundingError() const {
    const Eigen::Vector3d reach = middle_.cwiseAbs() + half_;
    const auto near = [&](int axis) {
      return densityNear(middle_[axis] - half_[axis], middle_[axis] + half_[axis], 0.0);
    };
    const double least_k = slopeAtLeast(kSteepest, Eigen::Vector3d::Zero());
    const double moved = error_of_form_ / least_k + 32 * kEpsilon * reach[kSteepest];
    const double of_boundary = 2 * moved * near(kSteepest) * near(kSlanted) * near(kFlattest) * 4 *
                               half_[kFlattest] * half_[kSlanted];
    const double of_ends = (reach[kSlanted] / half_[kSlanted] +
                            reach[kFlattest] / half_[kFlattest] + reach.squaredNorm()) *
                           16;
    return of_boundary + (2000.0 + of_ends) * kEpsilon * cell_mass_.upper;
  }

  static constexpr int kSteepest = 0, kSlanted = 1, kFlattest = 2;
  std::array<int, 3> axes_{0, 1, 2};  ///< of the cell
  Eigen::Vector3d middle_;
  Eigen::Vector3d half_;
  Eigen::Vector3d gradient_;  ///< half of that of q, in the middle
  Eigen::Matrix3d form_;      ///< half its second derivatives
  double at_middle_;
  double error_of_form_;
  Bounds cell_mass_;
  bool between_ = false;
  int nodes_ = 0;
  double error_ = 0.0;
};

// In halves where it cannot be had in one piece.
std::optional<Bounds> massInHalves(const Cell& cell, const Quadric& quadric, double slack,
                                   double accuracy, int halvings) {
  QuadricCell whole(cell, quadric, slack);
  std::optional<Bounds> mass = whole.mass(accuracy);
  if (mass || halvings == 0) return mass;
  const int axis = whole.wider();
  const double at = 0.5 * (cell.lo[axis] + cell.hi[axis]);
  if (!(at > cell.lo[axis] && at < cell.hi[axis])) return std::nullopt;
  mass = Bounds{0.0, 0.0};
  for (const bool upper : {false, true}) {
    Cell part = cell;
    (upper ? part.lo : part.hi)[axis] = at;
    const auto of_part = massInHalves(part, quadric, slack, accuracy, halvings - 1);
    if (!of_part) return std::nullopt;
    mass->lower += of_part->lower;
    mass->upper += of_part->upper;
  }
  return mass;
}

}  // namespace

QuadricLayer layerOf(const Cell& cell, const Quadric& quadric) {
  const Eigen::Vector3d middle = 0.5 * (cell.lo + cell.hi);
  const Eigen::Vector3d half = 0.5 * (cell.hi - cell.lo);
  const Eigen::Vector3d off = quadric.axes * (middle - quadric.origin) + quadric.offset;
  const Eigen::Vector3d gradient = 2 * quadric.axes.transpose() * off;
  const Eigen::Matrix3d form = quadric.axes.transpose() * quadric.axes;
  const double steepness = gradient.norm();
  QuadricLayer layer;
  layer.normal = gradient / steepness;
  layer.steepness = steepness;
  layer.outer = layer.normal.dot(middle) - (off.squaredNorm() - 1.0) / steepness;
  layer.inner = layer.outer - half.dot(form.cwiseAbs() * half) / steepness;
  return layer;
}

std::optional<Bounds> cellQuadricMass(const Cell& cell, const Quadric& quadric, double slack,
                                      double accuracy) {
  if (cell.rank != 3 || cell.empty()) return std::nullopt;
  return massInHalves(cell, quadric, slack, accuracy, kMostQuadricHalvings);
}

}  // namespace fcl_prob::detail
