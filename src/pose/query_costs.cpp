// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/query_costs.h"

#include <algorithm>

#include "geometry/convex_vertices.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

constexpr double kTwoMeshes = 20.0;
constexpr double kMeshAndShape = 8.0;
constexpr double kTwoShapes = 1.5;

// Of the pairs of two groups few are near each other.
constexpr double kApart = 0.5;

constexpr double kQuery = 40.0;

// Pairs of pieces and samples of an answer beside a mesh: some 500 samples and 3,000 pairs.
constexpr double kRoughAnswer = 1500.0;

constexpr double kMeshVertex = 0.1;
constexpr double kPolytopeVertex = 0.5;

bool isConvex(const fcl::CollisionGeometryd& geometry) {
  return kindOf(geometry) == GeometryKind::convex;
}

bool isMesh(const fcl::CollisionGeometryd& geometry) {
  return kindOf(geometry) == GeometryKind::mesh;
}

bool holdsMesh(const GeometryList& members) {
  return std::any_of(members.begin(), members.end(),
                     [](const auto& member) { return isMesh(*member); });
}

double sizeCost(const GeometryList& members) {
  double sum = 0.0;
  for (const auto& member : members) {
    if (isMesh(*member)) {
      sum += kMeshVertex * static_cast<double>(meshView(*member).vertex_count);
    } else if (const auto vertices = polytopeVertices(*member)) {
      sum += kPolytopeVertex * static_cast<double>(vertices->size());
    }
  }
  return sum;
}

}  // namespace

double collideCost(const GeometryList& a, const GeometryList& b) {
  double nearest = 0.0;
  for (const auto& of_a : a) {
    for (const auto& of_b : b) {
      const bool convex_a = isConvex(*of_a);
      const bool convex_b = isConvex(*of_b);
      nearest = std::max(nearest, convex_a && convex_b   ? kTwoShapes
                                  : convex_a || convex_b ? kMeshAndShape
                                                         : kTwoMeshes);
    }
  }
  return nearest + kApart * (static_cast<double>(a.size() * b.size()) - 1.0);
}

QueryCost queryCost(const GeometryList& a, const GeometryList& b) {
  const double rough = holdsMesh(a) || holdsMesh(b) ? kRoughAnswer : 0.0;
  return {kQuery + sizeCost(a) + sizeCost(b), rough};
}

}  // namespace fcl_prob::detail
