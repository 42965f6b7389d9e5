// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Points of a cell within some planes: corners, edges, faces and others.
#pragma once

#include <optional>
#include <random>

#include "cells/covered_part.h"

namespace oracle {

using Random = std::mt19937_64;

class ClaimRegion {
 public:
  /// \param rank  axes that move; the other coordinates of points are 0
  ClaimRegion(const fcl_prob::detail::Cell& cell, const fcl_prob::detail::CoveredPart& within,
              int rank);

  /// Certainly inside: not on a side of the cell or on a plane, in exact arithmetic.
  bool contains(const Eigen::Vector3d& y) const;

  /// A point where about `hits` of the sides and planes meet, moved inside by as little as doubles
  /// allow, or by a random little; nothing if no point inside is found.
  std::optional<Eigen::Vector3d> point(int hits, Random& random) const;

 private:
  struct Hit {
    double length;
    Eigen::Vector3d normal;
  };

  std::optional<Eigen::Vector3d> start(Random& random) const;
  Hit boundary(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;
  Eigen::Vector3d randomDirection(Random& random) const;
  Eigen::Vector3d randomPoint(const Eigen::Vector3d& from, Random& random) const;

  fcl_prob::detail::Cell cell_;
  fcl_prob::detail::CoveredPart within_;
  int rank_;
};

}  // namespace oracle
