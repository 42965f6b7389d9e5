// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/query_plan.h"

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {
namespace {

struct QueryPair {
  const PreparedGeometry& a;
  const PreparedGeometry& b;

  bool inFcl() const { return fclSupportsPair(a.geometry(), b.geometry()); }
  bool havePieces() const { return a.hasPieces() && b.hasPieces(); }
  bool haveRootBodies() const { return a.hasRootBody() && b.hasRootBody(); }
  bool areConvex() const { return a.isConvex() && b.isConvex(); }
  bool anyMesh() const { return isMesh(a) || isMesh(b); }

  std::string name() const {
    return nodeTypeName(a.geometry().getNodeType()) + " and " +
           nodeTypeName(b.geometry().getNodeType());
  }

 private:
  static bool isMesh(const PreparedGeometry& geometry) {
    return kindOf(geometry.geometry()) == GeometryKind::mesh;
  }
};

[[noreturn]] void refuse(ProbabilityMethod method, const QueryPair& pair, const std::string& why) {
  throw UnsupportedGeometry("method " + toString(method) + " cannot handle the pair " +
                            pair.name() + ": " + why);
}

QueryPlan planWithoutMotion(const QueryPair& pair) {
  const std::string reason = "the covariance is 0: nothing is random";
  if (pair.inFcl()) return {Route::single_collide, false, {reason + ", one fcl::collide"}};
  if (pair.havePieces()) {
    return {Route::partition,
            false,
            {reason + "; fcl::collide left out, as it refuses " + pair.name()}};
  }
  throw UnsupportedGeometry("nothing can collide the pair " + pair.name());
}

QueryPlan planPartition(const QueryPair& pair, const GaussianDisplacement& displacement,
                        const ProbabilityRequest& request) {
  if (!pair.havePieces()) refuse(request.method, pair, "it partitions meshes and convex polytopes");
  QueryPlan plan{Route::partition, false, {}};
  // A bound from above has no gradient, and an estimate was asked for by name.
  plan.try_root_bound = !request.gradient && request.method != ProbabilityMethod::estimate;
  if (displacement.isotropic()) {
    plan.notes.push_back("isotropic covariance: whitening is a scaling");
  }
  if (request.contact == ContactMeaning::fcl && pair.anyMesh()) {
    plan.notes.push_back("meshes are surfaces, as in fcl::collide: containment left out");
  }
  return plan;
}

QueryPlan planExact(const QueryPair& pair, const GaussianDisplacement& displacement,
                    const ProbabilityRequest& request) {
  if (!pair.areConvex()) refuse(request.method, pair, "it needs two bounded convex shapes");
  QueryPlan plan{Route::exact_mass, false, {}};
  plan.notes.push_back("both shapes are convex: exact mass of their C-obstacle, no tree");
  if (displacement.isotropic()) {
    plan.notes.push_back("isotropic covariance: whitening is a scaling");
  }
  if (request.gradient) plan.notes.push_back("no gradient: the interval method has one");
  return plan;
}

QueryPlan planAutomatic(const QueryPair& pair, const GaussianDisplacement& displacement,
                        const ProbabilityRequest& request) {
  const bool gradient_by_partition = request.gradient && pair.havePieces();
  if (pair.areConvex() && !gradient_by_partition) return planExact(pair, displacement, request);
  if (pair.havePieces()) return planPartition(pair, displacement, request);
  if (!pair.inFcl()) refuse(request.method, pair, "neither the partition nor fcl::collide does");
  return {Route::monte_carlo, false, {"partition left out: it has no pieces of " + pair.name()}};
}

QueryPlan planConvexBound(const QueryPair& pair, const ProbabilityRequest& request) {
  if (!pair.haveRootBodies())
    refuse(request.method, pair, "one of them is not bounded by a volume");
  QueryPlan plan{Route::convex_bound, false, {}};
  if (pair.anyMesh()) {
    plan.notes.push_back("the bound is that of the root volumes of the meshes");
  }
  return plan;
}

QueryPlan planGeneralPcd(const QueryPair& pair, const ProbabilityRequest& request) {
  if (request.contact == ContactMeaning::solid && pair.anyMesh()) {
    refuse(request.method, pair, "it bounds contact of surfaces, not of solids");
  }
  return {Route::general_pcd, false, {}};
}

}  // namespace

QueryPlan planQuery(const PreparedGeometry& a, const PreparedGeometry& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  const QueryPair pair{a, b};
  if (displacement.rank() == 0) return planWithoutMotion(pair);
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
      return {Route::monte_carlo, false, {}};
    case ProbabilityMethod::rare_event:
      return {Route::rare_event, false, {}};
    case ProbabilityMethod::exact:
      return planExact(pair, displacement, request);
  }
  throw InvalidRequest("not one of ProbabilityMethod");
}

}  // namespace fcl_prob::detail
