// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/solid_part.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

constexpr PartBound kNothingKnown{kInfinity, 0.0, 0.0, kInfinity};

/// Beyond this the map of a triangle's plane to directions is near its singularity.
constexpr double kMostTurn = 0.95;

/// Of a product of ranges.
double leastProduct(double lo, double hi, double least, double most) {
  return std::min({lo * least, lo * most, hi * least, hi * most});
}

Eigen::Vector3d combined(const std::array<Eigen::Vector3d, 3>& terms, double a, double b) {
  return terms[0] + a * (terms[1] + b * terms[2]);
}

}  // namespace

Prism::Cell::Cell(const Prism& part, const ParameterBox&, const Eigen::Vector3d& normal)
    : part_(part),
      corner_(normal.dot(part.corner) - part.position_error),
      first_(normal.dot(part.first)),
      second_(normal.dot(part.second)),
      along_(normal.dot(part.along)),
      corner_length_(part.corner.norm()),
      first_length_(part.first.norm()),
      second_length_(part.second.norm()),
      along_length_(part.along.norm()) {}

// Linear in each parameter, so that the corners are extreme.
PartBound Prism::Cell::bound(const ComplexBox& box) const {
  double least = kInfinity, step = 0.0;
  for (const double a : {box.lo(0), box.hi(0)}) {
    for (const double b : {box.lo(1), box.hi(1)}) {
      least = std::min(least, a * first_ + (part_.triangle ? a * b : b) * second_);
      if (box.parameter == 0) {
        const Eigen::Vector3d side =
            part_.triangle ? Eigen::Vector3d(part_.first + b * part_.second) : part_.first;
        step = std::max(step, side.squaredNorm());
      }
    }
  }
  const double modulus = part_.triangle ? box.modulus(0) : 1.0;
  if (box.parameter == 1) step = modulus * modulus * second_length_ * second_length_;
  if (box.parameter == 2) step = along_length_ * along_length_;
  const double reach = corner_length_ + box.modulus(0) * first_length_ +
                       modulus * box.modulus(1) * second_length_ + box.modulus(2) * along_length_;
  return {modulus, corner_ + least + std::min(box.lo(2) * along_, box.hi(2) * along_),
          box.imaginary * box.imaginary * step, reach};
}

Wedge::Cell::Cell(const Wedge& part, const ParameterBox& box, const Eigen::Vector3d& normal)
    : corner_(normal.dot(part.corner) - part.position_error), edge_(normal.dot(part.edge)) {
  const double c = std::cos(box.centre[1]), s = std::sin(box.centre[1]);
  const Eigen::Vector3d radial = c * part.p + s * part.q, tangential = c * part.q - s * part.p;
  radial_ = normal.dot(radial);
  tangential_ = normal.dot(tangential);
  corner_length_ = part.corner.norm();
  edge_length_ = part.edge.norm();
  radial_length_ = radial.norm();
  tangential_length_ = tangential.norm();
}

// u(θ + iη) = cosh η u(θ) + i sinh η u'(θ).
PartBound Wedge::Cell::bound(const ComplexBox& box) const {
  const double turn = box.real.half[1];
  if (!(turn < M_PI_2)) return kNothingKnown;
  const double s = std::sin(turn), c = std::cos(turn);
  const double least = std::min(radial_, c * radial_) - s * std::abs(tangential_);
  const double most = std::max(radial_, c * radial_) + s * std::abs(tangential_);
  const bool turned = box.parameter == 1;
  const double cosh = turned ? std::cosh(box.imaginary) : 1.0;
  const double distance = corner_ + std::min(box.lo(0) * edge_, box.hi(0) * edge_) +
                          std::min(leastProduct(box.lo(2), box.hi(2), least, most),
                                   cosh * leastProduct(box.lo(2), box.hi(2), least, most));
  const double rho = box.modulus(2);
  double step = 0.0;
  if (box.parameter == 0) step = box.imaginary * edge_length_;
  if (turned) step = std::sinh(box.imaginary) * rho * (tangential_length_ + s * radial_length_);
  if (box.parameter == 2) step = box.imaginary * (radial_length_ + s * tangential_length_);
  const double reach = corner_length_ + box.modulus(0) * edge_length_ +
                       2.0 * rho * cosh * (radial_length_ + tangential_length_);
  return {rho, distance, step * step, reach};
}

Sector::Cell::Cell(const Sector& part, const ParameterBox& box, const Eigen::Vector3d& normal)
    : part_(part),
      corner_(normal.dot(part.corner) - part.position_error),
      corner_length_(part.corner.norm()) {
  for (std::size_t k = 0; k < 3; ++k) along_[k] = normal.dot(part.whitened[k]);
  middle_ = combined(part.normals, box.centre[0], box.centre[1]);
  whitened_middle_ = combined(part.whitened, box.centre[0], box.centre[1]);
  middle_length_ = middle_.norm();
}

