// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The pairs of pieces that may meet one cell, refined as far as the cell needs.
#pragma once

#include <vector>

#include "cells/lowest_in_cell.h"
#include "cells/open_cell.h"
#include "convex/cell_section.h"
#include "fcl_prob/probability_result.h"
#include "scene/node_layers.h"
#include "scene/obstacle_table.h"

namespace fcl_prob::detail {

/// A pair of leaves whose C-obstacle meets the cell without covering it.
struct CuttingPair {
  FrontPair pair;
  int sides;        ///< planes of the obstacle over which the cell sticks out
  double covered;   ///< no slice with a larger share of the cell's width is within the obstacle
  CellPlane inner;  ///< for sides == 1: {m·y >= s} of the cell is within the obstacle
  double outer;     ///< for sides == 1: the obstacle lies in {m·y >= outer}
  double depth;  ///< for sides == 1: signed distance of the plane from the cell's middle, -1 to 1
  bool layered = false;  ///< dividing the cell brings the planes closer to each other
};

/// A slice of a cell that certainly collides, and what covers it.
struct CoveredSlice {
  Cell cell;
  FrontPair by;
};

/// Works on one cell at a time: sorts its pairs, and cuts off the slices of it that a pair covers.
class CellFront {
 public:
  CellFront(const WhitenedPair& pair, ObstacleTable& obstacles, ProbabilityStatistics& statistics);
  CellFront(const CellFront&) = delete;
  CellFront& operator=(const CellFront&) = delete;

  /// Takes up a cell with the front inherited from its parent. Afterwards cell() is what remains of
  /// it, covered() the slices that certainly collide, cutting() and coarse() its own front.
  void take(const Cell& cell, const std::vector<FrontPair>& inherited);

  /// Opens pairs of nodes that are large beside the cell, as far as one of theirs may cover it.
  void open();

  const Cell& cell() const { return cell_; }
  const CellBox& box() const { return box_; }
  const std::vector<CoveredSlice>& covered() const { return covered_; }
  const std::vector<CuttingPair>& cutting() const { return cutting_; }

  /// Pairs with an inner node: too large to say anything of the cell but that they may meet it.
  const std::vector<FrontPair>& coarse() const { return coarse_; }

  /// Signed distance of a plane from the cell's middle: -1 covers all, 1 nothing.
  double depthOf(const CellPlane& plane) const;

  /// What is known to collide between two planes, as a pair that addLayer() takes.
  FrontPair newLayer(const Eigen::Vector3d& m, double from, double to) {
    return FrontPair::ofLayer(obstacles_.addLayer(m, from, to));
  }

  /// Takes what the cell has of a layer as known to collide. Nothing if not one of its planes alone
  /// cuts the cell.
  std::optional<CuttingPair> addLayer(const FrontPair& layer);

  const SlabArrays& slabs(const FrontPair& pair) const { return obstacles_.slabs(pair.obstacle); }

  /// The cutting pair that covers most of the cell under a single plane.
  std::optional<CuttingPair> champion() const;

  /// The inward normal of the plane beyond which a point is, of the cutting pair that is nearest to
  /// it; 0 if there is none.
  Eigen::Vector3d acrossNearest(const Eigen::Vector3d& point) const;

  /// How low C-obstacles reach within the cell.
  LowestInCell& lowest() { return lowest_; }

  /// Shrinks a part of the cell to a box around what the pair's C-obstacle has of it; false if that
  /// is nothing.
  bool clip(const FrontPair& pair, Cell& part) const;

 private:
  struct BoxedPair {
    FrontPair pair;
    NodeBox box;  ///< of its C-obstacle
  };
  /// One of `boxed_`, to be sorted: several times smaller.
  struct Ranked {
    double rank;
    int place;
  };

  void gatherLeaves(const std::vector<FrontPair>& inherited);
  /// Pairs are classified again if slices were cut off the cell since there were so many.
  void noteFront(std::size_t covered_before);
  void gatherLeaf(const FrontPair& pair);
  void gatherSection(const FrontPair& pair);
  CellSection sectionOfPair(const SupportObstacle& obstacle, NodePair nodes) const;
  CellSection sectionOfSweep(const SupportObstacle& obstacle, NodePair nodes) const;
  void moveSection(double outer, double inner, CellSection& section) const;
  void setPlane(const CellCut& cut, CuttingPair& cutting) const;
  void coverAll(const FrontPair& by);
  void noteDepth(const CuttingPair& cutting);
  void gatherCoarse(const std::vector<FrontPair>& inherited);
  void refine(const BoxedPair& coarse, int& probes);
  void expand(const BoxedPair& pair);
  void carve();
  bool carveBy(const FrontPair& pair, double least_share);
  void cover(const CellSlice& slice, const FrontPair& by);
  void classifyAgain();
  bool meetsCell(const NodeBox& box) const;
  bool meetsLayer(NodePair nodes);
  double eccentricity(const NodeBox& box) const;
  bool largerThanCell(const FrontPair& pair, const NodeBox& box, double ratio) const;
  void rankPair(double rank, const BoxedPair& boxed);

  const WhitenedPair& pair_;
  ObstacleTable& obstacles_;
  ProbabilityStatistics& statistics_;
  const SlabKernels& kernels_;

  Cell cell_;
  CellBox box_;
  std::vector<CoveredSlice> covered_;
  std::vector<CuttingPair> cutting_;
  double least_depth_ = 1.0;  ///< among the pairs with sections
  CellPlane deepest_;         ///< inner plane of the cutting pair of least depth
  std::vector<FrontPair> coarse_;
  NodeLayers layers_;
  LowestInCell lowest_;
  std::vector<BoxedPair> stack_;
  std::vector<CuttingPair> previous_;
  std::vector<BoxedPair> boxed_;
  std::vector<Ranked> ordered_;
};

}  // namespace fcl_prob::detail
