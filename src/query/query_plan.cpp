// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/query_plan.h"

#include "base/wings.h"
#include "exact/boundary_mass.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/geometry_kind.h"
#include "geometry/mesh_visitor.h"

namespace fcl_prob::detail {
namespace {

/// The exact mass of two convex meshes of so many triangles together takes 0.1 to 2 milliseconds,
/// and an estimate of it has nothing to say.
constexpr int kFewTriangles = 200;

struct QueryPair {
  const PreparedGeometry& a;
  const PreparedGeometry& b;

  bool inFcl() const { return fclSupportsPair(a.geometry(), b.geometry()); }
  bool haveRootBodies() const { return a.hasRootBody() && b.hasRootBody(); }
  bool areConvex() const { return a.isConvex() && b.isConvex(); }
  bool anyMesh() const { return isMesh(a) || isMesh(b); }

  /// A Halfspace or Plane is one of them.
  bool anyUnbounded() const { return !a.hasPieces() || !b.hasPieces(); }

  /// Of two convex shapes.
  BoundaryKind kind() const {
    if constexpr (kHasExact) return boundaryKind(a.rootBody(), b.rootBody());
    return BoundaryKind::other;
  }

  /// Convex shapes whose C-obstacle has an exact mass under a displacement.
  bool haveExactMass(const GaussianDisplacement& displacement) const {
    return kHasExact && areConvex() && (displacement.rank() < 3 || kind() != BoundaryKind::other);
  }

  bool areFlatOrMeshes() const {
    return (isMesh(a) || isPolytope(typeOf(a))) && (isMesh(b) || isPolytope(typeOf(b)));
  }

  int triangleCount() const { return triangleCount(a) + triangleCount(b); }

  std::string name() const { return nodeTypeName(typeOf(a)) + " and " + nodeTypeName(typeOf(b)); }

