// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/picture_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fcl_prob::cli {

Colour heat(double likelihood) {
  static const std::array<Colour, 4> kStops{
      Colour(0.80F, 0.84F, 0.88F, 1.0F), Colour(1.0F, 0.85F, 0.25F, 1.0F),
      Colour(1.0F, 0.30F, 0.03F, 1.0F), Colour(0.60F, 0.0F, 0.02F, 1.0F)};
  const double position = std::sqrt(std::clamp(likelihood, 0.0, 1.0)) * (kStops.size() - 1);
  const std::size_t stop = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const auto fraction = static_cast<float>(position - static_cast<double>(stop));
  return (1.0F - fraction) * kStops[stop] + fraction * kStops[stop + 1];
}

Colour touchedColour() { return {0.45F, 0.65F, 1.0F, 1.0F}; }

Colour ellipsoidColour(int deviations) {
  return {0.05F, 0.6F, 0.2F, 0.6F / static_cast<float>(deviations)};
}

}  // namespace fcl_prob::cli
