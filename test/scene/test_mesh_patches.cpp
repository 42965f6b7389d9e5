// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex patches of meshes: against winding numbers, hulls of Minkowski sums and displaced
// fcl::collide.
#include "scene/mesh_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "catch.h"
#include "cells/fat_members.h"
#include "dented_mesh.h"
#include "fcl_prob/convex_polytope.h"
#include "partition_query.h"
#include "random_bodies.h"
#include "sampled_contact.h"
#include "scene/hull_triangles.h"
#include "whitened_meshes.h"

namespace {

using fcl_prob::ConvexPolytope;
using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using namespace fcl_prob::detail;
using fcl_prob_test::boxMesh;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::PartitionQuery;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::sphereMesh;
using fcl_prob_test::torusMesh;
using fcl_prob_test::WhitenedMeshes;
using fcl_prob_test::windingNumber;

TriangleMesh moved(const TriangleMesh& mesh, double scale, const Eigen::Vector3d& by) {
  TriangleMesh result = mesh;
  for (Eigen::Vector3d& v : result.vertices) v = scale * v + by;
  return result;
}

/// Every triangle as four.
TriangleMesh subdivided(const TriangleMesh& mesh) {
  TriangleMesh result = mesh;
  result.triangles.clear();
  for (const fcl::Triangle& t : mesh.triangles) {
    std::size_t middles[3];
    for (int k = 0; k < 3; ++k) {
      middles[k] = result.vertices.size();
      result.vertices.push_back(0.5 * (mesh.vertices[t[k]] + mesh.vertices[t[(k + 1) % 3]]));
    }
    for (int k = 0; k < 3; ++k) {
      result.triangles.emplace_back(t[k], middles[k], middles[(k + 2) % 3]);
    }
    result.triangles.emplace_back(middles[0], middles[1], middles[2]);
  }
  return result;
}

/// Two bars at a right angle, as one closed surface.
TriangleMesh angleMesh(double size, double height) {
  TriangleMesh mesh;
  for (const double z : {-0.5 * height, 0.5 * height}) {
    for (const auto& [x, y] : {std::pair{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}) {
      mesh.vertices.emplace_back(size * (0.5 * x - 0.5), size * (0.5 * y - 0.5), z);
    }
  }
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 0}, {0, 1}, {1, 2}}) {
    mesh.triangles.emplace_back(9, a + 6, b + 6);
    mesh.triangles.emplace_back(3, b, a);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t next = (i + 1) % 6;
    mesh.triangles.emplace_back(i, next, next + 6);
    mesh.triangles.emplace_back(i, next + 6, i + 6);
  }
  return mesh;
}

/// Shells that are hard on patches: dents, cavities and bodies that touch the shell from inside,
/// thin gaps, parts that go through each other, inside out.
TriangleMesh hardMesh(int kind, RandomBodies& random) {
  const auto seed = static_cast<std::uint64_t>(random.integer(0, 1000));
  switch (kind % 10) {
    case 0:
      return bumpyMesh(0.4, 10, 14, seed);
    case 1:
      return torusMesh(0.4, random.uniform(0.05, 0.2), 14, 8);
    case 2:
      return fcl_prob_test::withDents(sphereMesh(0.4, 10, 14), 20, random.logUniform(1e-9, 1e-2),
                                      random);
    case 3: {
      // A cavity, or a body, from within up to the shell, a thin gap away from it, or through it.
      const TriangleMesh shell = sphereMesh(0.4, 8, 12);
      const double scale =
          1.0 + (random.integer(0, 1) == 0 ? -1 : 1) * random.logUniform(1e-12, 0.1);
      TriangleMesh within = moved(shell, random.integer(0, 3) == 0 ? 0.5 : scale, {0, 0, 0});
      if (random.integer(0, 2) == 0) within = moved(within, 0.5, {0.2, 0, 0});
      if (random.integer(0, 1) == 0) within = fcl_prob_test::reversed(within);
      return fcl_prob_test::joined(shell, within);
    }
    case 4:
      return fcl_prob_test::joined(bumpyMesh(0.3, 8, 12, seed),
                                   moved(torusMesh(0.3, 0.1, 10, 8), 1.0, {0.1, 0.0, 0.0}));
    case 5:
      return fcl_prob_test::reversed(bumpyMesh(0.4, 8, 12, seed));
    case 6: {
      // Two boxes face to face, a thin gap or nothing between them.
      const double gap = random.integer(0, 2) == 0 ? 0.0 : random.logUniform(1e-12, 1e-2);
      return fcl_prob_test::joined(boxMesh({0.3, 0.3, 0.3}),
                                   moved(boxMesh({0.3, 0.3, 0.3}), 1.0, {0.3 + gap, 0.05, 0.0}));
    }
    case 7: {
      // Faces of many triangles, one of which may be a little off.
      TriangleMesh angle = subdivided(subdivided(angleMesh(0.3, random.uniform(0.05, 0.3))));
      if (random.integer(0, 1) == 0) {
        const auto v = static_cast<std::size_t>(
            random.integer(0, static_cast<int>(angle.vertices.size()) - 1));
        const Eigen::Vector3d from = angle.vertices[v];
        const Eigen::Vector3d to = from + random.logUniform(1e-9, 1e-2) * random.direction();
        std::replace(angle.vertices.begin(), angle.vertices.end(), from, to);
      }
      return angle;
    }
    case 8:
      return fcl_prob_test::joined(
          subdivided(boxMesh({0.4, 0.1, 0.2})),
          moved(subdivided(boxMesh({0.1, 0.4, 0.2})), 1.0, {random.uniform(0.01, 0.14), 0, 0}));
    default: {
      TriangleMesh flat = bumpyMesh(0.4, 10, 14, seed);
      const double share = random.logUniform(1e-4, 0.3);
      for (Eigen::Vector3d& v : flat.vertices) v.z() *= share;
      return flat;
    }
  }
}

}  // namespace

