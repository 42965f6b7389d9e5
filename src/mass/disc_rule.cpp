// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/disc_rule.h"

#include <algorithm>

#include "base/bisection.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

constexpr int kMostRuleNodes = 400;

/// What a few roundings leave of the terms of a bound that is not tight anyway.
constexpr double kRuleSlack = 16.0 * kEpsilon;

double square(double x) { return x * x; }

/// Mass of a half-space, from above.
double tailAbove(double distance) {
  return normalTailMass(distance) * (1.0 + kIntervalMassRelativeError) + 1e-305;
}

}  // namespace

bool WhitenedDisc::containsOrigin() const {
  return square(x_centre / x_radius) + square(y_centre / y_radius) <= 1.0;
}

DiscRule::DiscRule(const WhitenedDisc& disc, double digits) : disc_(disc) {
  findNearest();
  // (x² + y²)/2 at the cuts; a part of the mass decays slower than its edge.
  const double level = squareAt(nearest_w_) + 2.0 * digits;
  double below = distanceToCut(-1.0, level);
  double above = distanceToCut(1.0, level);
  chooseBase(below, above);
  below_ = cutAt(below, -1.0);
  above_ = cutAt(above, 1.0);
  chooseStep(digits);
}

// Lagrange's multiplier by Newton's method on 1/sqrt of the secular equation; any result will do.
void DiscRule::findNearest() {
  if (disc_.containsOrigin()) {
    nearest_w_ = -std::min(1.0, disc_.y_centre / disc_.y_radius);
    return;
  }
  const double ax = disc_.x_centre * disc_.x_radius, ay = disc_.y_centre * disc_.y_radius;
  const double bx = square(disc_.x_radius), by = square(disc_.y_radius);
  double t = 0.0;
  for (int k = 0; k < 12; ++k) {
    const double ex = ax / (bx + t), ey = ay / (by + t);
    const double norm = ex * ex + ey * ey;
    const double slope = ex * ex / (bx + t) + ey * ey / (by + t);
    const double move = (norm / slope) * (std::sqrt(norm) - 1.0);
    t += move;
    if (std::abs(move) <= 1e-9 * t) break;
  }
  double ex = ax / (bx + t), ey = ay / (by + t);
  const double length = std::hypot(ex, ey);
  ex /= length;
  ey /= length;
  nearest_w_ = -std::min(1.0, ey);
  normal_x_ = ex / disc_.x_radius;
  normal_y_ = ey / disc_.y_radius;
  const double norm = std::hypot(normal_x_, normal_y_);
  normal_x_ /= norm;
  normal_y_ /= norm;
}

// Least x² + y² of the chord at sin θ = w.
double DiscRule::squareAt(double w) const {
  const double x = disc_.x_centre - disc_.x_radius * std::sqrt(std::max(0.0, (1 - w) * (1 + w)));
  return square(disc_.y_centre + w * disc_.y_radius) + square(std::max(x, 0.0));
}

// How far from the nearest point (in w) the chords are as far from the origin as `level`; infinite
// if none is.
double DiscRule::distanceToCut(double side, double level) const {
  const double room = side < 0.0 ? 1.0 + nearest_w_ : 1.0 - nearest_w_;
  const auto isBeyond = [&](double d) { return squareAt(nearest_w_ + side * d) >= level; };
  double high = std::min(room, std::sqrt(level - squareAt(nearest_w_)) / disc_.y_radius), low = 0.0;
  for (int k = 0; k < 40 && !isBeyond(high); ++k) {
    if (high >= room) return kInfinity;
    low = high;
    high = std::min(room, 1.5 * high);
  }
  constexpr int kCutHalvings = 4;
  high = bisect({high, low}, kCutHalvings, isBeyond).holds;
  // Too near the pole for a cut.
  return high < 0.98 * room ? high : kInfinity;
}

