// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The objects of a certificate, with what claims about them are checked by, and the claims of
// cells.
#pragma once

#include <string>
#include <vector>

#include "objects.h"
#include "polytope.h"

namespace verify {

/// Looks for a hyperplane that proves that pieces k of a and l of b touch nowhere in the region;
/// false: there is none, or none that can be told from one that does not.
bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l);

/// Whether pieces k of a and l of b certainly touch everywhere in the region: its corners are in
/// `L - K`, which is convex.
bool contains(const Frame& frame, const Region& region, const Object& a, const Piece& k,
              const Object& b, const Piece& l);

class Scene {
 public:
  /// Throws Malformed where parts or caps are not what they are said to be.
  explicit Scene(const Reader& reader);

  /// Throws Refused if a piece of a may touch one of b in the region.
  void check_apart(const Region& region, const Object& a, const Object& b) const;
  /// Whether in contact of solids, at y, a component of one object is in a solid of the other.
  enum class Nesting { kNone, kSome, kUnknown };
  Nesting nesting(const BallVec& y) const;

  struct Crossings {
    bool known = false;  // false if the point may be on the surface
    bool odd = false;
    int winding = 0;
  };
  /// What a ray from a vertex of object x crosses of `surface`, of the other object, at y.
  Crossings crossings(int x, int vertex, const Object& surface, const BallVec& y) const;

  Frame frame;
  bool solid_contact;
  std::array<std::vector<Part>, 2> parts;
  std::vector<Object> objects;  // A, B
  // Of an object of one mesh: its caps, and it together with them; empty if this is not closed.
  std::vector<Object> caps, closed;
  std::array<bool, 2> is_closed{};
  /// Connected component of each vertex; -1 for one that is in no piece.
  std::array<std::vector<int>, 2> component;

 private:
  void add_object(int x, const std::vector<Caps>& cap_lines);
  void add_components(int x);

  std::array<std::vector<Object>, 2> solids_;
  std::array<std::vector<int>, 2> representatives_;  // a vertex of each component
};

/// What has been verified, added up. One a thread.
struct Tally {
  Ball contact;    // mass of regions of contact
  Ball cells;      // mass of cells
  Ball undecided;  // mass of what is in no free set
  std::size_t claims = 0;
  slong bits;  // the precision of the sums
  Masses masses;

  explicit Tally(slong precision) : bits(precision), masses(precision) {}
};

/// Checks all claims of a cell and adds its masses; throws Refused.
void check_cell(const Scene& scene, const Cell& cell, Tally& tally);

struct Box {
  std::size_t line;
  Vec lo, hi;
};
/// Lines of two boxes that overlap; zeros if there are none.
std::pair<std::size_t, std::size_t> overlapping(const std::vector<Box>& boxes, int rank);

}  // namespace verify
