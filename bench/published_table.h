// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Tables I and II of the paper, as printed.
#pragma once

#include <optional>
#include <string>

namespace fcl_prob::cli {

struct PublishedRow {
  double bounding_volume_error;
  double probability_percent;
  double time_ms;
};

/// What Table I prints for a kind of bounding volume ("sphere", "aabb", "obb", "kdop26", "convex")
/// or for Monte Carlo ("monte-carlo") in a benchmark scene ("bunny_1cm", ...); nothing for what it
/// does not have. Its poses and its machine are not ours.
std::optional<PublishedRow> publishedRow(const std::string& row, const std::string& scene);

struct PublishedPath {
  double probability_percent;
  double time_ms;
};

/// The same of Table II, for its scenes "cans" and "waving".
std::optional<PublishedPath> publishedPath(const std::string& row, const std::string& scene);

}  // namespace fcl_prob::cli