void DiscRule::chooseBase(double below, double above) {
  whole_ = std::isinf(above);
  const double u = 1.0 + nearest_w_;
  from_pole_ = !whole_ && (std::isinf(below) || u <= 1e-300);
  if (whole_) {
    base_y_ = disc_.y_centre;
    base_y_error_ = disc_.y_error;
  } else if (from_pole_) {
    base_w_ = -1.0;
    base_cos_ = 0.0;
    base_y_ = disc_.y_pole;
    base_y_error_ = disc_.y_pole_error;
  } else {
    // A height that is exact; what rounding leaves is where on the circle that is.
    base_y_ = disc_.y_pole + u * disc_.y_radius;
    const double rise = base_y_ - disc_.y_pole;
    const double exact_u = rise / disc_.y_radius;
    const double u_error = (disc_.y_pole_error + 0.5 * kEpsilon * std::abs(rise)) / disc_.y_radius +
                           (disc_.radius_error + kEpsilon) * exact_u;
    base_w_ = exact_u - 1.0;
    base_cos_ = std::sqrt(exact_u * (2.0 - exact_u));
    base_cos_error_ = std::abs(base_w_) * u_error / base_cos_ + kEpsilon * base_cos_;
  }
}

// y - base_y_ = y_radius (sin θ - sin θ₀), without cancellation.
Chord DiscRule::chordAt(double delta) const {
  const double s = std::sin(delta), c = std::cos(delta);
  const double half_sine = std::sin(0.5 * delta);
  const double fall = 2.0 * half_sine * half_sine;
  Chord chord;
  chord.cos = base_cos_ * c - base_w_ * s;
  chord.sin = base_w_ * c + base_cos_ * s;
  chord.y = base_y_ + disc_.y_radius * (base_cos_ * s - base_w_ * fall);
  chord.half = disc_.x_radius * chord.cos;
  const double window = std::max(std::abs(below_.angle), std::abs(above_.angle));
  chord.cos_error = base_cos_error_ + 0.5 * kEpsilon * std::abs(chord.cos) +
                    1.5 * kEpsilon * (std::abs(base_cos_ * c) + std::abs(base_w_ * s)) +
                    kEpsilon * window * std::abs(chord.sin);
  chord.y_error =
      base_y_error_ + 0.5 * kEpsilon * std::abs(chord.y) +
      disc_.y_radius *
          ((disc_.radius_error + 5.0 * kEpsilon) * (std::abs(base_cos_ * s) + fall) +
           base_cos_error_ * (std::abs(s) + fall) + kEpsilon * window * std::abs(chord.cos));
  return chord;
}

DiscRule::End DiscRule::cutAt(double w_distance, double side) const {
  End end;
  if (whole_) {
    end.angle = side * M_PI_2;
    return end;
  }
  if (from_pole_ && side < 0.0) return end;
  const double d = nearest_w_ + side * w_distance - base_w_;
  const double w = base_w_ + d;
  const double cos = std::sqrt(std::max(0.0, (1.0 - w) * (1.0 + w)));
  const double sine = d * (base_cos_ + base_w_ * (base_w_ + w) / (cos + base_cos_));
  end.angle = std::atan2(sine, base_cos_ * cos + base_w_ * w);
  end.cut = true;
  return end;
}

void DiscRule::findRange() {
  const Chord first = chordAt(below_.angle), last = chordAt(above_.angle);
  const bool has_equator = first.sin <= 0.0 && last.sin >= 0.0;
  const double most_cos = has_equator ? 1.0 : std::max(first.cos, last.cos);
  largest_cos_ = std::min(1.0, most_cos + std::max(first.cos_error, last.cos_error));
  least_cos_ = below_.cut && above_.cut
                   ? std::min(first.cos - first.cos_error, last.cos - last.cos_error)
                   : 0.0;
  const double most_sin = std::max(std::abs(first.sin), std::abs(last.sin));
  most_sin_ =
      below_.cut ? std::min(1.0, most_sin + std::max(first.cos_error, last.cos_error) + 1e-9) : 1.0;
  reach_ = std::hypot(normal_x_ * disc_.x_radius, normal_y_ * disc_.y_radius);
  middle_ = normal_x_ * disc_.x_centre + normal_y_ * disc_.y_centre;
}

// By how much sinh² η / 2 raises the exponent.
double DiscRule::growth() const {
  return square(disc_.y_radius * largest_cos_) + square(disc_.x_radius * most_sin_);
}

