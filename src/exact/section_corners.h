// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Polygons within and around a planar section of which points and lines are known.
#pragma once

#include <optional>
#include <vector>

#include "exact/principal_section.h"
#include "mass/polygon_mass.h"

namespace fcl_prob::detail {

/// By how much a corner of innerCorners() may be off one of the points.
inline constexpr double kGridRounding = 0x1p-48;

/// Where the lines of two neighbours meet, from the point of the first.
/// \param margin  by which both are moved outwards first
Eigen::Vector2d apexOf(const SectionTouch& first, const SectionTouch& second, double margin = 0.0);

/// A polygon whose corners are some of the points, which are in about that order; it goes once
/// around `centre` and turns to the left as seen from there, decided exactly, so that it bounds
/// what is in the hull of its corners. Nothing if there is none, or coordinates are 4 or more.
std::optional<Polygon2> innerCorners(const Polygon2& points, const Eigen::Vector2d& centre);

/// A polygon of the same kind around a section that holds `centre`: its sides are beyond some of
/// the lines around the section, which are in about that order. Those that neighbours make
/// superfluous (by rounding) are left out.
std::optional<Polygon2> outerCorners(std::vector<const SectionTouch*> lines,
                                     const Eigen::Vector2d& centre);

}  // namespace fcl_prob::detail
