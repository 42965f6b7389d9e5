// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/cell_settler.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"

namespace fcl_prob::detail {
namespace {

// Accuracy of the masses of cells that stay open, and of those settled: that as a share of the
// tolerance.
constexpr double kOpenMassAccuracy = 0.03;
constexpr double kSettledShareOfCarving = 0.01;
constexpr double kDecisionAccuracy = 1e-4;
constexpr double kBestAccuracy = 1e-6;
constexpr double kWorstAccuracy = 1e-3;

// How much may be wrong in one of the tetrahedra of a cell, as a share of all that is settled.
constexpr double kSettledFloor = 1e-4;

// A layer of a smaller share than this of the accuracy is not looked at closely.
constexpr double kLittleShare = 0.1;
constexpr double kLayerAccuracy = 0.3;

// Not less than the largest density in a body over the least.
double unevennessOf(const CellPolytope& body) {
  const double far = body.nearest() + body.diameter();
  return std::exp(0.5 * (far * far - body.nearest() * body.nearest()));
}

// Bound on the mass of what is within the rim of a cell, of which a ball is known. What is deeper
// holds the cell shrunk about the ball's middle by the share rim / radius.
double rimMass(const CarvedCell& cell, double radius) {
  if (cell.rim == 0.0) return 0.0;
  if (!(cell.rim < radius)) return cell.mass.upper;
  return std::min(1.0, 3 * cell.rim / radius * unevennessOf(cell.body)) * cell.mass.upper;
}

double settledAccuracy(const ProbabilityRequest& request) {
  if (request.threshold) return kDecisionAccuracy;
  return std::clamp(kSettledShareOfCarving * request.relative_tolerance, kBestAccuracy,
                    kWorstAccuracy);
}

bool isBeyond(const CarvedLayer* layers, const Eigen::Vector3d& point) {
  for (; layers; layers = layers->before.get()) {
    if (!(layers->n.dot(point) > layers->outer + CellPolytope::kCutLayer)) return false;
  }
  return true;
}

}  // namespace

CellSettler::CellSettler(const SolidContact* solids, const ProbabilityRequest& request)
    : solids_(solids), accuracy_(settledAccuracy(request)) {}

void CellSettler::begin(double certain, Carving& into) {
  certain_ = certain;
  carving_ = &into;
}

void CellSettler::settleCovered(const char* method, const CarvedCell& cell) {
  claim(method, true, cell.body);
  settle(cell.box ? cell.mass : settledMass(cell.body));
}

void CellSettler::settleInside(const CellPolytope& inside) {
  claim("planes of a fat pair", true, inside);
  settle(settledMass(inside));
}

void CellSettler::settle(const Bounds& mass) {
  carving_->settled.lower += mass.lower;
  carving_->settled.upper += mass.upper;
}

// Of a few points, as cells of next to no size: near the vertices the claim is boldest. A body that
// is hardly thicker than those cells is left out, by what its faces tell to 1e-8.
void CellSettler::claim(const char* method, bool collides, const CellPolytope& body,
                        const CarvedLayer* layers, double rim) const {
  if (!observer_) return;
  constexpr double kNearVertex = 0.99;
  constexpr double kHalf = 1e-11;
  const Eigen::Vector3d middle = body.middle();
  if (!((1.0 - kNearVertex) * body.depth(middle) > 1e3 * kHalf + rim)) return;
  for (const Eigen::Vector3d& v : body.vertices()) {
    const Eigen::Vector3d point = middle + kNearVertex * (v - middle);
    if (!isBeyond(layers, point)) continue;
    observer_->claim({method, collides, {point.array() - kHalf, point.array() + kHalf, 3}, {}});
  }
}

// No surfaces meet anywhere in the cell but in its layers and near its surface. What is beyond all
// of them is convex: one point of it tells whether the solids overlap.
void CellSettler::settleFree(const CarvedCell& cell) {
  if (!solids_ || !solids_->possible(cell.body.box())) {
    return claim("no fat pair", false, cell.body, nullptr, cell.rim);
  }
  const auto [middle, radius] =
      cell.rim > 0.0 ? cell.body.ballWithin() : CellPolytope::Ball{cell.body.middle(), kInfinity};
  const double rim_mass = rimMass(cell, radius);
  const bool tells = cell.rim < radius && isBeyond(cell.layers.get(), middle);
  switch (tells ? solids_->at(middle) : Containment::unknown) {
    case Containment::inside:
      return settleContained(cell, rim_mass);
    case Containment::outside:
      carving_->settled.upper += rim_mass;
      return claim("no containment", false, cell.body, nullptr, cell.rim);
    case Containment::unknown:
      carving_->settled.upper += cell.mass.upper;
  }
}

// Nothing is said of its layers and its rim.
void CellSettler::settleContained(const CarvedCell& cell, double rim_mass) {
  claim("containment", true, cell.body, cell.layers.get(), cell.rim);
  Bounds mass = cell.box ? cell.mass : settledMass(cell.body);
  mass.lower -= rim_mass;
  for (const CarvedLayer* layer = cell.layers.get(); layer; layer = layer->before.get()) {
    mass.lower -= layer->mass;
  }
  settle({std::max(0.0, mass.lower), mass.upper});
}

// What lies behind the inner plane and in front of the outer one may belong to the obstacle. Of the
// volume of a convex body that reaches a height T above a plane no larger share lies below a height
// m than of that of a cone, 3 m / T. Where that is not little, the layer's own mass is taken.
double CellSettler::allowLayer(const CarvedCell& outside, const ObstaclePlane& plane) {
  const CellPolytope& body = outside.body;
  if (observer_) observer_->excuse(body.box(), plane.n, plane.inner(), plane.outer);
  const double height = body.along(plane.n).hi - plane.inner();
  const double share = height > 0.0 ? 3 * plane.margin / height * unevennessOf(body) : 1.0;
  double mass = share * outside.mass.upper;
  if (share > kLittleShare * accuracy_) {
    cutter_.cut(body, plane.n, plane.outer, &layer_, nullptr);
    mass = layer_.mass({kLayerAccuracy, 0.0}).upper;
  }
  carving_->settled.upper += mass;
  return mass;
}

Bounds CellSettler::settledMass(const CellPolytope& body) const {
  return body.mass({accuracy_, kSettledFloor * accuracy_ * (certain_ + carving_->settled.lower)});
}

// Of a cell cut from another one, of mass `parent`.
Bounds CellSettler::openMass(const CellPolytope& body, double parent) {
  return body.mass({kOpenMassAccuracy, kOpenFloor * kOpenMassAccuracy * parent});
}

void CellSettler::allowSlivers(const CellPolytope& body, std::size_t cuts) {
  const double size = body.diameter();
  const double nearest = body.nearest();
  carving_->slivers += static_cast<double>(cuts) * CellPolytope::kCutLayer * 4 * size * size *
                       0.07 * std::exp(-0.5 * nearest * nearest);
}

}  // namespace fcl_prob::detail
