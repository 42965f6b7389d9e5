// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/size_note.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {
namespace {

// What is taken for wrong units: millimetres for metres are 1,000.
constexpr double kFarOff = 1e3;
constexpr double kFarBelow = 1e4;

double lengthOf(const PreparedGeometry& mesh) { return mesh.localBox().sizes().maxCoeff(); }

std::string metres(double length) {
  std::ostringstream text;
  text << std::setprecision(2) << length << " m";
  return text.str();
}

}  // namespace

std::optional<std::string> sizeNote(const PreparedGeometry& a, const PreparedGeometry& b,
                                    const GaussianDisplacement& displacement) {
  const auto isMesh = [](const PreparedGeometry& each) {
    return kindOf(each.geometry()) == GeometryKind::mesh;
  };
  if (displacement.rank() == 0 || !isMesh(a) || !isMesh(b)) return std::nullopt;
  const double of_a = lengthOf(a), of_b = lengthOf(b);
  const double longer = std::max(of_a, of_b), shorter = std::min(of_a, of_b);
  const double deviation = displacement.standardDeviations()[0];
  const std::string lengths = "A is " + metres(of_a) + " long, B " + metres(of_b);
  if (longer >= kFarOff * shorter) return lengths + ": are both in metres?";
  if (deviation >= kFarOff * longer || kFarBelow * deviation <= longer) {
    return lengths + ", the largest deviation " + metres(deviation) + ": are all in metres?";
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
