// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The normals of a sum of two frustums: where on the sphere of normals which end of each is
// farthest.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace fcl_prob::detail {

/// Axes that are less apart than this (radians) are taken for parallel, and ones that are as near
/// to a right angle for perpendicular.
inline constexpr double kAxesTie = 1e-11;

/// The normals n of a frustum's side: n·axis = lift |n|, cosine² + lift² = 1. Above the circle, on
/// the side of the axis, the top of the frustum is farthest along n.
struct NormalCircle {
  Eigen::Vector3d axis;
  double cosine, lift;
};

/// A normal on one side of the plane of both axes, and its mirror image; both are the same in that
/// plane.
struct NormalNode {
  std::array<Eigen::Vector3d, 2> normal;
  int pole = -1;  ///< the axis that it is along, if any
};

/// Directions between those from `from` to `to`, along the arc of a circle or (-1) of a great one,
/// and the apex; anticlockwise, seen from outside. If a node is a pole, it is the apex.
struct NormalTriangle {
  int from, to, apex;
  int circle;
  std::array<bool, 2> above;  ///< either circle
};

/// A piece of a circle, anticlockwise about its axis.
struct NormalArc {
  int circle, from, to;
  bool above_other;
};

/// Half of the sphere of normals, on one side of the plane of the axes. The other half mirrors it.
struct NormalOverlay {
  std::vector<NormalNode> nodes;
  std::vector<NormalTriangle> triangles;
  std::vector<NormalArc> arcs;
  std::optional<int> crossing;  ///< where the circles meet, if they do

  const Eigen::Vector3d& normal(int node, std::size_t half) const {
    return nodes[static_cast<std::size_t>(node)].normal[half];
  }
  int poleAt(int node) const { return nodes[static_cast<std::size_t>(node)].pole; }
};

/// Both circles cut the half sphere into regions, each bounded by arcs of them and by a part of the
/// half sphere's edge. Triangles of a region have their apex on that edge, at a pole if there is
/// one. They may overlap where a region is bent, and reach beyond it: no triangle has a pole but as
/// its apex, so that a function of normals that is smooth but for poles has the same integral over
/// all of them, with their signs, as over the region.
///
/// \param axes  at an angle of kAxesTie or more, up to a right one
/// \return nothing where circles or poles nearly touch, but for perpendicular axes
std::optional<NormalOverlay> normalOverlay(const std::array<NormalCircle, 2>& circles);

}  // namespace fcl_prob::detail
