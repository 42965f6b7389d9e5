// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mesh_shapes.h"

#include <cmath>
#include <random>

#include "fcl_prob/convex_polytope.h"

namespace fcl_prob_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A sphere-like grid whose radius is `radiusAt(ring, segment)`; the poles are rings 0 and `rings`.
template <typename RadiusAt>
TriangleMesh latitudeLongitudeMesh(int rings, int segments, RadiusAt radiusAt) {
  TriangleMesh mesh;
  mesh.vertices.push_back({0, 0, radiusAt(0, 0)});
  for (int i = 1; i < rings; ++i) {
    for (int j = 0; j < segments; ++j) {
      const double theta = kPi * i / rings;
      const double phi = 2 * kPi * j / segments;
      mesh.vertices.push_back(radiusAt(i, j) * Eigen::Vector3d(std::sin(theta) * std::cos(phi),
                                                               std::sin(theta) * std::sin(phi),
                                                               std::cos(theta)));
    }
  }
  mesh.vertices.push_back({0, 0, -radiusAt(rings, 0)});
  const auto last = static_cast<std::size_t>(mesh.vertices.size() - 1);
  const auto at = [segments](int i, int j) {
    return static_cast<std::size_t>(1 + (i - 1) * segments + j % segments);
  };
  for (int j = 0; j < segments; ++j) {
    mesh.triangles.emplace_back(0, at(1, j), at(1, j + 1));
    for (int i = 1; i + 1 < rings; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
    mesh.triangles.emplace_back(at(rings - 1, j), last, at(rings - 1, j + 1));
  }
  return mesh;
}

}  // namespace

TriangleMesh boxMesh(const Eigen::Vector3d& sides) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) ? 0.5 : -0.5, (corner & 2) ? 0.5 : -0.5,
                               (corner & 4) ? 0.5 : -0.5);
    mesh.vertices.push_back(sides.cwiseProduct(sign));
  }
  const std::size_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads) {
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
  }
  return mesh;
}

TriangleMesh sphereMesh(double radius, int rings, int segments) {
  return latitudeLongitudeMesh(rings, segments, [radius](int, int) { return radius; });
}

TriangleMesh bumpyMesh(double radius, int rings, int segments, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> factor(0.7, 1.3);
  return latitudeLongitudeMesh(rings, segments,
                               [&](int, int) { return radius * factor(generator); });
}

TriangleMesh torusMesh(double radius, double tube_radius, int segments, int tube_segments) {
  TriangleMesh mesh;
  for (int i = 0; i < segments; ++i) {
    for (int j = 0; j < tube_segments; ++j) {
      const double phi = 2 * kPi * i / segments;
      const double psi = 2 * kPi * j / tube_segments;
      const double distance = radius + tube_radius * std::cos(psi);
      mesh.vertices.push_back(
          {distance * std::cos(phi), distance * std::sin(phi), tube_radius * std::sin(psi)});
    }
  }
  const auto at = [=](int i, int j) {
    return static_cast<std::size_t>((i % segments) * tube_segments + j % tube_segments);
  };
  for (int i = 0; i < segments; ++i) {
    for (int j = 0; j < tube_segments; ++j) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh mesh = a;
  const std::size_t offset = a.vertices.size();
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) {
    mesh.triangles.emplace_back(t[0] + offset, t[1] + offset, t[2] + offset);
  }
  return mesh;
}

TriangleMesh transformed(TriangleMesh mesh, const Eigen::Isometry3d& pose) {
  for (auto& vertex : mesh.vertices) vertex = pose * vertex;
  return mesh;
}

TriangleMesh reversed(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) t = fcl::Triangle(t[0], t[2], t[1]);
  return mesh;
}

TriangleMesh hullMesh(const std::vector<Eigen::Vector3d>& points) {
  const fcl_prob::ConvexPolytope hull = fcl_prob::convexHull(points);
  TriangleMesh mesh;
  for (const Eigen::Vector3d& v : hull.vertices) mesh.vertices.push_back(v);
  for (const fcl_prob::ConvexPolytope::Face& face : hull.faces) {
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      mesh.triangles.emplace_back(face.vertices[0], face.vertices[i - 1], face.vertices[i]);
    }
  }
  return mesh;
}

}  // namespace fcl_prob_test
