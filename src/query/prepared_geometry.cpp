// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/prepared_geometry.h"

#include "geometry/mesh_visitor.h"
#include "geometry/validation.h"

namespace fcl_prob::detail {

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

const ClosedMesh* PreparedGeometry::solid(ContactMeaning contact) const {
  if (contact == ContactMeaning::fcl || kindOf(*geometry_) != GeometryKind::mesh) return nullptr;
  std::call_once(solid_once_, [this] {
    solid_ = std::make_unique<const ClosedMesh>(meshView(*geometry_), name_);
  });
  return solid_.get();
}

}  // namespace fcl_prob::detail
