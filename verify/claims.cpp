// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "claims.h"

#include <algorithm>
#include <numeric>

namespace verify {
namespace {

std::string describe(const Plane& plane, int rank) {
  char text[128];
  std::string result = "[";
  for (int i = 0; i < rank; ++i) {
    std::snprintf(text, sizeof text, "%.17g, ", plane.normal[i]);
    result += text;
  }
  std::snprintf(text, sizeof text, "%.17g]", plane.level);
  return result + text;
}

bool opposite(const Plane& a, const Plane& b) {
  return a.normal[0] == -b.normal[0] && a.normal[1] == -b.normal[1] &&
         a.normal[2] == -b.normal[2] && a.level == -b.level;
}

bool have_opposite_planes(const ContactRegion& a, const ContactRegion& b) {
  for (const Plane& plane : a.planes) {
    for (const Plane& other : b.planes) {
      if (opposite(plane, other)) return true;
    }
  }
  return false;
}

std::string check_free_set(const Scene& scene, const Region& region) {
  std::string wrong = scene.touching(region, scene.objects[0], scene.objects[1]);
  if (wrong.empty() && scene.solid_contact &&
      scene.nesting(region.center) != Scene::Nesting::kNone) {
    wrong = "one object may be in a solid of the other";
  }
  return wrong;
}

std::string check_free(const Scene& scene, const Cell& cell, Tally& tally) {
  const int rank = scene.frame.rank;
  const Polytope box(rank, cell.lo, cell.hi);
  if (cell.free_planes.empty()) {
    ++tally.claims;
    const std::string wrong = check_free_set(scene, Region(box));
    return wrong.empty() ? "" : "\"free\": true: " + wrong;
  }
  Polytope rest = box;
  for (const Plane& plane : cell.free_planes) {
    ++tally.claims;
    Polytope side = box;
    side.cut(plane, -1);
    rest.cut(plane, 1);
    if (side.empty()) continue;
    const std::string wrong = check_free_set(scene, Region(side));
    if (!wrong.empty()) return "\"free\" " + describe(plane, rank) + ": " + wrong;
  }
  const Precision precision(tally.bits);
  tally.undecided = tally.undecided + tally.masses.polytope(rest, cell.lo, cell.hi);
  return "";
}

std::string check_inside(const Scene& scene, const Region& region, const Witness& witness) {
  const int x = witness.object, y = 1 - x;
  const bool solid = scene.solid_contact && scene.parts[y][0].solid;
  if (scene.parts[y].size() != 1 || scene.parts[y][0].convex) return "the other object is no mesh";
  if (!solid && !scene.is_closed[y]) return "the other object is not closed";
  if (!solid && witness.outside < 0) return "has no vertex outside";
  const auto& component = scene.component[x];

  const Object& surface = solid ? scene.objects[y] : scene.closed[y];
  for (const bool claimed_inside : {true, false}) {
    if (!claimed_inside && solid) continue;
    const int v = claimed_inside ? witness.vertex : witness.outside;
    if (v < 0 || static_cast<std::size_t>(v) >= component.size() || component[v] < 0) {
      return "no piece has vertex " + std::to_string(v);
    }
    const Object point = scene.objects[x].single(v);
    const std::string wrong =
        x == 0 ? scene.touching(region, point, surface) : scene.touching(region, surface, point);
    if (!wrong.empty()) return "vertex " + std::to_string(v) + " may be on the surface: " + wrong;
    const Scene::Crossings found = scene.crossings(x, v, surface, region.center);
    const bool as_said = solid ? found.winding != 0 : found.odd == claimed_inside;
    if (!found.known || !as_said) {
      return "vertex " + std::to_string(v) + " is not on the side of the surface that is claimed";
    }
  }
  if (solid) return "";
  if (component[witness.vertex] != component[witness.outside]) {
    return "the vertices are not of one component";
  }
  const Object& caps = scene.caps[y];
  const std::string wrong = x == 0 ? scene.touching(region, scene.objects[0], caps)
                                   : scene.touching(region, caps, scene.objects[1]);
  return wrong.empty() ? "" : "a cap may be touched: " + wrong;
}

std::string check_contained(const Scene& scene, const Region& region) {
  if (!scene.solid_contact) return "\"contained\" is for contact of solids";
  const std::string wrong = scene.touching(region, scene.objects[0], scene.objects[1]);
  if (!wrong.empty()) return wrong;
  if (scene.nesting(region.center) == Scene::Nesting::kSome) return "";
  return "no vertex is certainly in a solid of the other object";
}

std::string check_witness(const Scene& scene, const Region& region, const Witness& witness) {
  if (witness.kind == Witness::kInside) return check_inside(scene, region, witness);
  if (witness.kind == Witness::kContained) return check_contained(scene, region);
  for (int x = 0; x < 2; ++x) {
    if (static_cast<std::size_t>(witness.pair[x]) >= scene.objects[x].pieces.size()) {
      return "there is no piece " + std::to_string(witness.pair[x]) + " of " + (x == 0 ? "A" : "B");
    }
  }
  return scene.faces(witness.pair[0], witness.pair[1]).contain(region)
             ? ""
             : "the pieces do not certainly touch in all of it";
}

std::string check_contact(const Scene& scene, const Cell& cell, Tally& tally) {
  for (std::size_t i = 0; i < cell.contact.size(); ++i) {
    const ContactRegion& claim = cell.contact[i];
    const std::string name = "\"contact\" region " + std::to_string(i);
    for (std::size_t j = 0; j < i; ++j) {
      if (!have_opposite_planes(claim, cell.contact[j])) {
        return name + ": has no plane that is opposite to one of region " + std::to_string(j);
      }
    }
    ++tally.claims;
    Polytope polytope(scene.frame.rank, cell.lo, cell.hi);
    for (const Plane& plane : claim.planes) polytope.cut(plane, 1);
    if (polytope.empty()) continue;
    const std::string wrong = check_witness(scene, Region(polytope), claim.witness);
    if (!wrong.empty()) return name + ": " + wrong;
    const Ball mass = claim.planes.empty() ? tally.masses.box(scene.frame.rank, cell.lo, cell.hi)
                                           : tally.masses.polytope(polytope, cell.lo, cell.hi);
    tally.contact = tally.contact + mass;
  }
  return "";
}

// Halves the boxes by planes, those that lie across going to both sides, until few are left or none
// is gained.
class Overlaps {
 public:
  Overlaps(const std::vector<Box>& boxes, int rank) : boxes_(boxes), rank_(rank) {}
  std::pair<std::size_t, std::size_t> find(std::vector<int> which) {
    const std::size_t count = which.size();
    std::vector<int> best_below, best_above;
    std::size_t best = count;
    for (int axis = 0; axis < rank_ && count > 8; ++axis) {
      std::vector<double> sides;
      for (const int i : which) sides.push_back(boxes_[i].lo[axis]);
      std::nth_element(sides.begin(), sides.begin() + count / 2, sides.end());
      const double plane = sides[count / 2];
      std::vector<int> below, above;
      for (const int i : which) {
        if (boxes_[i].lo[axis] < plane) below.push_back(i);
        if (boxes_[i].hi[axis] > plane) above.push_back(i);
      }
      const std::size_t larger = std::max(below.size(), above.size());
      if (larger >= best) continue;
      best = larger;
      best_below = std::move(below);
      best_above = std::move(above);
    }
    if (best == count) return by_pairs(which);
    which = {};
    const auto found = find(std::move(best_below));
    return found.first != 0 ? found : find(std::move(best_above));
  }