 private:
  static fcl::NODE_TYPE typeOf(const PreparedGeometry& geometry) {
    return geometry.geometry().getNodeType();
  }
  static bool isPolytope(fcl::NODE_TYPE type) {
    return type == fcl::GEOM_BOX || type == fcl::GEOM_CONVEX || type == fcl::GEOM_TRIANGLE;
  }
  static bool isMesh(const PreparedGeometry& geometry) {
    return kindOf(geometry.geometry()) == GeometryKind::mesh;
  }
  static int triangleCount(const PreparedGeometry& geometry) {
    return isMesh(geometry) ? meshView(geometry.geometry()).triangle_count : 0;
  }
};

[[noreturn]] void refuse(ProbabilityMethod method, const QueryPair& pair, const std::string& why) {
  throw UnsupportedGeometry("method " + toString(method) + " cannot handle the pair " +
                            pair.name() + ": " + why);
}

constexpr const char* kSurfacesOnly =
    "meshes are surfaces, as in fcl::collide: containment left out";

QueryPlan planWithoutMotion(const QueryPair& pair, const ProbabilityRequest& request) {
  const std::string reason = "the covariance is 0: nothing is random";
  if (pair.anyUnbounded()) return {Route::unbounded_pair, {reason}};
  if (pair.inFcl()) {
    QueryPlan plan{Route::single_collide, {reason + ", one fcl::collide"}};
    if (request.gradient) plan.notes.push_back("no gradient: P jumps where A touches B");
    return plan;
  }
  return {Route::partition, {reason + "; fcl::collide left out, as it refuses " + pair.name()}};
}

// Roots and shapes as they are say nothing of those within a band.
QueryPlan planBanded(const QueryPair& pair, const ProbabilityRequest& request) {
  if (!pair.anyUnbounded()) {
    QueryPlan plan{Route::partition};
    if (request.contact == ContactMeaning::fcl && pair.anyMesh()) {
      plan.notes.push_back(kSurfacesOnly);
    }
    return plan;
  }
  return {Route::unbounded_pair, {"a half-space or plane: closed form, bands included"}};
}

const char* whyNoRootBound(const QueryPair& pair, const ProbabilityRequest& request) {
  if (request.method == ProbabilityMethod::estimate) return "";  // asked for by name
  if (request.gradient) return "a bound from above has no gradient";
  return pair.haveRootBodies() ? nullptr : "one of them is not bounded by a volume";
}

QueryPlan planUnbounded() {
  return {Route::unbounded_pair,
          {"a half-space or plane: only the displacement along its normal matters, closed form"}};
}

QueryPlan planPartition(const QueryPair& pair, const GaussianDisplacement& displacement,
                        const ProbabilityRequest& request) {
  if (pair.anyUnbounded()) return planUnbounded();
  QueryPlan plan{Route::partition};
  plan.why_no_root_bound = whyNoRootBound(pair, request);
  plan.exact_if_unresolved = pair.haveExactMass(displacement);
  plan.convex_meshes_if_unresolved =
      kHasExact && pair.anyMesh() && pair.areFlatOrMeshes() && !request.gradient;
  if (plan.convex_meshes_if_unresolved && request.method != ProbabilityMethod::interval) {
    plan.why_no_convex_meshes =
        pair.triangleCount() <= kFewTriangles ? nullptr : "cells are quicker of so many triangles";
  }
  if (displacement.isotropic()) {
    plan.notes.push_back("isotropic covariance: whitening is a scaling");
  }
  if (request.contact == ContactMeaning::fcl && pair.anyMesh()) {
    plan.notes.push_back(kSurfacesOnly);
  }
  return plan;
}

std::string noteOnExactMass(BoundaryKind kind, int rank) {
  if (kind == BoundaryKind::ball)
    return "two spheres: their C-obstacle is a ball, mass by quadrature";
  if (kind == BoundaryKind::flat || (rank == 3 && kind == BoundaryKind::other)) {
    return "both shapes are convex: exact mass of their C-obstacle, no tree";
  }
  if (rank == 2) return "curved shapes: mass of their C-obstacle's section between two polygons";
  if (rank < 2) return "curved shapes: where a line meets their C-obstacle";
  return kind == BoundaryKind::rounded
             ? "round and flat shapes: their C-obstacle is a polytope swept by a ball, mass by "
               "quadrature"
             : "curved shapes: mass of their C-obstacle by quadrature over its boundary";
}

QueryPlan planExact(const QueryPair& pair, const GaussianDisplacement& displacement,
                    const ProbabilityRequest& request) {
  if (!kHasExact) refuseWithout(toString(request.method), "EXACT");
  if (pair.anyUnbounded()) return planUnbounded();
  if (!pair.areConvex()) refuse(request.method, pair, "it needs two convex shapes");
  QueryPlan plan{Route::exact_mass};
  plan.notes.push_back(noteOnExactMass(pair.kind(), displacement.rank()));
  if (displacement.isotropic()) {
    plan.notes.push_back("isotropic covariance: whitening is a scaling");
  }
  return plan;
}

QueryPlan planAutomatic(const QueryPair& pair, const GaussianDisplacement& displacement,
                        const ProbabilityRequest& request) {
  const bool exact = pair.haveExactMass(displacement);
  const bool has_gradient = displacement.rank() == 3;
  if (exact && (has_gradient || !request.gradient)) {
    QueryPlan plan = planExact(pair, displacement, request);
    const BoundaryKind kind = pair.kind();
    const bool is_closed_form = kind == BoundaryKind::flat || kind == BoundaryKind::ball;
    plan.partition_if_unresolved = request.gradient || !is_closed_form;
    // Quadrature over a boundary takes milliseconds, a bound microseconds.
    const bool is_quadrature =
        !is_closed_form && kind != BoundaryKind::rounded && displacement.rank() > 1;
    if (is_quadrature) plan.why_no_root_bound = nullptr;
    return plan;
  }
  QueryPlan plan = planPartition(pair, displacement, request);
  if (exact) {
    plan.notes.push_back(
        "a gradient is asked for: the partition instead of the exact mass, which has none here");
  }
  return plan;
}

QueryPlan planConvexBound(const QueryPair& pair, const ProbabilityRequest& request) {
  if (!pair.haveRootBodies())
    refuse(request.method, pair, "one of them is not bounded by a volume");
  QueryPlan plan{Route::convex_bound};
  if (pair.anyMesh()) {
    plan.notes.push_back("the bound is that of the root volumes of the meshes");
  }
  return plan;
}

QueryPlan planGeneralPcd(const QueryPair& pair, const ProbabilityRequest& request) {
  if (!kHasPaper) refuseWithout(toString(request.method), "PAPER");
  if (request.contact == ContactMeaning::solid && pair.anyMesh()) {
    refuse(request.method, pair, "it bounds contact of surfaces, not of solids");
  }
  return {Route::general_pcd};
}

QueryPlan planSampling(Route route, const ProbabilityRequest& request) {
  if (!kHasSampling) refuseWithout(toString(request.method), "SAMPLING");
  return {route};
}

}  // namespace

QueryPlan planQuery(const PreparedGeometry& a, const PreparedGeometry& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  const QueryPair pair{a, b};
  if (request.hasBand()) return planBanded(pair, request);
  if (displacement.rank() == 0) return planWithoutMotion(pair, request);
  switch (request.method) {
    case ProbabilityMethod::automatic:
      return planAutomatic(pair, displacement, request);
    case ProbabilityMethod::interval:
    case ProbabilityMethod::estimate:
      return planPartition(pair, displacement, request);
    case ProbabilityMethod::convex_pcd:
      return planConvexBound(pair, request);
    case ProbabilityMethod::general_pcd:
    case ProbabilityMethod::general_pcd_min:
      return planGeneralPcd(pair, request);
    case ProbabilityMethod::monte_carlo:
      return planSampling(Route::monte_carlo, request);
    case ProbabilityMethod::rare_event:
      return planSampling(Route::rare_event, request);
    case ProbabilityMethod::exact:
      return planExact(pair, displacement, request);
  }
  throw InvalidRequest("not one of ProbabilityMethod");
}

}  // namespace fcl_prob::detail