TEST_CASE("hulls by gift wrapping are those of Qhull", "[patches]") {
  RandomBodies random(31);
  int given_up = 0;  // where four points are on one line
  for (int i = 0; i < 60; ++i) {
    std::vector<Eigen::Vector3d> points = random.onSphere(random.integer(4, 25), 1.0);
    if (i % 3 == 1) {
      // In planes, and along lines.
      for (Eigen::Vector3d& p : points) p = (2 * p).array().round().matrix();
      std::set<std::array<double, 3>> once;
      for (const Eigen::Vector3d& p : points) once.insert({p.x(), p.y(), p.z()});
      points.clear();
      for (const auto& [x, y, z] : once) points.emplace_back(x, y, z);
    }
    if (i % 3 == 2) points.push_back(Eigen::Vector3d::Zero());
    const ConvexPolytope hull = fcl_prob::convexHull(points);
    const TriangleMesh wrapped = fcl_prob::detail::hullTriangles(points);
    CAPTURE(i, points.size());
    if (hull.faces.empty()) continue;
    if (wrapped.triangles.empty()) {
      ++given_up;
      continue;
    }
    const Eigen::Vector3d middle = points[0] + 0.25 * (wrapped.vertices[0] + wrapped.vertices[1] +
                                                       wrapped.vertices[2] + wrapped.vertices[3]);
    CHECK(std::fabs(windingNumber(wrapped, middle - points[0])) > 0.4);
    const auto fan = convexFanAround(points);
    REQUIRE(fan);
    for (std::size_t f = 0; f < fan->normals.size(); ++f) {
      double highest = -1e300;
      for (const Eigen::Vector3d& p : points) {
        highest = std::max(highest, fan->normals[f].dot(p - fan->centre));
      }
      CHECK(highest <= fan->offsets[f]);
      CHECK(highest >= fan->offsets[f] - fan->depths[f]);
    }
    for (const ConvexPolytope::Face& face : hull.faces) {
      double nearest = 1e300;
      for (const Eigen::Vector3d& n : fan->normals) {
        nearest = std::min(nearest, (n - face.normal).norm());
      }
      CHECK(nearest < 1e-8);
    }
  }
  CHECK(given_up <= 2);
}

