// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The objects of a certificate, with what claims about them are checked by, and the checks of their
// surfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "faces.h"
#include "objects.h"
#include "separation.h"

namespace verify {

class Scene {
 public:
  /// Throws Malformed where parts or caps are not what they are said to be.
  explicit Scene(const Reader& reader);

  /// Empty if no piece of a touches one of b in the region; else says which could not be told
  /// apart.
  std::string touching(const Region& region, const Object& a, const Object& b) const;
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
  std::shared_ptr<FacesOfPairs> faces = std::make_shared<FacesOfPairs>();
  /// Connected component of each vertex; -1 for one that is in no piece.
  std::array<std::vector<int>, 2> component;

 private:
  struct Solid {
    const Part* part;
    Object surface;
  };
  void check_convex(const Part& part) const;
  void add_components(int x);

  std::array<std::vector<Caps>, 2> cap_lines_;
  std::array<std::vector<Solid>, 2> solids_;
  std::array<std::vector<int>, 2> representatives_;  // a vertex of each component
};

}  // namespace verify
