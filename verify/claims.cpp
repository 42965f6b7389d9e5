// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene.h"

#include <algorithm>
#include <numeric>

namespace verify {
namespace {

bool have_opposite_planes(const ContactRegion& a, const ContactRegion& b) {
  for (const Plane& p : a.planes) {
    for (const Plane& q : b.planes) {
      const Vec opposite{-q.normal[0], -q.normal[1], -q.normal[2]};
      if (p.normal == opposite && p.level == -q.level) return true;
    }
  }
  return false;
}

void check_free_set(const Scene& scene, const Region& region) {
  scene.check_apart(region, scene.objects[0], scene.objects[1]);
  require(!scene.solid_contact || scene.nesting(region.center) == Scene::Nesting::kNone,
          "one object may be in a solid of the other");
}

void check_free(const Scene& scene, const Cell& cell, Tally& tally) {
  const Polytope box(scene.frame.rank, cell.lo, cell.hi);
  if (cell.free_planes.empty()) {
    ++tally.claims;
    return check_free_set(scene, Region(box));
  }
  Polytope rest = box;
  for (const Plane& plane : cell.free_planes) {
    ++tally.claims;
    Polytope side = box;
    side.cut(plane, -1);
    rest.cut(plane, 1);
    if (!side.empty()) check_free_set(scene, Region(side));
  }
  const Ball mass = tally.masses.polytope(rest, cell.lo, cell.hi);
  const Precision precision(tally.bits);
  tally.undecided = tally.undecided + mass;
}

// That a vertex of object x is inside or outside of the surface for all of the region.
void check_side(const Scene& scene, int x, int vertex, const Object& surface, bool solid,
                bool inside, const Region& region) {
  const std::string name = "vertex " + std::to_string(vertex);
  const auto& component = scene.component[x];
  require(
      vertex >= 0 && static_cast<std::size_t>(vertex) < component.size() && component[vertex] >= 0,
      name + " is of no piece");
  const Object point = scene.objects[x].single(vertex);
  scene.check_apart(region, x == 0 ? point : surface, x == 0 ? surface : point);
  const Scene::Crossings found = scene.crossings(x, vertex, surface, region.center);
  require(found.known && (solid ? found.winding != 0 : found.odd) == inside,
          name + " is not on the side of the surface that is claimed");
}

void check_inside(const Scene& scene, const Region& region, const Witness& witness) {
  const int x = witness.object, y = 1 - x;
  const bool solid = scene.solid_contact && scene.parts[y][0].solid;
  require(scene.parts[y].size() == 1 && !scene.parts[y][0].convex, "the other object is no mesh");
  require(solid || scene.is_closed[y], "the other object is not closed");
  const Object& surface = solid ? scene.objects[y] : scene.closed[y];
  check_side(scene, x, witness.vertex, surface, solid, true, region);
  if (solid) return;
  check_side(scene, x, witness.outside, surface, false, false, region);
  require(scene.component[x][witness.vertex] == scene.component[x][witness.outside],
          "the vertices are not of one component");
  const Object &caps = scene.caps[y], &object = scene.objects[x];
  scene.check_apart(region, x == 0 ? object : caps, x == 0 ? caps : object);
}

void check_witness(const Scene& scene, const Region& region, const Witness& witness) {
  if (witness.kind == Witness::kInside) return check_inside(scene, region, witness);
  if (witness.kind == Witness::kContained) {
    require(scene.solid_contact, "\"contained\" is for contact of solids");
    scene.check_apart(region, scene.objects[0], scene.objects[1]);
    require(scene.nesting(region.center) == Scene::Nesting::kSome,
            "no vertex is certainly in a solid of the other object");
    return;
  }
  for (int x = 0; x < 2; ++x) {
    require(static_cast<std::size_t>(witness.pair[x]) < scene.objects[x].pieces.size(),
            "there is no piece " + std::to_string(witness.pair[x]));
  }
  const Object &a = scene.objects[0], &b = scene.objects[1];
  require(contains(scene.frame, region, a, a.pieces[witness.pair[0]], b, b.pieces[witness.pair[1]]),
          "the pieces do not certainly touch in all of it");
}

void check_contact(const Scene& scene, const Cell& cell, Tally& tally) {
  for (std::size_t i = 0; i < cell.contact.size(); ++i) {
    const ContactRegion& claim = cell.contact[i];
    for (std::size_t j = 0; j < i; ++j) {
      require(have_opposite_planes(claim, cell.contact[j]),
              "two regions of contact have no planes that are opposite");
    }
    ++tally.claims;
    Polytope polytope(scene.frame.rank, cell.lo, cell.hi);
    for (const Plane& plane : claim.planes) polytope.cut(plane, 1);
    if (polytope.empty()) continue;
    check_witness(scene, Region(polytope), claim.witness);
    const Ball mass = tally.masses.polytope(polytope, cell.lo, cell.hi);
    const Precision precision(tally.bits);
    tally.contact = tally.contact + mass;
  }
}

std::pair<std::size_t, std::size_t> overlapping_pair(const std::vector<Box>& boxes,
                                                     const std::vector<int>& which, int rank) {
  for (const int i : which) {
    for (const int j : which) {
      bool overlap = i < j;
      for (int k = 0; k < rank && overlap; ++k) {
        overlap = boxes[i].lo[k] < boxes[j].hi[k] && boxes[j].lo[k] < boxes[i].hi[k];
      }
      if (overlap) return {boxes[i].line, boxes[j].line};
    }
  }
  return {0, 0};
}

// Halves the boxes by planes, those that lie across going to both sides, until few are left or none
// is gained.
std::pair<std::size_t, std::size_t> overlapping(const std::vector<Box>& boxes,
                                                const std::vector<int>& which, int rank) {
  std::vector<int> best_below = which, best_above;
  for (int axis = 0; axis < rank && which.size() > 8; ++axis) {
    std::vector<double> sides;
    for (const int i : which) sides.push_back(boxes[i].lo[axis]);
    const auto middle = sides.begin() + sides.size() / 2;
    std::nth_element(sides.begin(), middle, sides.end());
    std::vector<int> below, above;
    for (const int i : which) {
      if (boxes[i].lo[axis] < *middle) below.push_back(i);
      if (boxes[i].hi[axis] > *middle) above.push_back(i);
    }
    if (std::max(below.size(), above.size()) >= std::max(best_below.size(), best_above.size())) {
      continue;
    }
    best_below = std::move(below);
    best_above = std::move(above);
  }
  if (best_below.size() == which.size()) return overlapping_pair(boxes, which, rank);
  const auto found = overlapping(boxes, best_below, rank);
  return found.first != 0 ? found : overlapping(boxes, best_above, rank);
}

}  // namespace

void check_cell(const Scene& scene, const Cell& cell, Tally& tally) {
  check_contact(scene, cell, tally);
  if (cell.claims_free) check_free(scene, cell, tally);
  const Ball mass = tally.masses.box(scene.frame.rank, cell.lo, cell.hi);
  const Precision precision(tally.bits);
  tally.cells = tally.cells + mass;
  if (!cell.claims_free) tally.undecided = tally.undecided + mass;
}

std::pair<std::size_t, std::size_t> overlapping(const std::vector<Box>& boxes, int rank) {
  std::vector<int> all(boxes.size());
  std::iota(all.begin(), all.end(), 0);
  return overlapping(boxes, all, rank);
}

}  // namespace verify
