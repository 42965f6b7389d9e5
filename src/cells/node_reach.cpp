// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/node_reach.h"

#include <numeric>

#include "base/constants.h"
#include "cells/different_faces.h"
#include "cells/rounded_floats.h"

namespace fcl_prob::detail {

NodeReach::NodeReach(const WhitenedFan& fan, const WhitenedPolygons& pieces)
    : rounding_(fan.padding(Eigen::Vector3d::Ones())) {
  std::vector<int> faces(static_cast<std::size_t>(fan.faceCount()));
  std::iota(faces.begin(), faces.end(), 0);
  faces = differentFaces(fan, faces, Eigen::Vector3d::UnitX(), kFaces);
  normals_.setZero();
  Places offsets = Places::Constant(kInfinity);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    normals_.row(place) = fan.faceNormal(faces[k]).transpose();
    offsets[place] = fan.faceOffset(faces[k]) + rounding_;
  }
  const WhitenedTree& mesh = fan.mesh();
  std::vector<Heights> at_vertices(mesh.vertices.size());
  for (std::size_t v = 0; v < at_vertices.size(); ++v) {
    at_vertices[v] = floatsAbove(offsets + along(fan.corner(static_cast<int>(v))));
  }
  highest_.resize(pieces.nodes().size());
  boxes_.resize(pieces.nodes().size());
  for (std::size_t i = highest_.size(); i-- > 0;) {
    boxes_[i] = fan.obstacleBox(pieces.box(static_cast<int>(i)));
    const WhitenedPolygons::Node& node = pieces.nodes()[i];
    if (node.left < 0) {
      const Eigen::Vector3i& t = mesh.tree->triangles[node.piece];
      highest_[i] = at_vertices[t[0]].max(at_vertices[t[1]]).max(at_vertices[t[2]]);
    } else {
      highest_[i] = highest_[node.left].max(highest_[node.right]);
    }
  }
}

NodeReach::Places NodeReach::along(const Eigen::Vector3d& y) const {
  return normals_.col(0).array() * y[0] + normals_.col(1).array() * y[1] +
         normals_.col(2).array() * y[2];
}

NodeReach::Places NodeReach::widthsOf(const Eigen::Vector3d& half) const {
  return normals_.col(0).array().abs() * half[0] + normals_.col(1).array().abs() * half[1] +
         normals_.col(2).array().abs() * half[2];
}

// The padding of all three axes pays for the heights of the cell, as that in the constructor for
// the planes; what floats round goes outwards.
NodeReach::Heights NodeReach::lowestOf(const Eigen::Vector3d& middle,
                                       const Eigen::Vector3d& half) const {
  return floatsBelow(along(middle) - widthsOf(half) - rounding_);
}

NodeReach::Heights NodeReach::highestOf(const Eigen::Vector3d& middle,
                                        const Eigen::Vector3d& half) const {
  return floatsAbove(along(middle) + widthsOf(half) + rounding_);
}

}  // namespace fcl_prob::detail
