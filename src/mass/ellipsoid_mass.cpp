// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/ellipsoid_mass.h"

#include <algorithm>
#include <cmath>

#include "base/bisection.h"
#include "base/known.h"
#include "fcl_prob/normal_mass.h"
#include "gaussian/gauss_legendre.h"
#include "gaussian/normal_density.h"
#include "mass/disc_mass.h"

namespace fcl_prob::detail {
namespace {

constexpr double kSliceDigits = 31.0;
constexpr double kSliceTarget = 4e-12;
/// Volume of the unit ball times the largest density.
constexpr double kVolumeShare = 0.266;
constexpr double kEnough = 1e-11;
constexpr int kSliceAttempts = 3;
constexpr int kMostPanels = 4;
constexpr int kMostDepth = 5;
constexpr unsigned kFewSlices = 10, kManySlices = 20, kMostSlices = 30;
constexpr double kSliceSlack = 16.0 * kEpsilon;

double squareOf(double x) { return x * x; }

/// The point of an ellipsoid (any dimension) with the given radii that is nearest to the origin, or
/// the origin. By Newton's method; whatever comes out is only proposed.
template <int kDimension>
Eigen::Matrix<double, kDimension, 1> nearestTo(const Eigen::Matrix<double, kDimension, 1>& centre,
                                               const Eigen::Matrix<double, kDimension, 1>& radius) {
  using Vector = Eigen::Matrix<double, kDimension, 1>;
  if (!(centre.cwiseQuotient(radius).squaredNorm() > 1.0)) return Vector::Zero();
  const Vector product = centre.cwiseProduct(radius);
  const Vector squares = radius.cwiseAbs2();
  double t = 0.0;
  Vector unit = Vector::Zero();
  for (int k = 0; k < 14; ++k) {
    unit = product.array() / (squares.array() + t);
    const double norm = unit.squaredNorm();
    const double slope = (unit.array().square() / (squares.array() + t)).sum();
    const double move = norm / slope * (std::sqrt(norm) - 1.0);
    t += move;
    if (std::abs(move) <= 1e-9 * t) break;
  }
  unit = (product.array() / (squares.array() + t)).matrix().normalized();
  return centre - radius.cwiseProduct(unit);
}

/// \param lengths  half the window, in lengths over which the integrand falls by about e; not a
/// number
///                 where squares of the radii underflow, and no mass comes of it
int panelsFor(double lengths) {
  if (!(lengths > 7.0)) return 1;
  return lengths < 4.0 * kMostPanels ? static_cast<int>(std::ceil(lengths / 4.0)) : kMostPanels;
}

/// Slices at 1 + w = u: z = z_pole + radius u, an ellipse of radii sqrt(u (2 - u)) times those of
/// the ball's other axes.
class Slices {
 public:
  explicit Slices(const WhitenedBall& ball) : ball_(ball) {
    const Eigen::Vector3d nearest = nearestTo<3>(ball.centre, ball.radius);
    const double length = nearest.norm();
    if (length > 0.0) {
      normal_ = nearest / length;
      nearest_u_ = std::clamp((nearest.z() - ball.z_pole) / ball.radius.z(), 0.0, 2.0);
    } else {
      nearest_u_ = std::clamp(-ball.z_pole / ball.radius.z(), 0.0, 2.0);
    }
    reach_ = normal_.cwiseProduct(ball.radius).norm();
    middle_ = normal_.dot(ball.centre);
  }

  /// \param about  what the mass is about, for the choice of rules only; 0 if that is not known
  Bounds mass(double about) {
    const double distance = std::max(0.0, middle_ - reach_);
    const double likely = std::exp(-0.5 * distance * distance) / (1.0 + distance) *
                          ball_.radius.cwiseMin(1.0).prod() * 0.1;
    about_ = about > 0.0 ? about : likely;
    digits_ = kSliceDigits + std::log(std::max(1.0, likely / about_));
    lower_ = upper_ = error_ = 0.0;
    findWindow();
    const double half = 0.5 * (to_ - from_);
    const int panels = panelsFor(half * growthScale());
    // Panels are told by their distance from the window's middle, of which the height is exact:
    // they must not leave gaps as wide as rounding of a large ball.
    half_window_ = half;
    base_z_ = ball_.z_pole + ball_.radius.z() * (from_ + half);
    base_u_ = (base_z_ - ball_.z_pole) / ball_.radius.z();
    for (int k = 0; k < panels; ++k) {
      const double width = 2.0 * half / panels;
      addPanel((k + 0.5) * width - half, 0.5 * width, 0);
    }
    const double factor = ball_.radius.z() * (1.0 + ball_.radius_error + 4.0 * kEpsilon);
    return {std::max(0.0, lower_ * ball_.radius.z() * (1.0 - ball_.radius_error - 4.0 * kEpsilon) -
                              error_),
            std::min(1.0, upper_ * factor + error_ + 1e-300)};
  }

  /// Of the last mass: the bound on what its rules leave.
  double remainder() const { return error_; }

