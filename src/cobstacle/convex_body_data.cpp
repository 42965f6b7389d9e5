// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cobstacle/convex_body_data.h"

#include <algorithm>

#include "geometry/length.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

/// No polytope around a ball reaches farther than this times its radius.
constexpr double kCircumscribed = 2.0;

std::vector<Eigen::Vector3d> cornersOf(const Zonotope& zonotope) {
  std::vector<Eigen::Vector3d> corners;
  const int count = zonotope.generatorCount();
  for (unsigned signs = 0; signs < 1u << count; ++signs) {
    Eigen::Vector3d corner = zonotope.centre();
    for (int i = 0; i < count; ++i) {
      corner += ((signs >> i) & 1u ? 1.0 : -1.0) * zonotope.generator(i);
    }
    corners.push_back(corner);
  }
  return corners;
}

std::unique_ptr<const ConvexSet> convexSetOf(const RoundedZonotope& body, int resolution) {
  const std::vector<Eigen::Vector3d> corners = cornersOf(body.core);
  if (body.radius == 0.0) {
    if (FaceSet faces; body.core.generatorCount() == 3 && body.core.faces(faces)) {
      const ConvexPolytope box = toPolytope(faces);
      if (box.faces.size() == 6) return std::make_unique<PolytopeSet>(makeConvexMesh(box));
    }
    return std::make_unique<PolytopeSet>(makeConvexMesh(corners));
  }
  const SupportShape shape{corners, static_cast<int>(corners.size()),
                           body.radius * Eigen::Matrix3d::Identity()};
  return std::make_unique<SweptSet>(shape, resolution);
}

}  // namespace

const ConvexSet& ConvexBodyData::set() const {
  std::call_once(once_, [this] {
    if (!set_) set_ = convexSetOf(*rounded, resolution);
  });
  return *set_;
}

double ConvexBodyData::size() const {
  if (!rounded) return set().size();
  double size = lengthOf(rounded->core.centre()) + kCircumscribed * rounded->radius;
  for (int i = 0; i < rounded->core.generatorCount(); ++i)
    size += lengthOf(rounded->core.generator(i));
  return size;
}

PairFrame pairFrame(const ConvexBody& a, const fcl::Transform3d& pose_a, const ConvexBody& b,
                    const fcl::Transform3d& pose_b, const GaussianDisplacement& displacement) {
  validatePose(pose_a, "pose of A");
  validatePose(pose_b, "pose of B");
  PairFrame frame(displacement, pose_a, a.data().size(), pose_b, b.data().size());
  frame.error += a.data().slack() + b.data().slack();
  return frame;
}

PairObstacle::PairObstacle(const PairFrame& frame, const ConvexBodyData& a,
                           const ConvexBodyData& b) {
  if (a.rounded && b.rounded) {
    obstacle_.emplace<ZonotopeObstacle>(frame, *a.rounded, *b.rounded);
  } else {
    obstacle_.emplace<ConvexSetObstacle>(frame, a.set(), b.set());
  }
}

const CObstacle& PairObstacle::operator*() const {
  if (const auto* zonotope = std::get_if<ZonotopeObstacle>(&obstacle_)) return *zonotope;
  return std::get<ConvexSetObstacle>(obstacle_);
}

}  // namespace fcl_prob::detail
