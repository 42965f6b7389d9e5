// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of a partition along the planes of the C-obstacles themselves, and what comes of it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cells/cell_polytope.h"
#include "cells/fat_members.h"

namespace fcl_prob::detail {

/// The obstacles that may meet a cell without covering it, each with those of its planes over which
/// the cell sticks out.
struct ObstacleList {
  struct Entry {
    FatObstacle obstacle;
    std::size_t first;  ///< of its planes
    std::size_t last;   ///< one behind the last
  };
  std::vector<Entry> entries;
  std::vector<int> planes;  ///< indices into FatObstacles::planesOf()
  std::size_t counted = 0;  ///< bytes, by whoever counts them

  std::size_t memory() const {
    return entries.capacity() * sizeof(Entry) + planes.capacity() * sizeof(int);
  }
};

/// In { n·y <= outer } a cell may meet obstacles that it is taken to be free of: their mass is in
/// the upper bound already.
struct CarvedLayer {
  Eigen::Vector3d n;
  double outer;
  double mass;                                ///< no less than its own
  std::shared_ptr<const CarvedLayer> before;  ///< of the cell that this one was cut from
};

/// A cell that is still open.
struct CarvedCell {
  CellPolytope body;
  Bounds mass;
  double inner = 0.0;  ///< certified mass of a part that collides

  /// Of the cell that it was cut from, or a box's nodes of the mesh's tree.
  std::shared_ptr<const ObstacleList> list;
  std::optional<Cell> box;
  std::shared_ptr<const std::vector<FatNode>> nodes;

  /// The cell lies behind this plane of an obstacle, if there is one.
  Eigen::Vector3d behind = Eigen::Vector3d::Zero();
  FatObstacle outside_of;

  std::shared_ptr<const CarvedLayer> layers;

  /// It may also meet such obstacles elsewhere, no farther than this from its surface.
  double rim = 0.0;

  double inner_error = 0.0;  ///< how much more that part may weigh

  double gap() const { return mass.upper - inner; }
};

/// What cells have come to: mass that is settled for good, and cells that are still open.
struct Carving {
  Bounds settled{0.0, 0.0};
  double slivers = 0.0;  ///< what may lie between cells or belong to two
  std::vector<std::unique_ptr<CarvedCell>> cells;
};

}  // namespace fcl_prob::detail
