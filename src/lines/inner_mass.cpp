// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/inner_mass.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// Of the reach: what the points within triangles and the heights of others above planes are rounded
// by, with much to spare.
constexpr double kInnerRounding = 4096 * kEpsilon;

// Faces whose normals have no more of the lines' direction are neither entered nor left by.
constexpr double kAlong = 1e-9;

}  // namespace

InnerMass::InnerMass(const WhitenedFan& fan)
    : fan_(fan), entries_(endsOf(-1.0)), exits_(endsOf(1.0)) {
  for (int f = 0; f < fan.faceCount(); ++f) {
    if (!(std::fabs(fan.faceNormal(f).x()) > kAlong)) along_.push_back(f);
  }
}

InnerMass::Ends InnerMass::endsOf(double sign) const {
  std::vector<int> faces;
  for (int f = 0; f < fan_.faceCount(); ++f) {
    if (sign * fan_.faceNormal(f).x() > kAlong) faces.push_back(f);
  }
  const auto count = static_cast<Eigen::Index>(faces.size());
  Ends ends{Eigen::ArrayXd(count), Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const int f = faces[static_cast<std::size_t>(i)];
    const Eigen::Vector3d& n = fan_.faceNormal(f);
    ends.at[i] = leftOf(f, Eigen::Vector3d::Zero()) / n.x();
    ends.first[i] = n.y() / n.x();
    ends.second[i] = n.z() / n.x();
  }
  return ends;
}

LineSpan InnerMass::on(const Eigen::Vector2d& u, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d from = Eigen::Vector3d(0.0, u[0], u[1]) - point;
  const auto passedAt = [&from](const Ends& ends) {
    return ends.at - ends.first * from[1] - ends.second * from[2];
  };
  const LineSpan none{kReach, -kReach};
  if (entries_.at.size() == 0 || exits_.at.size() == 0) return none;
  for (const int f : along_) {
    if (!(leftOf(f, from) > kAlong * 2 * kReach)) return none;
  }
  const double rounded = 8 * kEpsilon * fan_.reach();
  return {std::max(passedAt(entries_).maxCoeff() - from[0] + rounded, -kReach),
          std::min(passedAt(exits_).minCoeff() - from[0] - rounded, kReach)};
}

// P put to a point has the y with n·(y - point) <= offset; what is below all faces by their margins
// is certainly within (see WhitenedFan). On a line that is `from` the point at y_0 = 0, so much is
// left for n_0 y_0.
double InnerMass::leftOf(int face, const Eigen::Vector3d& from) const {
  const double inner = fan_.faceMargin(face) - fan_.facePad(face) + kInnerRounding * fan_.reach();
  return fan_.faceOffset(face) - inner - fan_.faceNormal(face).dot(from);
}

}  // namespace fcl_prob::detail
