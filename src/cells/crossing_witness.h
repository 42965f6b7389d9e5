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

/// Vertices of one mesh: one inside the other, closed surface, and one of the same component of its
/// own outside; -1 of solids, for which the first one is enough. Indices into the mesh's tree.
struct CrossingProof {
  bool of_a = false;
  int inside = -1;
  int outside = -1;
};

/// What lies between two parallel planes, { from <= m·y <= to }, m a unit vector. Either level is
/// infinite where its plane does not cut the cell.
struct CrossingLayer {
  Eigen::Vector3d m;
  double from;
  double to;
  CrossingProof proof;
};

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

  /// Whether the cell is large beside the triangles of one of the meshes.
  bool isBesideSmallTriangles(const Cell& cell) const;

  Hint hint() const;
  void setHint(const Hint& hint);

  /// True only if all of `cell` collides: proof() has by what.
  bool covers(const Cell& cell);

  const CrossingProof& proof() const { return proof_; }

  /// A layer of which all that `cell` has collides: from where a vertex is inside to where, if they
  /// are surfaces, another one is not outside any more. As thick as the vertices that lie farthest
  /// out, or near the pairs of nodes `near`, can show; nothing if they show none.
  std::optional<CrossingLayer> layer(const Cell& cell, const std::vector<FrontPair>& near);

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

  struct Attempt {
    Side* side;
    CrossingLayer layer;
    double share;  ///< of the cell's extent along m
  };

  static SweptVertex sweep(const Side& side, int vertex, const Cell& cell);
  bool coversBy(Side& side, Candidate& candidate, const Cell& cell);
  std::optional<bool> isInside(Side& side, const SweptVertex& swept);
  bool crosses(Side& side, int vertex, const Cell& cell);
  int staysOutside(Side& side, int component, const Cell& cell);
  bool avoidsCaps(Side& side, const Cell& cell);

  void trySide(Side& side, const Cell& cell, const std::vector<FrontPair>& near);
  Eigen::Vector3d inwardsNear(Side& side, const Cell& cell, const std::vector<FrontPair>& near);
  void tryAlong(Side& side, const Cell& cell, const std::vector<FrontPair>& near,
                Eigen::Vector3d m);
  std::vector<int> farthestAlong(const Side& side, const std::vector<FrontPair>& near,
                                 const Eigen::Vector3d& m) const;
  double sideFrom(Side& side, int vertex, const Cell& cell, const Eigen::Vector3d& m, bool inside,
                  double most);
  double outsideTo(Side& side, CrossingProof& proof, const Cell& cell, const Eigen::Vector3d& m,
                   double from);
  bool findTouched(Side& side, const SweptVertex& swept);
  Eigen::Vector3d acrossTouched(const Side& side) const;
  double highestTouched(const Side& side, int vertex, const SweptVertex& swept,
                        const std::vector<Eigen::Vector3i>& touched, const Eigen::Vector3d& m,
                        double most) const;
  bool isBeyond(Side& side, int vertex, const CellPlane& plane, bool inside, const Cell& cell);

  bool solid_;
  bool moves_;  ///< the shapes, other than by the displacement
  std::shared_ptr<const BandMargin> band_;
  std::vector<Side> sides_;
  Eigen::Vector3d triangle_size_;         ///< on the average, of the mesh of smaller ones
  std::vector<Eigen::Vector3i> touched_;  ///< triangles of the outer mesh and its caps
  std::optional<Attempt> best_;
  CrossingProof proof_;
};

}  // namespace fcl_prob::detail