 private:
  std::pair<std::size_t, std::size_t> by_pairs(const std::vector<int>& which) const {
    for (const int i : which) {
      for (const int j : which) {
        bool overlap = i < j;
        for (int k = 0; k < rank_; ++k) {
          overlap =
              overlap && boxes_[i].lo[k] < boxes_[j].hi[k] && boxes_[j].lo[k] < boxes_[i].hi[k];
        }
        if (overlap) return {boxes_[i].line, boxes_[j].line};
      }
    }
    return {0, 0};
  }

  const std::vector<Box>& boxes_;
  int rank_;
};

}  // namespace

std::string check_cell(const Scene& scene, const Cell& cell, Tally& tally) {
  std::string wrong = check_contact(scene, cell, tally);
  if (!wrong.empty()) return wrong;
  const Ball mass = tally.masses.box(scene.frame.rank, cell.lo, cell.hi);
  const Precision precision(tally.bits);
  tally.cells = tally.cells + mass;
  if (!cell.claims_free) {
    tally.undecided = tally.undecided + mass;
    return "";
  }
  const Precision frame_precision(scene.frame.bits);
  return check_free(scene, cell, tally);
}

std::pair<std::size_t, std::size_t> overlapping(const std::vector<Box>& boxes, int rank) {
  std::vector<int> all(boxes.size());
  std::iota(all.begin(), all.end(), 0);
  return Overlaps(boxes, rank).find(std::move(all));
}

}  // namespace verify
