// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "query/query_plan.h"

#include "fcl_prob/exceptions.h"
#include "fcl_prob/monte_carlo.h"
#include "geometry/geometry_kind.h"

namespace fcl_prob::detail {
namespace {

std::string pairName(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  return nodeTypeName(a.getNodeType()) + " and " + nodeTypeName(b.getNodeType());
}

QueryPlan planSingleCollide(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  QueryPlan plan{QueryPlan::Route::single_collide, {}};
  if (!fclSupportsPair(a, b)) {
    throw UnsupportedGeometry("the covariance is 0, and fcl::collide does not support the pair " +
                              pairName(a, b));
  }
  plan.notes.push_back("the covariance is 0: nothing is random, one fcl::collide at the mean");
  return plan;
}

QueryPlan planAutomatic(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b) {
  if (!fclSupportsPair(a, b)) {
    throw UnsupportedGeometry("no method can handle the pair " + pairName(a, b));
  }
  return {QueryPlan::Route::monte_carlo, {"auto: Monte Carlo"}};
}

}  // namespace

QueryPlan planQuery(const fcl::CollisionGeometryd& a, const fcl::CollisionGeometryd& b,
                    const GaussianDisplacement& displacement, const ProbabilityRequest& request) {
  if (displacement.rank() == 0) return planSingleCollide(a, b);
  switch (request.method) {
    case ProbabilityMethod::automatic:
      return planAutomatic(a, b);
    case ProbabilityMethod::monte_carlo:
      return {QueryPlan::Route::monte_carlo, {}};
    default:
      throw UnsupportedGeometry(toString(request.method) + " cannot handle the pair " +
                                pairName(a, b));
  }
}

}  // namespace fcl_prob::detail
