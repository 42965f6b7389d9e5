// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Trapezoidal rules for integrals over a disc (whitened: an ellipse) under N(0, I), with a proven
// bound on their error.
#pragma once

#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {

/// The ellipse of the points (x_centre + x_radius cos θ, y_centre + y_radius sin θ) under N(0, I):
/// the image of a disc along its principal axes. Both centres are >= 0, both radii positive and
/// x_radius <= y_radius.
struct WhitenedDisc {
  double x_centre, x_radius;
  double y_centre, y_radius;
  double y_pole;  ///< y_centre - y_radius, without the rounding of a difference
  double x_error, y_error, y_pole_error;  ///< of both centres and the pole, absolute
  double radius_error;                    ///< of both radii, relative

  /// Whether the origin is inside, as far as rounding tells. What rests on it holds either way.
  bool containsOrigin() const;
};

/// Where the chords x_centre ± x_radius cos θ of a disc are, at an angle given by its difference to
/// that of the rule's base, so that nothing is lost where a thousandth of a deviation is 1e-15 of
/// the disc.
struct Chord {
  double y;
  double half;       ///< of its length: x_radius cos θ
  double cos, sin;   ///< of θ
  double cos_error;  ///< absolute
  double y_error;    ///< absolute
};

/// n + 1/2 steps from one end of a window of angles to the other: ∫ f dθ = step Σ f(θ_k) + error.
/// An end is either at ±π/2, where f is even and so periodic with its mirror image, or cut off
/// where little is left.
///
/// f is analytic everywhere; with g(z) = 1 / (1 + exp(-2πi (z - first end)/step)) the residues of f
/// g at the nodes make the sum, so the error is at most
///   2 length sup|f(θ ± ia)| / (exp(2πa/step) - 1) + Σ over cut ends 2a sup|f(end + iy)| / (1 +
///   exp(2πy/step))
/// (Trefethen and Weideman 2014, "The exponentially convergent trapezoidal rule", section 5; the
/// integrals over the sides at mirrored ends cancel). For f = exp(-(x² + y²)/2) times a factor:
/// at θ + iη the real parts of (x, y) are in the ellipse enlarged by cosh η, hence not in a
/// half-space n·(x, y) < h, and the imaginary ones are sinh η (x_radius sin θ, y_radius cos θ).
class DiscRule {
 public:
  /// \param digits  how small the error should be, in powers of e below the largest integrand; it
  ///                steers, and bounds nothing.
  DiscRule(const WhitenedDisc& disc, double digits);

  /// False if the disc asks for more than a fixed number of nodes: the rule has none.
  bool exists() const { return count_ > 0; }

  int count() const { return count_; }
  double step() const { return step_; }
  Chord chord(int k) const { return chordAt(first_ + (k + 0.5) * step_); }

  /// Largest |cos| of the angles with imaginary parts up to the strip's; and the least of the
  /// window's real angles.
  double largestCos() const { return largest_cos_; }
  double leastCos() const { return least_cos_; }

  /// cosh of half the strip's width: what it enlarges the ellipse by.
  double enlargement() const { return enlargement_; }

  /// With |f| <= factor |exp(-(x² + y²)/2)| in the strip: a bound on the rule's error over the
  /// window, by factor.
  double remainder() const { return remainder_; }

  /// A bound on the mass of the disc beyond the cut ends.
  double massBeyond() const { return mass_beyond_; }

 private:
  struct End {
    double angle = 0.0;  ///< relative to the base
    bool cut = false;    ///< or mirrored
  };

  void findNearest();
  double squareAt(double w) const;
  double distanceToCut(double side, double level) const;
  void chooseBase(double below, double above);
  Chord chordAt(double delta) const;
  End cutAt(double w_distance, double side) const;
  void findRange();
  void chooseStep(double digits);
  double growth() const;
  void bound(double strip);
  void addCut(const End& end, double side, double strip, double decay, double distance);

  const WhitenedDisc& disc_;
  double nearest_w_ = 0.0;                  ///< sine of the nearest point's angle
  double normal_x_ = 0.0, normal_y_ = 0.0;  ///< half-space that contains the disc
  bool whole_ = false, from_pole_ = false;  ///< whether both ends are mirrored, or the lower one
  double base_w_ = 0.0, base_cos_ = 1.0, base_y_ = 0.0, base_cos_error_ = 0.0, base_y_error_ = 0.0;
  End below_, above_;
  double reach_ = 0.0, middle_ = 0.0;  ///< of the disc and its centre along the normal
  double most_sin_ = 1.0;
  double first_ = 0.0, step_ = 0.0;
  int count_ = 0;
  double largest_cos_ = 1.0, least_cos_ = 0.0, enlargement_ = 1.0;
  double remainder_ = kInfinity, mass_beyond_ = 0.0;
};

}  // namespace fcl_prob::detail