// What is within a patch's hull is within the solid: by winding numbers.
TEST_CASE("hulls of patches are within the solid", "[patches]") {
  RandomBodies random(32);
  int patches_found = 0;
  for (int scene = 0; scene < 80; ++scene) {
    const TriangleMesh mesh = hardMesh(scene, random);
    PatchesOfMesh lazy;
    const MeshPatches* const found = lazy.of([&] { return mesh; });
    if (!found) continue;
    std::set<int> held;
    const auto triangles = static_cast<int>(mesh.triangles.size());
    for (const MeshPatch& patch : found->patches) {
      ++patches_found;
      CHECK(patch.pieces.size() > 1);
      const auto hasCorner = [&](const Eigen::Vector3d& v) {
        return std::any_of(patch.vertices.begin(), patch.vertices.end(),
                           [&](int each) { return mesh.vertices[each] == v; });
      };
      for (const int piece : patch.pieces) {
        CHECK(held.insert(piece).second);
        if (piece < triangles) {
          for (int k = 0; k < 3; ++k) CHECK(hasCorner(mesh.vertices[mesh.triangles[piece][k]]));
        } else {
          for (const int v : found->polygons[piece - triangles].corners) {
            CHECK(hasCorner(mesh.vertices[v]));
          }
        }
      }
      for (int i = 0; i < 3; ++i) {
        Eigen::Vector3d point = Eigen::Vector3d::Zero();
        double sum = 0.0;
        for (const int v : patch.vertices) {
          const double weight = random.uniform(0.0, 1.0) + 1e-3;
          point += weight * mesh.vertices[v];
          sum += weight;
        }
        point = patch.fan.centre + (1 - 1e-6) * (point / sum - patch.fan.centre);
        CAPTURE(scene, patch.pieces.size());
        CHECK(std::fabs(windingNumber(mesh, point)) > 0.5);
      }
    }
  }
  CHECK(patches_found > 500);
}

TEST_CASE("what is open has no patches", "[patches]") {
  TriangleMesh open = bumpyMesh(0.4, 8, 12, 1);
  PatchesOfMesh whole, part;
  CHECK(whole.of([&] { return open; }));
  open.triangles.pop_back();
  CHECK_FALSE(part.of([&] { return open; }));
}

// Points are held against the hull of the Minkowski sum by Qhull.
TEST_CASE("the planes of P ⊕ a patch hold it, and what is within their margins", "[patches]") {
  RandomBodies random(33);
  int inside = 0;
  int outside = 0;
  for (int scene = 0; scene < 24; ++scene) {
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(4, 40), 1.0));
    const TriangleMesh other = scene % 4 == 0 ? boxMesh({1.0, 0.7, 0.5})
                                              : bumpyMesh(random.logUniform(0.1, 2.0), 6, 8,
                                                          static_cast<std::uint64_t>(scene));
    const bool body_is_a = scene % 2 == 0;
    const WhitenedMeshes meshes(body_is_a ? body : other, body_is_a ? other : body);
    const auto& tree = body_is_a ? meshes.tree_a : meshes.tree_b;
    const auto& other_tree = body_is_a ? meshes.tree_b : meshes.tree_a;
    const Eigen::Matrix3d linear = meshes.whitening.matrix();
    const PatchedMesh pieces(body_is_a ? meshes.pair.b : meshes.pair.a, meshes.objectOf(!body_is_a),
                             linear, PatchUse{});
    FatObstacles obstacles(meshes.pair, tree->parts[0], *tree->parts[0].fan, body_is_a, linear,
                           pieces);
    const Eigen::Vector3d apart_by =
        meshes.tree_b->parts[0].origin - meshes.tree_a->parts[0].origin;
    const int places = pieces.pieceCount() - pieces.triangleCount();
    for (int patch = 0; patch < std::min(6, places); ++patch) {
      const int piece = pieces.pieceCount() - 1 - patch;
      obstacles.faceOffsets(piece);
      std::vector<ObstaclePlane> planes = obstacles.otherPlanes(piece);
      if (obstacles.hasFailed(piece)) continue;
      for (int f = 0; f < obstacles.faceCount(); ++f) {
        planes.push_back(obstacles.planesOf(piece)[f]);
      }
      std::vector<Eigen::Vector3d> sum;
      pieces.visitCorners(piece, [&](int v) {
        for (const Eigen::Vector3d& of_body : tree->vertices) {
          const Eigen::Vector3d& of_other = other_tree->vertices[v];
          sum.push_back(apart_by + (body_is_a ? of_other - of_body : of_body - of_other));
        }
      });
      const ConvexPolytope hull = fcl_prob::convexHull(sum);
      for (int i = 0; i < 60; ++i) {
        const auto vertex =
            static_cast<std::size_t>(random.integer(0, static_cast<int>(hull.vertices.size()) - 1));
        const Eigen::Vector3d y =
            random.uniform(0.8, 1.1) * hull.vertices[vertex] + 0.2 * random.normalVector();
        double height = -1e300;
        for (const ConvexPolytope::Face& face : hull.faces) {
          height = std::max(height, face.normal.dot(y) - face.offset);
        }
        double outer = -1e300;
        double inner = -1e300;
        for (const ObstaclePlane& plane : planes) {
          outer = std::max(outer, plane.n.dot(linear * y) - plane.outer);
          inner = std::max(inner, plane.n.dot(linear * y) - plane.inner());
        }
        CAPTURE(scene, patch, height, outer, inner);
        if (height < -1e-9) CHECK(outer <= 0.0);
        if (height < -1e-5) CHECK(inner <= 0.0);
        if (inner <= 0.0) CHECK(height <= 1e-9);
        inside += inner <= 0.0;
        outside += outer > 0.0;
      }
    }
  }
  CHECK(inside > 500);
  CHECK(outside > 500);
}

