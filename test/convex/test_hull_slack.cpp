// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a hull leaves out is no farther from it than it says, by the supports of both.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "convex/convex_mesh.h"

namespace {

using fcl_prob::detail::ConvexMesh;
using Points = std::vector<Eigen::Vector3d>;

/// Points in a body of these widths whose last two may be hardly anything, a wedge or a box, with
/// many on its faces, turned and put somewhere.
Points thinPoints(std::mt19937_64& random, const Eigen::Vector3d& widths, bool wedge) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond(uniform(random), uniform(random), uniform(random), uniform(random))
          .normalized()
          .toRotationMatrix();
  const Eigen::Vector3d at(uniform(random), 10 * uniform(random), uniform(random));
  Points points;
  for (int i = 0; i < 80; ++i) {
    Eigen::Vector3d p(uniform(random), uniform(random), uniform(random));
    if (i % 4 != 0) p[i % 3] = p[i % 3] > 0 ? 1.0 : -1.0;
    if (i % 8 == 1) p = p.cwiseSign();
    if (wedge) p[2] *= 0.5 * (1.0 - p[0]);
    points.emplace_back(turn * p.cwiseProduct(widths) + at);
  }
  return points;
}

long double along(const Eigen::Vector3d& u, const Eigen::Vector3d& p) {
  long double sum = 0.0L;
  for (int k = 0; k < 3; ++k) sum += static_cast<long double>(u[k]) * p[k];
  return sum;
}

long double support(const Points& points, const Eigen::Vector3d& u) {
  long double highest = along(u, points.front());
  for (const Eigen::Vector3d& p : points) highest = std::max(highest, along(u, p));
  return highest;
}

/// Any, those between the normals of two faces, and beside the normals of faces.
Eigen::Vector3d someDirection(const ConvexMesh& mesh, std::mt19937_64& random, int i) {
  std::normal_distribution<double> normal;
  Eigen::Vector3d u(normal(random), normal(random), normal(random));
  if (i % 3 == 0 || mesh.faces.empty()) return u.normalized();
  const auto face = [&] { return mesh.faces[random() % mesh.faces.size()].normal; };
  if (i % 3 == 1) return (face() + face() + 1e-12 * u).normalized();
  return (face() + 1e-9 * u).normalized();
}

}  // namespace

TEST_CASE("points that a hull leaves out are within its slack") {
  std::mt19937_64 random(4);
  int without_faces = 0, with_slack = 0;
  for (int i = 0; i < 300; ++i) {
    const double thin = std::pow(10.0, -(i % 17));
    const double thinner = i % 2 == 0 ? 1.0 : thin;
    const Points points = thinPoints(random, {1.0, thinner, thin}, i % 3 == 0);
    const ConvexMesh mesh = fcl_prob::detail::makeConvexMesh(points);
    without_faces += mesh.faces.size() < 3;
    with_slack += mesh.slack > 0.0;
    REQUIRE(mesh.slack >= 0.0);
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d u = someDirection(mesh, random, k);
      CAPTURE(i, thin, thinner, mesh.slack, u.transpose());
      const auto missing = static_cast<double>(support(points, u) - support(mesh.vertices, u));
      CHECK(missing <= mesh.slack);
    }
    // No more than rounding where the body is as long as it is wide.
    if (thin == 1.0) CHECK(mesh.slack < 1e-13);
  }
  CHECK(without_faces > 20);
  CHECK(with_slack > 100);
}
