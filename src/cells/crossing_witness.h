// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Proof, by topology, that two surfaces meet at every displacement of a cell.
#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "cells/open_cell.h"
#include "scene/capped_tree.h"

namespace fcl_prob::detail {

/// If a vertex of one mesh stays inside the other, capped, for every displacement of a cell, while
/// another vertex of the same component of it stays outside, then the surfaces meet throughout the
/// cell, unless it is at a cap. Where triangles are much smaller than the cell no single pair of
/// them could show that.
class CrossingWitness {
 public:
  /// The vertices by which proofs were found last, which are tried first: of either mesh, -1 for
  /// none. All else that one search leaves for the next only saves time.
  using Hint = std::array<int, 2>;

  /// Keeps a reference to `pair`.
  /// \param solid  whether a mesh inside the other one collides with it, too
  CrossingWitness(const WhitenedPair& pair, bool solid);

  /// Whether there is anything to try: two meshes with caps.
  bool usable() const { return !sides_.empty(); }

  Hint hint() const;
  void setHint(const Hint& hint);

  /// True only if all of `cell` collides.
  bool covers(const Cell& cell);

  /// A plane beyond which all of `cell` collides, as far out as a few vertices near the pairs of
  /// nodes `near` can show; nothing if they show none.
  std::optional<CellPlane> plane(const Cell& cell, const std::vector<FrontPair>& near);

 private:
  /// Points and rays tried until one of them tells inside from outside for certain.
  static constexpr int kTrials = 6;

  /// A vertex of the inner mesh with all its displacements: a box.
  struct SweptVertex {
    double lo[3];
    double hi[3];

    bool isWithin(const SweptVertex& other) const;
  };

  /// A vertex that is tried, and where it was last found to be outside of all of the outer mesh.
  struct Candidate {
    int vertex;
    std::optional<SweptVertex> outside;
  };

  /// One way round: a vertex of `inner` inside `outer`.
  struct Side {
    CappedTree inner;
    CappedTree outer;
    double sign;  ///< of the displacement of the inner mesh
    std::vector<Candidate> candidates;
    std::vector<std::array<int, 6>>
        extremes;  ///< of every component: vertices lowest and highest by axis
    int last_found = -1;
  };

  /// Vertices that were tried, each of the inner mesh of a side.
  using Tried = std::vector<std::pair<const Side*, int>>;

  struct Attempt {
    Side* side;
    int vertex;
    CellPlane plane;
    double depth;  ///< of the plane in the cell, -1 to 1: the lower the more is covered
  };

  static SweptVertex sweep(const Side& side, int vertex, const Cell& cell);
  bool coversBy(Side& side, Candidate& candidate, const Cell& cell);
  std::optional<bool> isInside(Side& side, const SweptVertex& swept);
  bool crosses(Side& side, int vertex, const Cell& cell);
  bool leaves(const Side& side, int component, const Cell& cell) const;
  bool avoidsCaps(Side& side, const Cell& cell);

  void tryNear(const Cell& cell, const std::vector<FrontPair>& near, const Eigen::Vector3d* m);
  void tryVertex(Side& side, int vertex, const Cell& cell, const Eigen::Vector3d* m);
  bool findTouched(Side& side, const SweptVertex& swept);
  void tryPlane(Side& side, int vertex, const SweptVertex& swept, const Cell& cell,
                Eigen::Vector3d m);
  static Eigen::Vector3d across(const Side& side, const Eigen::Vector3i& triangle);
  Eigen::Vector3d acrossTouched(const Side& side) const;
  double highestTouched(const Side& side, int vertex, const SweptVertex& swept,
                        const std::vector<Eigen::Vector3i>& touched, const Eigen::Vector3d& m,
                        double most) const;
  static bool isWithin(const CoveredPart& part, const Eigen::Vector3d& y);
  bool certify(Side& side, int vertex, const CoveredPart& part, const Eigen::Vector3d& m,
               double depth, const Cell& cell);

  /// Points of a cell near its corner that lies farthest along m, some way into what a plane of
  /// this depth leaves.
  static Eigen::Vector3d pointBeyond(const Cell& cell, const Eigen::Vector3d& m, double depth,
                                     int trial);

  bool solid_;
  bool moves_;  ///< the shapes, other than by the displacement
  std::shared_ptr<const BandMargin> band_;
  std::vector<Side> sides_;
  Tried tried_along_;                     ///< the normal asked for last
  Tried tried_across_;                    ///< what they touch, in this cell
  std::vector<Eigen::Vector3i> touched_;  ///< triangles of the outer mesh and its caps
  std::optional<Attempt> best_;
};

}  // namespace fcl_prob::detail
