// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex bodies beside closed meshes that are hard to close in on: against displaced fcl::collide.
#include <algorithm>
#include <utility>

#include "catch.h"
#include "dented_mesh.h"
#include "random_bodies.h"
#include "sampled_contact.h"

namespace {

using fcl_prob::ProbabilityResult;
using fcl_prob::TriangleMesh;
using fcl_prob_test::boxMesh;
using fcl_prob_test::bumpyMesh;
using fcl_prob_test::hullMesh;
using fcl_prob_test::RandomBodies;
using fcl_prob_test::sphereMesh;
using fcl_prob_test::torusMesh;

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

/// Shells with dents, cavities and bodies that touch the shell from inside,
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

void checkHardShells(int scenes, int samples, unsigned seed) {
  RandomBodies random(seed);
  int whole = 0;
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
    whole += fcl_prob_test::planMentions(result, "is convex: one piece");
  }
  CHECK(whole > scenes / 4);
}

}  // namespace

TEST_CASE("intervals beside hard shells hold sampled probabilities", "[carving][random]") {
  checkHardShells(60, 1'500, 34);
}

TEST_CASE("intervals beside hard shells hold sampled probabilities on 5,000 scenes",
          "[carving][random][long]") {
  checkHardShells(5'000, 3'000, 35);
}
