// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "decomposition/cover_proof.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "decomposition/surface_piece.h"

namespace fcl_prob::detail {
namespace {

/// A cut makes its points from two others: subtraction, quotient, product and sum.
constexpr double kRoundingsOfCut = 16.0 * std::numeric_limits<double>::epsilon();

/// What is left of a triangle: a convex polygon, and how many cuts its corners come from.
struct Rest {
  std::vector<Eigen::Vector3d> corners;
  int cuts = 0;
};

/// A polytope as half-spaces, each within all corners of its face.
struct Solid {
  Eigen::AlignedBox3d box;
  std::vector<CutPlane> faces;
};

Solid solidOf(const ConvexPolytope& polytope, double margin) {
  Solid solid;
  for (const Eigen::Vector3d& v : polytope.vertices) solid.box.extend(v);
  for (const ConvexPolytope::Face& face : polytope.faces) {
    // A segment from the middle to a point outside leaves through some face, where it is no lower
    // than that face's lowest corner: so points below all of those are inside.
    double lowest = std::numeric_limits<double>::infinity();
    for (const int corner : face.vertices) {
      lowest = std::min(lowest, face.normal.dot(polytope.vertices[corner]));
    }
    solid.faces.push_back({face.normal, lowest - margin});
  }
  return solid;
}

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
  TriangleCover(const std::vector<ConvexPolytope>& polytopes, double size, double margin)
      : most_cuts_(static_cast<int>(margin / (kRoundingsOfCut * size))) {
    // Heights are rounded, too, by no more than a cut.
    for (const ConvexPolytope& polytope : polytopes) {
      solids_.push_back(solidOf(polytope, margin + kRoundingsOfCut * size));
    }
  }

  bool covers(const std::vector<Eigen::Vector3d>& triangle) {
    rests_ = {{triangle, 0}};
    for (const Solid& solid : solids_) {
      takeOff(solid);
      if (rests_.empty()) return true;
    }
    return false;
  }

 private:
  void takeOff(const Solid& solid) {
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
  void split(Rest rest, const Solid& solid) {
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

  bool isOutside(const Rest& rest, const Solid& solid) {
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
  std::vector<Solid> solids_;
  std::vector<Rest> rests_;
  std::vector<Rest> left_;
  std::vector<double> heights_;
};

}  // namespace

std::optional<std::size_t> firstUncovered(const TriangleMesh& mesh,
                                          const std::vector<ConvexPolytope>& polytopes,
                                          double margin) {
  double size = 0.0;
  for (const fcl::Vector3d& v : mesh.vertices) size = std::max(size, v.stableNorm());
  for (const ConvexPolytope& polytope : polytopes) {
    for (const Eigen::Vector3d& v : polytope.vertices) size = std::max(size, v.stableNorm());
  }
  TriangleCover cover(polytopes, size, margin);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    std::vector<Eigen::Vector3d> corners;
    for (int c = 0; c < 3; ++c) corners.push_back(mesh.vertices[mesh.triangles[i][c]]);
    if (!cover.covers(corners)) return i;
  }
  return std::nullopt;
}

}  // namespace fcl_prob::detail