 private:
  Eigen::Vector2d slicePoint(double u) const {
    const double share = std::sqrt(std::max(0.0, u * (2.0 - u)));
    return nearestTo<2>(ball_.centre.head<2>(), share * ball_.radius.head<2>());
  }

  double squareAt(double u) const {
    return squareOf(ball_.z_pole + u * ball_.radius.z()) + slicePoint(u).squaredNorm();
  }

  /// Where the slices are beyond `level`; the pole if they never are.
  double cutAt(double side, double level) const {
    const double room = side < 0.0 ? nearest_u_ : 2.0 - nearest_u_;
    double high = std::min(room, std::sqrt(level - squareAt(nearest_u_)) / ball_.radius.z());
    double low = 0.0;
    const auto isBefore = [&](double d) { return squareAt(nearest_u_ + side * d) < level; };
    for (int k = 0; k < 40 && high < room && isBefore(high); ++k) {
      low = high;
      high = std::min(room, 1.5 * high);
    }
    constexpr int kCutHalvings = 4;
    high = bisect({low, high}, kCutHalvings, isBefore).fails;
    return high < room ? nearest_u_ + side * high : (side < 0.0 ? 0.0 : 2.0);
  }

  void findWindow() {
    const Eigen::Vector3d& r = ball_.radius;
    const double all = std::min(1.0, r.prod()), thin = r.cwiseMin(1.0).prod();
    digits_ += std::log(all / thin);
    const double level = squareAt(nearest_u_) + 2.0 * digits_;
    from_ = cutAt(-1.0, level);
    to_ = cutAt(1.0, level);
    // With a margin for the rounding of where the panels are.
    if (from_ > 0.0) error_ += massBeyond(std::min(from_ + kSliceSlack, 2.0), -1.0);
    if (to_ < 2.0) error_ += massBeyond(std::max(to_ - kSliceSlack, 0.0), 1.0);
  }

  /// By a half-space around the rest of the ball: the least of normal·y over its slices is at the
  /// cut if the whole ball's is before it.
  double massBeyond(double u, double side) const {
    const Eigen::Vector2d corner = slicePoint(u);
    Eigen::Vector3d normal(corner.x(), corner.y(), ball_.z_pole + u * ball_.radius.z());
    if (!(normal.norm() > 0.0)) return 1.0;
    normal.normalize();
    const double reach = normal.cwiseProduct(ball_.radius).norm();
    const double whole_u = 1.0 - normal.z() * ball_.radius.z() / reach;
    const double margin = 1e-9 * std::min(u, 2.0 - u);
    double distance;
    if (side > 0.0 ? whole_u < u - margin : whole_u > u + margin) {
      const double share = std::sqrt(u * (2.0 - u));
      distance = normal.z() * (ball_.z_pole + u * ball_.radius.z()) +
                 normal.head<2>().dot(ball_.centre.head<2>()) -
                 share * normal.head<2>().cwiseProduct(ball_.radius.head<2>()).norm();
    } else {
      distance = normal.dot(ball_.centre) - reach;
    }
    distance -= slackOf(1.0);
    const double by_volume = kVolumeShare * ball_.radius.prod() *
                             std::exp(-0.5 * distance * std::max(distance, 0.0)) * (1.0 + 1e-9);
    return std::min(by_volume, normalTailMass(distance) * (1.0 + kIntervalMassRelativeError)) +
           1e-305;
  }

  double slackOf(double enlargement) const {
    const double size = ball_.centre.sum() + enlargement * ball_.radius.sum();
    return kSliceSlack * size + ball_.centre_error.sum() + ball_.z_pole_error +
           ball_.radius_error * enlargement * ball_.radius.sum();
  }

  /// Inverse of the length (of u) over which the integrand falls by about e.
  double growthScale() const {
    const double w = std::max(std::abs(from_ - 1.0), std::abs(to_ - 1.0));
    const double inner =
        squareOf(ball_.radius.y()) * std::min(1.0, w * w / std::max(1e-2, 1.0 - w * w));
    const double distance = std::max(0.0, middle_ - reach_);
    return std::sqrt(squareOf(ball_.radius.z()) + inner + distance * reach_);
  }

  /// Bound on the integrand over the Bernstein ellipse of a panel. For w = sin(α + iη) the slice is
  /// that at sin α of the ball enlarged by cosh η, moved into the complex by w's imaginary part and
  /// that of cos(α + iη): |sin α| sinh η.
  double maximum(double u, const BernsteinEllipse& ellipse) const {
    const double w = std::abs(u - 1.0) + ellipse.real_axis, b = ellipse.imaginary_axis;
    const double cosh = std::max(1.0, 0.5 * (std::hypot(w - 1.0, b) + std::hypot(w + 1.0, b))) *
                        (1.0 + kSliceSlack);
    // Inside of [-1, 1] the least sum of distances to ±1 is that at w = 0; the corners are extreme.
    const double sinh_square = cosh * cosh - 1.0;
    const double distance = std::max(0.0, middle_ - cosh * reach_ - slackOf(cosh));
    const double sine = std::min(1.0, w);
    const double growth =
        0.5 * (squareOf(ball_.radius.z() * b) + squareOf(ball_.radius.y() * sine) * sinh_square);
    const double by_area = 0.5 * ball_.radius.x() * ball_.radius.y() * cosh * cosh;
    const double by_plane = w < 1.0 ? 1.0 / (1.0 - w * w) : kInfinity;
    return ball_.radius.z() * kInverseSqrtTwoPi * std::min(by_area, by_plane) *
           std::exp(growth * (1.0 + 1e-9) - 0.5 * distance * distance) * (1.0 + 1e-9);
  }

