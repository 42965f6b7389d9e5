// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Regions, and hyperplanes between a region and what two pieces touch at.
#pragma once

#include <vector>

#include "objects.h"
#include "polytope.h"

namespace verify {

/// The open set `box ∩ half-spaces`. Beyond the rank it is flat, at zero.
struct Region {
  Region(int rank, const Vec& lo, const Vec& hi);
  Region(const Polytope& polytope, const Vec& lo, const Vec& hi, const std::vector<Plane>& planes);
  /// A corner times a positive number, to have no division and so no rounding.
  struct Corner {
    BallVec point;
    Ball times;
  };
  Corner exact_corner(std::size_t i) const;

  Vec lo, hi;
  Vec bound{};                    // of |y|
  std::vector<Vec> normals;       // of axes, then planes
  std::vector<Vec> corners;       // rounded
  std::vector<ExactPoint> exact;  // the corners exactly; none where the region is a box
};

/// What a normal says exactly of `L - K` and of the displacements.
struct Heights {
  Heights(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l,
          const BallVec& normal);
  /// Times the corner's factor.
  Ball at(const Region::Corner& corner) const {
    return dot(slope, corner.point) + constant * corner.times;
  }

  Ball lo, hi;  // of L - K
  BallVec slope;
  Ball constant;
};

/// A direction that can be had exactly: the normal of two edges, or one of a region.
struct Edge {
  enum Of { kA, kB, kRegion } of;
  int from, to;  // two vertices, or two of the region's normals, whose cross product it is
  Vec y;         // rounded
};
struct Direction {
  Vec y;              // rounded, in coordinates y'
  int first, second;  // edges; or the region's normal `first`, where second is -1
};

/// Looks for hyperplanes. Keeps memory from one call to the next.
class Separator {
 public:
  Separator(const Frame& frame, const Object& a, const Object& b) : frame_(frame), a_(a), b_(b) {}
  /// Proves that pieces k of A and l of B touch nowhere in the region; false: could not.
  bool separates(const Region& region, const Piece& k, const Piece& l);

 private:
  using Vertices = std::vector<int>;
  bool proven(const Vec& direction, bool& unclear) const;
  bool proven_exactly(const Direction& direction) const;
  bool search(const Vertices& of_k, const Vertices& of_l);
  bool try_direction(const Direction& direction);
  bool search_from_nearest_point();
  void list_edges(const Vertices& of_k, const Vertices& of_l);
  BallVec exact_edge(const Edge& edge) const;

  const Frame& frame_;
  const Object& a_;
  const Object& b_;
  // What is looked at.
  const Region* region_ = nullptr;
  const Piece* k_ = nullptr;
  const Piece* l_ = nullptr;
  std::vector<Edge> edges_;
  std::vector<Direction> unclear_;
};

}  // namespace verify
