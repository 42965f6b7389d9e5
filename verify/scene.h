// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The objects of a certificate, with what claims about them are checked by, and the claims of
// cells.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "objects.h"
#include "polytope.h"

namespace verify {

/// Looks for a hyperplane that proves that pieces k of a and l of b touch nowhere in the region;
/// false: there is none, or none that can be told from one that does not.
bool separates(const Frame& frame, const Region& region, const Object& a, const Piece& k,
               const Object& b, const Piece& l);

/// The half-spaces of which `L - K` is the intersection: planes that support it on both sides,
/// among them all of its faces. Where K or L is swept by a ball, those of what is swept, and its
/// surface.
class Faces {
 public:
  Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l);
  /// Whether `L - K` has an inside and certainly contains the displacements of the region.
  bool contain(const Region& region) const;

 private:
  struct Slab {
    BallVec slope;  // of the height over y
    Ball lo, hi;    // of L - K
  };
  void add_surface(const Object& a, const Piece& k, const Object& b, const Piece& l);
  bool is_near(const BallVec& corner, const Ball& times) const;

  const Frame& frame_;
  Ball radius_;  // of both balls together
  bool has_inside_ = false;
  std::vector<Slab> slabs_;
  std::vector<std::array<BallVec, 3>> surface_;  // triangles
};

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
  /// Of a pair of pieces; kept, since many cells share them. Threads may ask at the same time.
  const Faces& faces(int k, int l) const;

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
  mutable std::mutex mutex_;
  mutable std::map<std::pair<int, int>, std::unique_ptr<const Faces>> faces_;
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