  double remainder(unsigned points, double u, double half) const {
    double best = kInfinity;
    const double scale = growthScale();
    for (const double reach : {0.75, 1.1, 0.5, 0.25, 0.12}) {
      const double axis = reach * std::sqrt(2.0 * points) / scale / half;
      const double rho = axis + std::sqrt(axis * axis + 1.0);
      best = std::min(best,
                      gaussErrorBound(points, half, rho, maximum(u, BernsteinEllipse(half, rho))));
    }
    return best;
  }

  void addPanel(double offset, double half, int depth) {
    const double target = std::max(kSliceTarget * about_, 1e-310);
    double error = remainder(kFewSlices, base_u_ + offset, half);
    if (error <= target) return evaluate<kFewSlices>(offset, half, error);
    error = remainder(kManySlices, base_u_ + offset, half);
    if (error <= target) return evaluate<kManySlices>(offset, half, error);
    error = remainder(kMostSlices, base_u_ + offset, half);
    if (error <= target || depth == kMostDepth) return evaluate<kMostSlices>(offset, half, error);
    addPanel(offset - 0.5 * half, 0.5 * half, depth + 1);
    addPanel(offset + 0.5 * half, 0.5 * half, depth + 1);
  }

  template <unsigned kPoints>
  void evaluate(double offset, double half, double error) {
    error_ += error * (1.0 + 1e-9);
    const double radius = ball_.radius.z();
    const double u_error = ball_.z_pole_error / radius +
                           (ball_.radius_error + 2.0 * kEpsilon) * (base_u_ + half_window_) +
                           2.0 * kEpsilon * half_window_;
    forEachGaussNode<kPoints>(offset, half, [&](double step, double weight) {
      const double z = base_z_ + radius * step;
      const double z_error = 0.5 * kEpsilon * std::abs(z) +
                             radius * (ball_.radius_error + 4.0 * kEpsilon) * half_window_;
      addSlice(z, z_error, base_u_ + step, u_error, weight);
    });
  }

  void addSlice(double z, double z_error, double u, double u_error, double weight) {
    const double share_square = u * (2.0 - u);
    if (!(share_square > 0.0)) {
      error_ = kInfinity;
      return;
    }
    const double share = std::sqrt(share_square);
    const double share_error = std::abs(1.0 - u) * u_error / share_square + 2.0 * kEpsilon;
    if (!(share_error < 1e-4)) {
      error_ = kInfinity;
      return;
    }
    WhitenedDisc disc;
    disc.x_centre = ball_.centre.x();
    disc.y_centre = ball_.centre.y();
    disc.x_radius = ball_.radius.x() * share;
    disc.y_radius = ball_.radius.y() * share;
    disc.radius_error = ball_.radius_error + share_error + kEpsilon;
    disc.x_error = ball_.centre_error.x();
    disc.y_error = ball_.centre_error.y();
    disc.y_pole = disc.y_centre - disc.y_radius;
    disc.y_pole_error =
        disc.y_error + disc.y_radius * disc.radius_error + kEpsilon * std::abs(disc.y_pole);
    const Bounds slice = discMass(disc);
    const double scale = weight * normalDensity(z);
    const double relative = 1.001 * std::abs(z) * z_error + 40.0 * kEpsilon;
    if (!(relative < 1e-3)) error_ = kInfinity;
    lower_ += scale * std::max(0.0, slice.lower) * (1.0 - relative);
    upper_ += scale * slice.upper * (1.0 + relative);
  }

  const WhitenedBall& ball_;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double reach_ = 0.0, middle_ = 0.0, nearest_u_ = 0.0, digits_ = kSliceDigits;
  double about_ = 0.0;
  double from_ = 0.0, to_ = 2.0;
  double half_window_ = 1.0, base_z_ = 0.0, base_u_ = 1.0;
  double lower_ = 0.0, upper_ = 0.0, error_ = 0.0;
};

}  // namespace

Bounds ellipsoidMass(const WhitenedBall& ball) {
  // Beyond, squares overflow and infinities meet.
  if (!((ball.centre + ball.radius).squaredNorm() < kInfinity)) return {0.0, 1.0};
  Slices slices(ball);
  Bounds best{0.0, 1.0};
  double about = 0.0;
  for (int attempt = 0; attempt < kSliceAttempts; ++attempt) {
    const Bounds mass = slices.mass(about);
    best = agreed(best, mass);
    if (slices.remainder() <= kEnough * mass.middle() || !(mass.upper < 1.0)) break;
    about = mass.middle() > 0.0 && mass.lower > 0.0 ? mass.middle() : 1e-6 * mass.upper;
  }
  return best;
}

}  // namespace fcl_prob::detail
