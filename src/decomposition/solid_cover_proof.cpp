// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/solid_cover_proof.h"

#include <algorithm>
#include <limits>

#include "convex/cut_polytope.h"
#include "decomposition/lowered_polytope.h"
#include "decomposition/point_sets.h"

namespace fcl_prob::detail {
namespace {

/// Rests at most, so that the proof ends.
constexpr std::size_t kMostRests = 200'000;

/// What is left of the box: the hull of the corners, and how many cuts they come from.
struct SolidRest {
  FaceSet surface;
  int cuts = 0;
};

/// The lowest and the highest corner above a plane.
struct Heights {
  double lowest;
  double highest;
};

Heights heightsAbove(const CutPlane& plane, const SolidRest& rest) {
  Heights heights{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  for (const Eigen::Vector3d& corner : rest.surface.vertices()) {
    const double height = plane.height(corner);
    heights.lowest = std::min(heights.lowest, height);
    heights.highest = std::max(heights.highest, height);
  }
  return heights;
}

/// Polytopes are lowered by half of the depth by which the surface is inside them. What is left of
/// the box is therefore further from the surface than cuts and `thin_` can have moved it.
class BoxCover {
 public:
  BoxCover(const TriangleMesh& mesh, const std::vector<ConvexPolytope>& polytopes,
           CoverMargins margins)
      : thin_(0.1 * margins.depth) {
    const double rounding = kRoundingsOfCut * sizeOf(mesh, polytopes);
    most_cuts_ = static_cast<int>(0.25 * margins.depth / rounding);
    most_on_wrong_side_ = rounding;
    for (const ConvexPolytope& polytope : polytopes) {
      solids_.emplace_back(polytope, 0.5 * margins.depth + rounding);
    }
    rests_.push_back({boxAround(mesh)});
  }

  /// False if there are too many, or a cut went wrong.
  bool takeOffAll() {
    for (const LoweredPolytope& solid : solids_) {
      left_.clear();
      for (SolidRest& rest : rests_) {
        if (isOutside(rest, solid)) {
          left_.push_back(std::move(rest));
        } else if (!split(std::move(rest), solid)) {
          return false;
        }
      }
      rests_.swap(left_);
    }
    return wrong_side_ <= most_on_wrong_side_;
  }

  const std::vector<SolidRest>& rests() const { return rests_; }

 private:
  bool isOutside(const SolidRest& rest, const LoweredPolytope& solid) const {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : rest.surface.vertices()) box.extend(corner);
    if (!box.intersects(solid.box)) return true;
    return std::any_of(solid.faces.begin(), solid.faces.end(), [&](const CutPlane& face) {
      return heightsAbove(face, rest).lowest >= -thin_;
    });
  }

  /// What is beyond one face after the other is left; what then remains is inside.
  bool split(SolidRest rest, const LoweredPolytope& solid) {
    for (const CutPlane& face : solid.faces) {
      const Heights heights = heightsAbove(face, rest);
      if (heights.highest <= thin_) continue;
      if (rest.cuts >= most_cuts_ || left_.size() >= kMostRests) return false;
      if (heights.lowest >= -thin_) {
        left_.push_back(std::move(rest));
        return true;
      }
      left_.push_back(below(face.flipped(), rest));
      rest = below(face, rest);
    }
    return true;
  }

  SolidRest below(const CutPlane& plane, const SolidRest& whole) {
    cutter_.start(whole.surface);
    wrong_side_ = std::max(wrong_side_, cutter_.cut(plane.normal, plane.offset));
    SolidRest rest;
    rest.cuts = whole.cuts + 1;
    cutter_.writeTo(rest.surface);
    return rest;
  }

  double thin_;
  int most_cuts_ = 0;
  double most_on_wrong_side_ = 0.0;
  double wrong_side_ = 0.0;  ///< the largest of any cut
  std::vector<LoweredPolytope> solids_;
  std::vector<SolidRest> rests_;
  std::vector<SolidRest> left_;
  CutPolytope cutter_;
};

bool isProvenOutside(const SolidRest& rest, const ClosedMesh& solid) {
  for (const Eigen::Vector3d& corner : rest.surface.vertices()) {
    const Containment containment = solid.contains(corner);
    if (containment != Containment::unknown) return containment == Containment::outside;
  }
  return rest.surface.vertices().empty();
}

}  // namespace

bool solidIsCovered(const TriangleMesh& mesh, const ClosedMesh& solid,
                    const std::vector<ConvexPolytope>& polytopes, CoverMargins margins) {
  BoxCover cover(mesh, polytopes, margins);
  if (!cover.takeOffAll()) return false;
  return std::all_of(cover.rests().begin(), cover.rests().end(),
                     [&](const SolidRest& rest) { return isProvenOutside(rest, solid); });
}

}  // namespace fcl_prob::detail
