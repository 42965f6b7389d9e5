// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// ∫ φ(z) M(z) dz of a function that is known at a few places only.
#pragma once

#include <vector>

#include "fcl_prob/bounds.h"

namespace fcl_prob::detail {

/// Certified bounds on ∫ φ(z) M(z) dz for 0 <= M <= 1 with log M concave, from bounds on M at some
/// z. Between two places log M is above its chord and below the lines through its neighbours on
/// either side; each line's exponential has a closed form under φ. The gap falls with the square of
/// the distances.
class LogConcaveIntegral {
 public:
  /// \param place_error  no z is farther than that from where M was taken
  explicit LogConcaveIntegral(double place_error) : place_error_(place_error) {}

  /// \param z  another one than those before, up to kFarthestPlace on either side
  void add(double z, const Bounds& value);

  static constexpr double kFarthestPlace = 20.0;

  /// {0, 1} of less than two places.
  Bounds bounds() const;

  /// Where another place would narrow the bounds most.
  double widest() const;

  /// By how much the log of the middle one of three neighbours is above their chord, at the most.
  double mostBend() const;

 private:
  struct Place {
    double z, lower, upper;  ///< of log M
  };

  /// log M is at the most value + slope (z - at).
  struct Line {
    double at, value, slope;
  };

  Bounds piece(std::size_t k) const;
  double lowerOf(std::size_t k) const;
  double upperOf(std::size_t k) const;
  std::vector<Line> linesOver(std::size_t k) const;
  double slackOf(std::size_t k, double slope) const;
  double integral(const Line& line, double from, double to) const;
  double pieceFrom(std::size_t k) const;
  double pieceTo(std::size_t k) const;

  double place_error_;
  std::vector<Place> places_;  ///< ascending
};

}  // namespace fcl_prob::detail
