// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Proofs that the objects touch everywhere in a region.
#include <cmath>

#include "claims.h"

namespace verify {
namespace {

std::string check_inside(const Scene& scene, const Polytope& polytope, const Region& region,
                         const Witness& witness) {
  const int x = witness.object, y = 1 - x;
  const bool solid = scene.solid_contact && scene.parts[y][0].solid;
  if (scene.parts[y].size() != 1 || scene.parts[y][0].convex) return "the other object is no mesh";
  if (!solid && !scene.is_closed[y]) return "the other object is not closed";
  if (!solid && witness.outside < 0) return "has no vertex outside";
  const auto& component = scene.component[x];
  const BallVec center = polytope.center();
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
    const Scene::Crossings found = scene.crossings(x, v, surface, center);
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

std::string check_contained(const Scene& scene, const Polytope& polytope, const Region& region) {
  if (!scene.solid_contact) return "\"contained\" is for contact of solids";
  const std::string wrong = scene.touching(region, scene.objects[0], scene.objects[1]);
  if (!wrong.empty()) return wrong;
  if (scene.nesting(polytope.center()) == Scene::Nesting::kSome) return "";
  return "no vertex is certainly in a solid of the other object";
}

}  // namespace

std::string check_witness(const Scene& scene, const Polytope& polytope, const Region& region,
                          const Witness& witness) {
  if (witness.kind == Witness::kInside) return check_inside(scene, polytope, region, witness);
  if (witness.kind == Witness::kContained) return check_contained(scene, polytope, region);
  for (int x = 0; x < 2; ++x) {
    if (static_cast<std::size_t>(witness.pair[x]) >= scene.objects[x].pieces.size()) {
      return "there is no piece " + std::to_string(witness.pair[x]) + " of " + (x == 0 ? "A" : "B");
    }
  }
  return scene.faces
      ->get(scene.frame, scene.objects[0], witness.pair[0], scene.objects[1], witness.pair[1])
      ->contain(region);
}

}  // namespace verify
