// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "partition/band_stall.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

// Of what turns so many pairs are looked at.
constexpr std::size_t kPairsOfLook = 8;

// Shares of the band's thickness: of the widths of a cell that is small beside it, and of a layer
// that is not worth making thinner.
constexpr double kSmallCell = 0.7;
constexpr double kThinnestLayer = 1.2;

// A turn moves points along some axes far more than across contacts.
constexpr double kSmallBesideTurns = 0.5;

double thicknessAlong(const Eigen::Vector3d& m, const OpenCell& open, const BandMargin& band) {
  if (!band.isOfSweeps()) return band.thicknessAlong(m);
  double most = 0.0;
  for (const FrontPair& pair : open.front) {
    if (!pair.isHalfSpace()) most = std::max(most, band.outwardAlong(m, pair.nodes));
  }
  return most;
}

double thicknessAlong(const Eigen::Vector3d& m, const OpenCell& open,
                      const TurningMargin& turning) {
  double most = 0.0;
  const std::size_t step = open.front.size() / kPairsOfLook + 1;
  for (std::size_t i = 0; i < open.front.size(); i += step) {
    const FrontPair& pair = open.front[i];
    if (!pair.isHalfSpace()) most = std::max(most, 2.0 * turning.along(m, pair.nodes));
  }
  return most;
}

template <typename Margin>
bool isSmallBeside(const Margin& margin, const OpenCell& open, double share) {
  for (int k = 0; k < open.cell.rank; ++k) {
    const double thickness = thicknessAlong(Eigen::Vector3d::Unit(k), open, margin);
    if (open.cell.hi[k] - open.cell.lo[k] > share * thickness) return false;
  }
  return true;
}

template <typename Margin>
bool isThinLayerOf(const Margin& margin, const OpenCell& open) {
  if (!open.planeCovers()) return false;
  const double layer = open.plane.s - open.possible_from;
  return layer <= kThinnestLayer * thicknessAlong(open.plane.m, open, margin);
}

}  // namespace

bool isAllBand(const OpenCell& open, const BandMargin& band) {
  return isSmallBeside(band, open, kSmallCell) || isThinLayerOf(band, open);
}

bool isAllTurning(const OpenCell& open, const TurningMargin& turning) {
  return open.planeCovers() ? isThinLayerOf(turning, open)
                            : isSmallBeside(turning, open, kSmallBesideTurns);
}

}  // namespace fcl_prob::detail