// Where the exponent of the integrand has grown by `digits` at half a strip, a, the rule takes away
// twice as much.
void DiscRule::chooseStep(double digits) {
  const double length = above_.angle - below_.angle;
  if (!(length > 0.0)) return;
  findRange();
  const double distance = std::max(0.0, middle_ - reach_);
  const double strip = std::asinh(std::sqrt(2.0 * digits / (growth() + distance * reach_)));
  const double count = std::ceil(length * digits / (M_PI * strip));
  if (!(count <= kMostRuleNodes)) return;
  count_ = static_cast<int>(count);
  first_ = below_.angle;
  step_ = length / count_;
  bound(strip);
}

void DiscRule::bound(double strip) {
  const double sinh = std::sinh(strip);
  enlargement_ = std::cosh(strip) * (1.0 + kRuleSlack);
  const double decay = 2.0 * M_PI * strip / step_ * (1.0 - kRuleSlack);
  const double slack = kRuleSlack * (middle_ + enlargement_ * reach_) + disc_.x_error +
                       disc_.y_error + disc_.radius_error * enlargement_ * reach_;
  const double distance = std::max(0.0, middle_ - enlargement_ * reach_ - slack);
  const double exponent = 0.5 * sinh * sinh * growth() * (1.0 + 1e-12) - 0.5 * distance * distance;
  remainder_ =
      2.0 * (above_.angle - below_.angle) * std::exp(exponent - decay) / (1.0 - std::exp(-decay));
  const double outermost = std::max(0.0, middle_ - reach_ - slack);
  if (below_.cut) addCut(below_, -1.0, strip, decay, outermost);
  if (above_.cut) addCut(above_, 1.0, strip, decay, outermost);
  remainder_ *= 1.0 + 1e-9;
}

// The half-plane beyond the corner of a cut holds the rest of the disc if the disc's edge leaves
// the corner into it, since the rest is convex.
void DiscRule::addCut(const End& end, double side, double strip, double decay, double distance) {
  const Chord chord = chordAt(end.angle);
  const double cos = std::max(chord.cos, 0.0);
  const double x_error = disc_.x_error +
                         (chord.cos_error + disc_.radius_error * cos) * disc_.x_radius +
                         kRuleSlack * (disc_.x_centre + disc_.x_radius * cos);
  const double x = std::max(0.0, disc_.x_centre - chord.half - x_error);
  const double y = std::copysign(std::max(0.0, std::abs(chord.y) - chord.y_error), chord.y);
  const double along_y = disc_.y_radius * cos, along_x = disc_.x_radius * chord.sin;
  const double leaving = side * (y * along_y + x * along_x);
  const double leaving_error = 1e-9 * (std::abs(y * along_y) + std::abs(x * along_x)) +
                               std::abs(y) * disc_.y_radius * chord.cos_error;
  const double corner = leaving > leaving_error ? std::hypot(x, y) * (1.0 - kRuleSlack) : distance;
  const double density = std::exp(-0.5 * corner * corner) * (1.0 + 1e-9);
  mass_beyond_ += std::min(tailAbove(corner), 0.5 * disc_.x_radius * disc_.y_radius * density);
  // At iη beyond the end x² + y² is at least what it is there less fall (cosh η - 1), by convexity,
  // and cosh η - 1 <= sinh² η / 2.
  const double fall =
      2.0 * std::max(0.0, x * disc_.x_radius * cos - y * disc_.y_radius * chord.sin) +
      2.0 * (x_error * disc_.x_radius + chord.y_error * disc_.y_radius);
  const double sinh = std::sinh(strip);
  const double side_growth =
      0.5 * sinh * sinh * (1.0 + 1e-9) *
      (square(disc_.y_radius * (cos + chord.cos_error)) + square(along_x) + 0.5 * fall);
  remainder_ +=
      2.0 * strip *
      std::exp(-0.5 * (x * x + y * y) * (1.0 - kRuleSlack) + std::max(0.0, side_growth - decay));
}

}  // namespace fcl_prob::detail