namespace {

void checkPatchedScenes(int scenes, int samples, unsigned seed) {
  RandomBodies random(seed);
  int patched = 0;
  for (int i = 0; i < scenes; ++i) {
    // Small ones fit into the other mesh, where its surface is all that counts.
    const double size = random.logUniform(0.03, 0.3);
    const TriangleMesh body = hullMesh(random.onSphere(random.integer(6, 60), size));
    TriangleMesh other = hardMesh(i, random);
    if (i % 9 == 8) other.triangles.pop_back();
    const bool solid = i % 3 == 0 && i % 9 != 8;
    const bool swapped = i % 4 == 1;
    RandomBodies draws(1000 + seed + static_cast<unsigned>(i));
    INFO("scene " << i);
    const ProbabilityResult result = fcl_prob_test::checkedInterval(
        {body, other, swapped, solid, 0.0, 0.6, 0.02, 0.15, 0.01}, random, samples, draws);
    patched += fcl_prob_test::planMentions(result, "convex patches");
  }
  CHECK(patched > scenes / 4);
}

}  // namespace

TEST_CASE("intervals by patches hold sampled probabilities on random scenes", "[patches][random]") {
  checkPatchedScenes(60, 1'500, 34);
}

TEST_CASE("intervals by patches hold sampled probabilities on 5,000 scenes",
          "[patches][random][long]") {
  checkPatchedScenes(5'000, 3'000, 35);
}

TEST_CASE("patches can be left out, and count as memory", "[patches]") {
  const TriangleMesh body = hullMesh(RandomBodies(3).onSphere(30, 0.3));
  PartitionQuery query(body, bumpyMesh(0.5, 20, 30, 1));
  query.pose_b.translation() = Eigen::Vector3d(0.75, 0.1, 0.0);
  const auto displacement =
      fcl_prob::GaussianDisplacement::fromStandardDeviations({0.05, 0.08, 0.1}, {1, 0, 0, 0});
  fcl_prob::ProbabilityRequest request = fcl_prob_test::intervalRequest(0.01);
  const PieceTree& tree = *query.b().tree;
  const std::size_t of_patches = tree.patchesOf(tree.parts[0])->memory();
  const ProbabilityResult with = query.run(displacement, request);
  CHECK(fcl_prob_test::planMentions(with, ": of its "));
  CHECK(with.statistics.peak_memory > of_patches);
  CHECK(of_patches <= MeshPatches::mostMemory(tree.triangles.size()));

  SECTION("as asked") {
    request.patches = false;
    const ProbabilityResult without = query.run(displacement, request);
    CHECK(fcl_prob_test::planMentions(without, "patches left out, as asked"));
    CHECK_FALSE(fcl_prob_test::planMentions(without, ": of its "));
    CHECK(*without.lower <= *with.upper);
    CHECK(*without.upper >= *with.lower);
  }
  SECTION("for want of memory") {
    request.max_memory = 3 * MeshPatches::mostMemory(tree.triangles.size());
    const ProbabilityResult without = query.run(displacement, request);
    CHECK(fcl_prob_test::planMentions(without, "patches left out, for want of memory"));
    CHECK(*without.lower <= *with.upper);
    CHECK(*without.upper >= *with.lower);
  }
}
