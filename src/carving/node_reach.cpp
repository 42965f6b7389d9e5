// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "carving/node_reach.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "carving/different_faces.h"

namespace fcl_prob::detail {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

float roundedUp(double value) { return std::nextafter(static_cast<float>(value), kInfinite); }
float roundedDown(double value) { return std::nextafter(static_cast<float>(value), -kInfinite); }

}  // namespace

NodeReach::NodeReach(const WhitenedFan& fan, const PatchedMesh& pieces)
    : rounding_(fan.padding(Eigen::Vector3d::Ones())) {
  std::vector<int> faces(static_cast<std::size_t>(fan.faceCount()));
  std::iota(faces.begin(), faces.end(), 0);
  faces = differentFaces(fan, faces, Eigen::Vector3d::UnitX(), kFaces);
  const WhitenedTree& mesh = fan.mesh();
  std::vector<Heights> at_vertices(mesh.vertices.size(), Heights::Constant(kInfinite));
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Eigen::Vector3d& n = fan.faceNormal(faces[k]);
    normals_.push_back(n);
    const double offset = fan.faceOffset(faces[k]) + rounding_;
    for (std::size_t v = 0; v < at_vertices.size(); ++v) {
      at_vertices[v][static_cast<int>(k)] =
          roundedUp(offset + n.dot(fan.corner(static_cast<int>(v))));
    }
  }
  highest_.resize(pieces.nodes().size());
  for (std::size_t i = highest_.size(); i-- > 0;) {
    const PatchedMesh::Node& node = pieces.nodes()[i];
    if (node.left < 0) {
      const Eigen::Vector3i& t = mesh.tree->triangles[node.piece];
      highest_[i] = at_vertices[t[0]].max(at_vertices[t[1]]).max(at_vertices[t[2]]);
    } else {
      highest_[i] = highest_[node.left].max(highest_[node.right]);
    }
  }
}

NodeReach::Heights NodeReach::lowestOf(const Eigen::Vector3d& middle,
                                       const Eigen::Vector3d& half) const {
  Heights lowest = Heights::Constant(-kInfinite);
  for (std::size_t k = 0; k < normals_.size(); ++k) {
    const Eigen::Vector3d& n = normals_[k];
    lowest[static_cast<int>(k)] = roundedDown(n.dot(middle) - n.cwiseAbs().dot(half) - rounding_);
  }
  return lowest;
}

}  // namespace fcl_prob::detail
