// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "families.h"

namespace fcl_prob_audit {
namespace {

using fcl_prob::ProbabilityMethod;

const std::vector<Kind> kRound = {Kind::sphere, Kind::ellipsoid, Kind::capsule, Kind::cone,
                                  Kind::cylinder};
const std::vector<Kind> kFlat = {Kind::box, Kind::convex, Kind::triangle};
const std::vector<Kind> kConvex = {Kind::box,      Kind::box,      Kind::convex,
                                   Kind::triangle, Kind::sphere,   Kind::cone,
                                   Kind::capsule,  Kind::cylinder, Kind::ellipsoid};
const std::vector<Kind> kMesh = {Kind::mesh};
const std::vector<Kind> kPieces = {Kind::box,    Kind::convex, Kind::triangle,
                                   Kind::sphere, Kind::mesh,   Kind::mesh};
const std::vector<Kind> kBounded = {Kind::box,     Kind::convex, Kind::triangle, Kind::sphere,
                                    Kind::capsule, Kind::mesh,   Kind::mesh,     Kind::octree};
const std::vector<ProbabilityMethod> kAutomatic = {
    ProbabilityMethod::automatic, ProbabilityMethod::automatic, ProbabilityMethod::interval};

Traits of(const std::vector<Kind>& a, const std::vector<Kind>& b) {
  Traits traits;
  traits.kinds_a = a;
  traits.kinds_b = b;
  traits.methods = kAutomatic;
  return traits;
}

template <typename Change>
Family family(const std::string& name, Traits traits, Change change) {
  Family result;
  result.name = name;
  result.traits = std::move(traits);
  change(result.traits);
  return result;
}

MeshStructure wildMesh() {
  MeshStructure wild;
  wild.most_shells = 3;
  wild.stray_point = 0.2;
  wild.degenerate = 0.2;
  return wild;
}

/// What polytope cells are for, and what only looks like it.
void mostlyConvexMeshes(Traits& t) {
  t.solid = 0.4;
  t.smaller = 0.3;
  t.ranks = {3, 3, 3, 3, 3, 3, 3, 2, 1};
  t.mesh.convex = 0.7;
  t.mesh.dented = 0.3;
  t.mesh.most_shells = 2;
  t.mesh.nested = 0.5;
  t.mesh.stray_point = 0.1;
  t.mesh.degenerate = 0.25;
  t.mesh.stray_far = 0.1;
  t.mesh.open = 0.1;
  t.mesh.thin = 0.1;
  t.on_grid = 0.0;
}

std::vector<Family> shapeFamilies() {
  return {family("convex pairs", of(kConvex, kConvex), [](Traits&) {}),
          family("boxes along the axes", of({Kind::box}, {Kind::box}),
                 [](Traits& t) {
                   t.aligned = 1.0;
                   t.ranks = {3, 3, 2, 1};
                   t.scale_exponent = 400;
                   t.least_ratio = 1e-6;
                   t.thin = 0.2;
                 }),
          family("meshes", of(kMesh, kPieces), [](Traits&) {}),
          family("broken meshes", of(kMesh, kPieces),
                 [](Traits& t) {
                   t.solid = 0.0;
                   t.mesh = wildMesh();
                   t.mesh.open = 0.5;
                   t.mesh.thin = 0.2;
                   t.mesh.flat = 0.3;
                 }),
          family("convex meshes", of(kMesh, kMesh), mostlyConvexMeshes),
          family("solids of several shells", of(kMesh, kBounded),
                 [](Traits& t) {
                   t.solid = 1.0;
                   t.smaller = 0.5;
                   t.mesh = wildMesh();
                   t.mesh.most_shells = 4;
                   t.mesh.nested = 0.4;
                   t.on_grid = 0.0;
                 }),
          family("thin shapes", of(kPieces, kPieces),
                 [](Traits& t) {
                   t.thin = 0.8;
                   t.mesh.thin = 0.8;
                   t.least_ratio = 1e-8;
                 }),
          family("octrees", of({Kind::octree}, kBounded), [](Traits& t) { t.solid = 0.4; }),
          family("half-spaces and planes",
                 of({Kind::halfspace, Kind::plane},
                    {Kind::box, Kind::convex, Kind::triangle, Kind::sphere, Kind::ellipsoid,
                     Kind::capsule, Kind::cone, Kind::cylinder, Kind::mesh, Kind::octree,
                     Kind::halfspace, Kind::plane}),
                 [](Traits& t) { t.gradient = 0.3; }),
          family("occupancy", of(kBounded, kBounded), [](Traits& t) { t.occupancy = 0.7; })};
}

std::vector<Family> displacementFamilies() {
  return {
      family("scales", of(kPieces, kPieces), [](Traits& t) { t.scale_exponent = 490; }),
      family("far from the origin", of(kPieces, kPieces),
             [](Traits& t) {
               t.far_exponent = 40;
               t.ranks = {3, 2, 1, 1, 1};
             }),
      family("along a line", of(kPieces, kPieces),
             [](Traits& t) {
               t.ranks = {1};
               t.gradient = 0.3;
               t.least_ratio = 1e-9;
               t.scale_exponent = 100;
               t.thin = 0.1;
               t.mesh = wildMesh();
             }),
      family("within a plane", of(kPieces, kPieces),
             [](Traits& t) {
               t.ranks = {2};
               t.gradient = 0.3;
             }),
      family("gradients", of(kConvex, kPieces),
             [](Traits& t) {
               t.gradient = 1.0;
               t.ranks = {3, 2, 2, 1};
             }),
      family("stiff displacements", of(kPieces, kPieces), [](Traits& t) { t.condition = 16.0; }),
      family("near-rotations", of(kPieces, kPieces),
             [](Traits& t) {
               t.near_rotation = 1.0;
               t.ranks = {3, 2, 1, 1};
             }),
      family("estimates", of(kPieces, kPieces),
             [](Traits& t) {
               t.methods = {ProbabilityMethod::estimate};
               t.gradient = 0.0;
             }),
      family("upper bounds", of(kPieces, kPieces), [](Traits& t) {
        t.methods = {ProbabilityMethod::convex_pcd, ProbabilityMethod::general_pcd,
                     ProbabilityMethod::general_pcd_min, ProbabilityMethod::exact};
      })};
}

std::vector<Family> questionFamilies() {
  std::vector<Family> result;
  const auto add = [&result](Family family, Question question) -> Family& {
    family.question = question;
    result.push_back(std::move(family));
    return result.back();
  };
  add(family("groups", of(kBounded, kPieces), [](Traits& t) { t.mesh.most_shells = 2; }),
      Question::group);
  add(family("groups of convex meshes", of(kMesh, kMesh), mostlyConvexMeshes), Question::group);
  add(family("managers",
             of({Kind::box, Kind::sphere, Kind::mesh, Kind::convex},
                {Kind::box, Kind::sphere, Kind::mesh, Kind::box, Kind::halfspace}),
             [](Traits& t) { t.solid = 0.1; }),
      Question::manager);
  add(family("batches", of(kPieces, kPieces), [](Traits&) {}), Question::batch);
  add(family("mixtures", of(kPieces, kPieces), [](Traits&) {}), Question::pair).mixture = true;
  add(family("truncations", of(kPieces, kPieces),
             [](Traits& t) {
               t.ranks = {3, 3, 2, 1};
               t.gradient = 0.0;
               t.methods = kAutomatic;
             }),
      Question::pair)
      .truncated = true;
  add(family("limits", of(kBounded, kBounded),
             [](Traits& t) {
               t.methods = {ProbabilityMethod::automatic,   ProbabilityMethod::interval,
                            ProbabilityMethod::estimate,    ProbabilityMethod::monte_carlo,
                            ProbabilityMethod::rare_event,  ProbabilityMethod::exact,
                            ProbabilityMethod::general_pcd, ProbabilityMethod::convex_pcd};
             }),
      Question::pair)
      .limited = true;
  add(family("limits of mixtures", of(kPieces, kPieces), [](Traits&) {}), Question::pair).mixture =
      true;
  result.back().limited = true;
  return result;
}

}  // namespace

const std::vector<Family>& slowFamilies() {
  static const std::vector<Family> all{family("many triangles", of(kMesh, kMesh), [](Traits& t) {
    t.solid = 0.4;
    t.smaller = 0.3;
    t.mesh.large = 1.0;
    t.mesh.most_shells = 2;
    t.mesh.nested = 0.5;
    t.mesh.open = 0.2;
    t.mesh.thin = 0.2;
    t.mesh.least_thinness = 1e-3;
    t.on_grid = 0.0;
    t.ranks = {3, 3, 3, 2, 1, 0};
  })};
  return all;
}

const std::vector<Family>& families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> result = shapeFamilies();
    for (auto&& more : {displacementFamilies(), questionFamilies()}) {
      result.insert(result.end(), more.begin(), more.end());
    }
    return result;
  }();
  return all;
}

}  // namespace fcl_prob_audit
