// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The objects of a certificate, with what claims about them are checked by, and the checks of their
// surfaces.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "pairs.h"

namespace verify {

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

}  // namespace verify
