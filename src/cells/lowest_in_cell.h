// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// How low C-obstacles reach within a cell, along a direction.
#pragma once

#include <vector>

#include "cells/open_cell.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/probability_result.h"
#include "scene/node_layers.h"
#include "scene/node_support.h"
#include "scene/obstacle_table.h"

namespace fcl_prob::detail {

/// Around the C-obstacle of a pair; everywhere for a layer.
NodeBox obstacleBoxOf(const WhitenedPair& pair, const FrontPair& of);

bool meets(const CellBox& cell, const NodeLayer& layer);

/// By how much a band moves a plane with the normal m outwards, of two nodes.
double outwardOfBand(const WhitenedPair& pair, const Eigen::Vector3d& m, NodePair nodes);

/// Lower bounds of m·y over what C-obstacles have of one cell, which may be another one at each
/// call.
class LowestInCell {
 public:
  /// Keeps references to all arguments. \param box  that of the cell
  LowestInCell(const WhitenedPair& pair, ObstacleTable& obstacles, const Cell& cell,
               const CellBox& box, NodeLayers& layers, ProbabilityStatistics& statistics);

  /// From the box around the pair's C-obstacle.
  double ofBox(const FrontPair& pair, const Eigen::Vector3d& m) const {
    return ofBox(obstacleBoxOf(pair_, pair), m);
  }

  /// From the slabs of a pair of leaves.
  double ofSlabs(const FrontPair& pair, const Eigen::Vector3d& m) const;

  /// From a support function, in the cell or not.
  double ofSupport(const SupportObstacle& obstacle, NodePair nodes, const Eigen::Vector3d& m) const;

  /// From the vertices of two nodes of meshes, in the cell or not. Calls with the same m share
  /// their work until another m is used.
  double ofVertices(NodePair nodes, const Eigen::Vector3d& m);

  /// Over all pairs of a front, or the level, if that is lower; looked at until it is below
  /// `least`.
  double ofFront(const std::vector<FrontPair>& front, const CellPlane& level, double least);

  /// What reaches below a level, in pairs as large as they came or smaller.
  struct PartsBelow {
    std::vector<FrontPair> pairs;
    double lowest;            ///< of them, or a bound that is at least as low
    double lowest_of_others;  ///< of those that do not reach below the level
  };

  /// How low pairs of nodes reach. The lowest one is opened until that is known, no pair reaches
  /// below `known`, or `budget` nodes were opened: what lies higher stays as it is.
  void findBelow(const std::vector<FrontPair>& pairs, const CellPlane& level, double known,
                 int budget, PartsBelow& below);

 private:
  /// An entry of the heap.
  struct Reaching {
    double lowest;
    NodePair nodes;
  };

  double ofBox(const NodeBox& box, const Eigen::Vector3d& m) const;
  double ofLayer(const NodeLayer& layer, const NodeBox& box, const Eigen::Vector3d& m) const;
  double ofParts(NodePair nodes, const NodeBox& box, const CellPlane& level);
  void addBelow(NodePair nodes, const CellPlane& level, PartsBelow& below);

  const WhitenedPair& pair_;
  ObstacleTable& obstacles_;
  const Cell& cell_;
  const CellBox& box_;
  NodeLayers& layers_;
  ProbabilityStatistics& statistics_;
  const SlabKernels& kernels_;
  NodeSupport support_a_;  ///< along m
  NodeSupport support_b_;  ///< along -m
  std::vector<Reaching> heap_;
  TriangleSlabsData once_;
};

}  // namespace fcl_prob::detail
