// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/band_stall.h"

#include <algorithm>

namespace fcl_prob::detail {
namespace {

// Shares of the band's thickness: of the widths of a cell that is small beside it, and of a layer
// that is not worth making thinner.
constexpr double kSmallCell = 0.7;
constexpr double kThinnestLayer = 1.2;

double thicknessAlong(const Eigen::Vector3d& m, const OpenCell& open, const BandMargin& band) {
  if (!band.isOfSweeps()) return band.thicknessAlong(m);
  double most = 0.0;
  for (const FrontPair& pair : open.front) {
    if (!pair.isLayer()) most = std::max(most, band.outwardAlong(m, pair.nodes));
  }
  return most;
}

bool isSmallBeside(const BandMargin& band, const OpenCell& open) {
  for (int k = 0; k < open.cell.rank; ++k) {
    const double thickness = thicknessAlong(Eigen::Vector3d::Unit(k), open, band);
    if (open.cell.hi[k] - open.cell.lo[k] > kSmallCell * thickness) return false;
  }
  return true;
}

bool isThinLayerOf(const BandMargin& band, const OpenCell& open) {
  if (!open.planeCovers()) return false;
  const double layer = open.plane.s - open.possible_from;
  return layer <= kThinnestLayer * thicknessAlong(open.plane.m, open, band);
}

}  // namespace

bool isAllBand(const OpenCell& open, const BandMargin& band) {
  return isSmallBeside(band, open) || isThinLayerOf(band, open);
}

}  // namespace fcl_prob::detail
