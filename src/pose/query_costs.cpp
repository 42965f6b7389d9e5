// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/query_costs.h"

#include "geometry/convex_vertices.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

constexpr double kTwoMeshes = 20.0;
constexpr double kMeshAndShape = 8.0;
constexpr double kTwoShapes = 1.5;

constexpr double kQuery = 40.0;
constexpr double kMeshVertex = 0.1;
constexpr double kPolytopeVertex = 0.5;

bool isConvex(const fcl::CollisionGeometryd& geometry) {
  return kindOf(geometry) == GeometryKind::convex;
}

double sizeCost(const GeometryList& members) {
  double sum = 0.0;
  for (const auto& member : members) {
    if (kindOf(*member) == GeometryKind::mesh) {
      sum += kMeshVertex * static_cast<double>(meshView(*member).vertex_count);
    } else if (const auto vertices = polytopeVertices(*member)) {
      sum += kPolytopeVertex * static_cast<double>(vertices->size());
    }
  }
  return sum;
}

}  // namespace

double collideCost(const GeometryList& a, const GeometryList& b) {
  double sum = 0.0;
  for (const auto& of_a : a) {
    for (const auto& of_b : b) {
      const bool convex_a = isConvex(*of_a);
      const bool convex_b = isConvex(*of_b);
      sum += convex_a && convex_b ? kTwoShapes : convex_a || convex_b ? kMeshAndShape : kTwoMeshes;
    }
  }
  return sum;
}

double leastQueryCost(const GeometryList& a, const GeometryList& b) {
  return kQuery + sizeCost(a) + sizeCost(b);
}

}  // namespace fcl_prob::detail
