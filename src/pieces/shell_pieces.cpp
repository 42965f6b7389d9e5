// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/shell_pieces.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <set>

namespace fcl_prob::detail {
namespace {

// Where the fourth corner is: on the way from the middle of the triangle to the apex, or else below
// that middle, as a share of the triangle's size. The deepest that is within the mesh.
constexpr std::array kDepths{1.0, 0.5, 0.25, 0.1, 0.03};

// A mesh with more of them is left to its triangles.
constexpr int kMostPieces = 1'000;

std::array<double, 3> key(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

class PieceMaker {
 public:
  PieceMaker(const MeshView& view, const std::vector<Eigen::Vector3d>& vertices,
             const SurroundingMesh& mesh, const Eigen::Vector3d& apex)
      : view_(view), vertices_(vertices), mesh_(mesh), apex_(apex) {}

  std::shared_ptr<ConvexFan> below(int t) const {
    TriangleMesh piece;
    for (int k = 0; k < 3; ++k) piece.vertices.push_back(vertices_[view_.triangles[t][k]]);
    const Eigen::Vector3d middle = (piece.vertices[0] + piece.vertices[1] + piece.vertices[2]) / 3;
    piece.vertices.push_back(middle);
    piece.triangles = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
    const Eigen::Vector3d first = piece.vertices[1] - piece.vertices[0];
    const Eigen::Vector3d across = first.cross(piece.vertices[2] - piece.vertices[0]);
    const double size = std::sqrt(0.5 * across.norm());
    if (!(size > 0.0)) return nullptr;
    for (const Eigen::Vector3d& inwards :
         {Eigen::Vector3d(apex_ - middle), Eigen::Vector3d(-size * across.normalized())}) {
      for (const double depth : kDepths) {
        piece.vertices[3] = middle + depth * inwards;
        if (auto fan = within(piece)) return fan;
      }
    }
    return nullptr;
  }

 private:
  std::shared_ptr<ConvexFan> within(const TriangleMesh& piece) const {
    const auto known = convexFanOf(viewOf(piece), piece.vertices, Eigen::Vector3d::Zero());
    if (!known) return nullptr;
    auto fan = std::make_shared<ConvexFan>(*known);
    return mesh_.surrounds(*fan, {}) ? fan : nullptr;
  }

  const MeshView& view_;
  const std::vector<Eigen::Vector3d>& vertices_;
  const SurroundingMesh& mesh_;
  Eigen::Vector3d apex_;
};

}  // namespace

std::vector<ConvexFan> shellPieces(const MeshView& view,
                                   const std::vector<Eigen::Vector3d>& vertices,
                                   const SurroundingMesh& mesh, const TriangleMesh& core,
                                   const Eigen::Vector3d& apex) {
  std::set<std::array<double, 3>> held;
  for (const fcl::Triangle& t : core.triangles) {
    for (int k = 0; k < 3; ++k) held.insert(key(core.vertices[t[k]]));
  }
  const PieceMaker maker(view, vertices, mesh, apex);
  std::vector<ConvexFan> pieces;
  for (int t = 0; t < view.triangle_count; ++t) {
    bool is_held = true;
    for (int k = 0; k < 3; ++k) {
      is_held = is_held && held.count(key(vertices[view.triangles[t][k]])) > 0;
    }
    if (is_held) continue;
    const auto piece = maker.below(t);
    if (!piece || pieces.size() == kMostPieces) return {};
    pieces.push_back(*piece);
  }
  return pieces;
}

}  // namespace fcl_prob::detail