/// What an imaginary part iη of a or b makes of the direction g/|g|, g = g₀ + iη d, d = ∂g/∂a or
/// ∂g/∂b: with κ = g₀·d/|g₀|², d⊥ = d - κ g₀ and tanh ζ = η |d⊥| / (|g₀| (1 + iηκ)) it is
/// cosh ζ g₀/|g₀| + i sinh ζ d⊥/|d⊥|: turned by the real angle |Im ζ| and stretched.
struct Sector::Cell::Turn {
  double cosh = 1.0;    ///< no less than cosh Re ζ
  double angle = 0.0;   ///< no less than |Im ζ|
  double growth = 0.0;  ///< no less than |Im W g/|g||²
  double weight = 1.0;  ///< no less than |g₀|³ / |(g·g)^(3/2)|
};

Sector::Cell::Turn Sector::Cell::turnOf(const ComplexBox& box, double least_length,
                                        double spread) const {
  const auto& n = part_.normals;
  const auto& w = part_.whitened;
  const double a = box.real.centre[0], b = box.real.centre[1];
  const bool first = box.parameter == 0;
  const Eigen::Vector3d step = first ? Eigen::Vector3d(n[1] + b * n[2]) : Eigen::Vector3d(a * n[2]);
  const double step_spread = (first ? box.real.half[1] : box.real.half[0]) * n[2].norm();
  const double length = step.norm() + step_spread;
  const double omega = box.imaginary * length / least_length;
  if (!(omega < kMostTurn)) return {kInfinity, kInfinity, kInfinity, kInfinity};
  const double along = middle_.dot(step),
               along_spread = spread * length + middle_length_ * step_spread;
  const double square = least_length * least_length;
  const double kappa = (std::abs(along) + along_spread) / square;
  Turn turn;
  const double rest = 1.0 - omega * omega;
  turn.cosh = 1.0 / std::sqrt(rest);
  turn.angle = omega * box.imaginary * kappa / rest;
  turn.weight = turn.cosh * turn.cosh * turn.cosh;
  // |W d⊥| at the middle, and by how much it is more elsewhere.
  const double middle_kappa = along / (middle_length_ * middle_length_);
  const Eigen::Vector3d across =
      (first ? Eigen::Vector3d(w[1] + b * w[2]) : Eigen::Vector3d(a * w[2])) -
      middle_kappa * whitened_middle_;
  const double kappa_spread =
      along_spread / square + std::abs(along) * spread * (2.0 * middle_length_ + spread) /
                                  (square * middle_length_ * middle_length_);
  const double g_spread =
      box.real.half[0] * (w[1] + b * w[2]).norm() + box.modulus(0) * box.real.half[1] * w[2].norm();
  const double whitened_spread = (first ? box.real.half[1] : box.real.half[0]) * w[2].norm() +
                                 kappa * g_spread + kappa_spread * whitened_middle_.norm();
  // sinh Re ζ |W t|, t = cos(Im ζ) d⊥/|d⊥| and a little of g₀/|g₀|.
  const double tangent =
      box.imaginary * (across.norm() + whitened_spread) / least_length +
      omega * std::min(turn.angle, 1.0) * (whitened_middle_.norm() + g_spread) / least_length;
  turn.growth = tangent * tangent * turn.cosh * turn.cosh;
  return turn;
}

PartBound Sector::Cell::bound(const ComplexBox& box) const {
  double least_length = kInfinity, most_length = 0.0, spread = 0.0;
  double least_along = kInfinity, most_along = -kInfinity, reach = 0.0;
  for (const double a : {box.lo(0), box.hi(0)}) {
    for (const double b : {box.lo(1), box.hi(1)}) {
      const Eigen::Vector3d g = combined(part_.normals, a, b);
      least_length = std::min(least_length, middle_.dot(g) / middle_length_);
      most_length = std::max(most_length, g.norm());
      spread = std::max(spread, (g - middle_).norm());
      const double along = along_[0] + a * (along_[1] + b * along_[2]);
      least_along = std::min(least_along, along);
      most_along = std::max(most_along, along);
      if (box.parameter == 2) reach = std::max(reach, combined(part_.whitened, a, b).norm());
    }
  }
  if (!(least_length > 0.0)) return kNothingKnown;
  Turn turn;
  if (box.parameter == 0 || box.parameter == 1) turn = turnOf(box, least_length, spread);
  if (!(turn.angle < M_PI_2)) return kNothingKnown;
  double least = least_along / (least_along > 0.0 ? most_length : least_length);
  double most = most_along / (most_along > 0.0 ? least_length : most_length);
  if (turn.angle > 0.0) {
    const double aside = std::sin(turn.angle) * part_.stretch;
    least = std::min(least, std::cos(turn.angle) * least) - aside;
    most = std::max(most, std::cos(turn.angle) * most) + aside;
  }
  const double nearest = leastProduct(box.lo(2), box.hi(2), least, most);
  const double rho = box.modulus(2);
  const double growth = box.parameter == 2 ? box.imaginary * box.imaginary * reach * reach /
                                                 (least_length * least_length)
                                           : rho * rho * turn.growth;
  const double weight =
      rho * rho * box.modulus(0) * turn.weight / (least_length * least_length * least_length);
  // |u| <= √2 cosh Re ζ.
  return {weight, corner_ + std::min(nearest, turn.cosh * nearest), growth,
          corner_length_ + 1.5 * rho * turn.cosh * part_.stretch};
}

}  // namespace fcl_prob::detail
