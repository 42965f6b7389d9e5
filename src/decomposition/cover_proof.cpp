// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/cover_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "decomposition/lowered_polytope.h"

namespace fcl_prob::detail {
namespace {

/// What is left of a triangle: a convex polygon, and how many cuts its corners come from.
struct Rest {
  std::vector<Eigen::Vector3d> corners;
  int cuts = 0;
};

/// The part of a convex polygon at heights of at least 0 (or at most 0, for the sign -1).
std::vector<Eigen::Vector3d> side(const std::vector<Eigen::Vector3d>& corners,
                                  const std::vector<double>& heights, double sign) {
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = i + 1 < corners.size() ? i + 1 : 0;
    if (sign * heights[i] >= 0.0) kept.push_back(corners[i]);
    if (std::min(heights[i], heights[next]) < 0.0 && std::max(heights[i], heights[next]) > 0.0) {
      kept.push_back(crossingPoint(corners[i], heights[i], corners[next], heights[next]));
    }
  }
  return kept;
}

class TriangleCover {
 public:
  TriangleCover(const std::vector<ConvexPolytope>& polytopes, double size, CoverMargins margins)
      : most_cuts_(static_cast<int>(margins.rounding / (kRoundingsOfCut * size))) {
    const double margin = margins.depth + margins.rounding;
    // Heights are rounded, too, by no more than a cut.
    for (const ConvexPolytope& polytope : polytopes) {
      solids_.emplace_back(polytope, margin + kRoundingsOfCut * size);
    }
  }

  bool covers(const std::vector<Eigen::Vector3d>& triangle) {
    rests_ = {{triangle, 0}};
    for (const LoweredPolytope& solid : solids_) {
      takeOff(solid);
      if (rests_.empty()) return true;
    }
    return false;
  }

 private:
  void takeOff(const LoweredPolytope& solid) {
    left_.clear();
    for (Rest& rest : rests_) {
      if (isOutside(rest, solid)) {
        left_.push_back(std::move(rest));
      } else {
        split(std::move(rest), solid);
      }
    }
    rests_.swap(left_);
  }

  /// What is beyond one face after the other is left; what then remains is inside.
  void split(Rest rest, const LoweredPolytope& solid) {
    for (const CutPlane& face : solid.faces) {
      heightsOf(rest, face);
      const auto [lowest, highest] = std::minmax_element(heights_.begin(), heights_.end());
      if (*highest <= 0.0) continue;
      if (*lowest >= 0.0 || rest.cuts >= most_cuts_) {
        left_.push_back(std::move(rest));
        return;
      }
      left_.push_back({side(rest.corners, heights_, 1.0), rest.cuts + 1});
      rest = {side(rest.corners, heights_, -1.0), rest.cuts + 1};
    }
  }

  bool isOutside(const Rest& rest, const LoweredPolytope& solid) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& corner : rest.corners) box.extend(corner);
    if (!box.intersects(solid.box)) return true;
    return std::any_of(solid.faces.begin(), solid.faces.end(), [&](const CutPlane& face) {
      heightsOf(rest, face);
      return *std::min_element(heights_.begin(), heights_.end()) >= 0.0;
    });
  }

  void heightsOf(const Rest& rest, const CutPlane& face) {
    heights_.clear();
    for (const Eigen::Vector3d& corner : rest.corners) heights_.push_back(face.height(corner));
  }

  int most_cuts_;
  std::vector<LoweredPolytope> solids_;
  std::vector<Rest> rests_;
  std::vector<Rest> left_;
  std::vector<double> heights_;
};

}  // namespace

std::optional<std::size_t> firstUncovered(const TriangleMesh& mesh,
                                          const std::vector<ConvexPolytope>& polytopes,
                                          CoverMargins margins) {
  TriangleCover cover(polytopes, sizeOf(mesh, polytopes), margins);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::vector<Eigen::Vector3d> corners;
    for (int c = 0; c < 3; ++c) corners.push_back(mesh.vertices[mesh.triangles[i][c]]);
    if (!cover.covers(corners)) return i;
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
