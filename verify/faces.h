// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The half-spaces of which L - K is the intersection, for contact in all of a region.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "objects.h"
#include "separation.h"

namespace verify {

/// Planes that support `L - K` on both sides, among them all of its faces.
class Faces {
 public:
  Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l);
  /// Empty, or why `L - K` does not certainly contain the region.
  std::string contain(const Region& region) const;

 private:
  // An edge with the third vertices of the two faces at it; -1 where there are not just two.
  struct FaceEdge {
    const Object* object;
    int from, to;
    int across[2];
  };
  struct Slab {
    Vec normal;
    double lo, hi;  // of L - K, rounded inwards
    FaceEdge first, second;
  };
  static std::vector<FaceEdge> edges_of(const Object& object, const Piece& piece);
  void add(const FaceEdge& first, const FaceEdge& second);
  bool is_no_face(const FaceEdge& e, const FaceEdge& f) const;
  bool has_inside(const std::vector<FaceEdge>& of_k, const std::vector<FaceEdge>& of_l) const;
  bool contains_exactly(const Slab& slab, const Region& region) const;

  const Frame& frame_;
  const Object &a_, &b_;
  const Piece &k_, &l_;
  Vec error_, reach_;
  bool has_inside_;
  std::vector<Slab> slabs_;
};

/// Keeps the faces of pairs, which many cells share. Threads may ask at the same time.
class FacesOfPairs {
 public:
  std::shared_ptr<const Faces> get(const Frame& frame, const Object& a, int k, const Object& b,
                                   int l);

 private:
  std::mutex mutex_;
  std::map<std::pair<int, int>, std::shared_ptr<const Faces>> known_;
};

}  // namespace verify
