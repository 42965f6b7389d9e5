// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is settled of cells for good: mass that collides, mass that does not, and what may be wrong.
#pragma once

#include "cells/carved_cell.h"
#include "cells/claim_observer.h"
#include "fcl_prob/probability_request.h"
#include "scene/containment.h"

namespace fcl_prob::detail {

/// Adds what is known of cells to a Carving, and tells the observer what is claimed.
class CellSettler {
 public:
  /// How much may be wrong in one of the tetrahedra of a cell, as a share of what it was cut from.
  static constexpr double kOpenFloor = 0.01;

  /// Keeps a reference to `solids`, which is null where containment does not count.
  CellSettler(const SolidContact* solids, const ProbabilityRequest& request);

  /// Adds to `into` from now on. \param certain  mass that is settled besides what is in it
  void begin(double certain, Carving& into);

  bool hasSolids() const { return solids_ != nullptr; }

  /// Relative, of the mass of what is settled.
  double accuracy() const { return accuracy_; }

  /// All of a cell collides.
  void settleCovered(const char* method, const CarvedCell& cell);

  /// All of a polytope within a cell collides.
  void settleInside(const CellPolytope& inside);

  /// No surfaces meet anywhere in the cell but in its layers and near its surface.
  void settleFree(const CarvedCell& cell);

  /// Nothing is said of so much mass.
  void leaveUnknown(double mass) { carving_->settled.upper += mass; }

  /// For what lies behind the inner plane of an obstacle, of a cell outside of it, and in front of
  /// the outer one. \return no less than its mass
  double allowLayer(const CarvedCell& outside, const ObstaclePlane& plane);

  /// For what so many cuts may lose between two cells, or count twice.
  void allowSlivers(const CellPolytope& body, std::size_t cuts);

  /// Of a cell cut from another one, of mass `parent`.
  static Bounds openMass(const CellPolytope& body, double parent);

 private:
  void settle(const Bounds& mass);
  void settleContained(const CarvedCell& cell, double rim_mass);
  void claim(const char* method, bool collides, const CellPolytope& body,
             const CarvedLayer* layers = nullptr, double rim = 0.0) const;
  Bounds settledMass(const CellPolytope& body) const;

  ClaimObserver* const observer_ = claim_observer;
  const SolidContact* solids_;
  double accuracy_;
  double certain_ = 0.0;
  Carving* carving_ = nullptr;
  PolytopeCutter cutter_;
  CellPolytope layer_;
};

}  // namespace fcl_prob::detail
