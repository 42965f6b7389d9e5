// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/prepared_geometry.h"

#include <limits>

#include "convex/convex_set.h"
#include "convex/support_shape.h"
#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {
namespace {

/// Every face of a hull is held against every point: with more of them its root volume has to do.
constexpr int kLargestHull = 10'000;

Eigen::AlignedBox3d boxOfMesh(const MeshView& mesh) {
  Eigen::AlignedBox3d box;
  for (int i = 0; i < mesh.vertex_count; ++i) box.extend(mesh.vertices[i]);
  return box;
}

Eigen::AlignedBox3d boxOfShape(const SupportShape& shape) {
  Eigen::Vector3d lowest, highest;
  for (int k = 0; k < 3; ++k) {
    lowest[k] = -shape.supportValue(-Eigen::Vector3d::Unit(k));
    highest[k] = shape.supportValue(Eigen::Vector3d::Unit(k));
  }
  return {lowest, highest};
}

Eigen::AlignedBox3d boxOfPieces(const PieceTree& tree) {
  if (tree.isEmpty()) return {};
  const PieceTree::Part& whole = tree.parts[0];
  return {whole.origin.array() - whole.radius, whole.origin.array() + whole.radius};
}

}  // namespace

PreparedGeometry::PreparedGeometry(std::shared_ptr<const fcl::CollisionGeometryd> geometry,
                                   std::string name)
    : geometry_(std::move(geometry)), name_(std::move(name)) {
  validateGeometry(geometry_.get(), name_);
}

bool PreparedGeometry::hasPieces() const { return kindOf(*geometry_) != GeometryKind::unbounded; }

const PieceTree& PreparedGeometry::pieces() const {
  std::call_once(pieces_once_, [this] { pieces_ = buildPieceTree(*geometry_); });
  return *pieces_;
}

bool PreparedGeometry::isConvex() const { return kindOf(*geometry_) == GeometryKind::convex; }

bool PreparedGeometry::hasRootBody() const {
  return isConvex() || kindOf(*geometry_) == GeometryKind::mesh;
}

const ConvexBody& PreparedGeometry::rootBody() const {
  std::call_once(root_once_, [this] {
    root_body_ = isConvex() ? std::make_unique<const ConvexBody>(*geometry_)
                            : visitMesh(*geometry_, [](const auto& model) {
                                return std::make_unique<const ConvexBody>(model.getBV(0).bv);
                              });
  });
  return *root_body_;
}

const ConvexBody& PreparedGeometry::hull() const {
  if (isConvex()) return rootBody();
  const MeshView mesh = meshView(*geometry_);
  if (mesh.vertex_count > kLargestHull) return rootBody();
  std::call_once(hull_once_, [&] {
    hull_ = std::make_unique<const ConvexBody>(
        std::vector<Eigen::Vector3d>(mesh.vertices, mesh.vertices + mesh.vertex_count));
  });
  return *hull_;
}

const ConvexSolid* PreparedGeometry::convexSolid() const {
  std::call_once(convex_solid_once_, [this] {
    if (kindOf(*geometry_) == GeometryKind::mesh) {
      convex_solid_ = convexSolidOf(meshView(*geometry_), name_);
    } else if (isConvex() && rootBody().isPolytope() &&
               rootBody().set().outerMesh().faces.size() >= 4) {
      convex_solid_ = std::make_unique<const ConvexSolid>(ConvexSolid{rootBody(), 0.0});
    }
  });
  return convex_solid_.get();
}

const Eigen::AlignedBox3d& PreparedGeometry::localBox() const {
  std::call_once(local_box_once_, [this] { local_box_ = findLocalBox(); });
  return local_box_;
}

Eigen::AlignedBox3d PreparedGeometry::findLocalBox() const {
  switch (kindOf(*geometry_)) {
    case GeometryKind::mesh:
      return boxOfMesh(meshView(*geometry_));
    case GeometryKind::convex:
      return boxOfShape(supportShape(*geometry_));
    case GeometryKind::octree:
      return boxOfPieces(pieces());
    default: {
      const auto everywhere = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
      return {-everywhere, everywhere};
    }
  }
}

const ClosedMesh* PreparedGeometry::solid(ContactMeaning contact) const {
  if (contact == ContactMeaning::fcl || kindOf(*geometry_) != GeometryKind::mesh) return nullptr;
  std::call_once(solid_once_, [this] {
    solid_ = std::make_unique<const ClosedMesh>(meshView(*geometry_), name_);
  });
  return solid_.get();
}

}  // namespace fcl_prob::detail
