// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "random_mesh.h"

#include <cmath>

#include "fcl_prob/convex_polytope.h"
#include "mesh_shapes.h"
#include "random_shape.h"

namespace fcl_prob_audit {
namespace {

using Eigen::Vector3d;
using namespace fcl_prob_test;

/// An L of two boxes in one surface: twelve vertices, not convex.
TriangleMesh angleMesh(double width) {
  const double w = width;
  const std::vector<Eigen::Vector2d> outline = {{-0.5, -0.5},    {0.5, -0.5},
                                                {0.5, -0.5 + w}, {-0.5 + w, -0.5 + w},
                                                {-0.5 + w, 0.5}, {-0.5, 0.5}};
  TriangleMesh mesh;
  for (const double z : {-0.25, 0.25}) {
    for (const auto& p : outline) mesh.vertices.push_back({p[0], p[1], z});
  }
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t j = (i + 1) % 6;
    mesh.triangles.emplace_back(i, j, j + 6);
    mesh.triangles.emplace_back(i, j + 6, i + 6);
  }
  // Fans around the inner corner.
  for (std::size_t i = 4; i < 8; ++i) {
    const std::size_t p = i % 6, q = (i + 1) % 6;
    mesh.triangles.emplace_back(3, q, p);
    mesh.triangles.emplace_back(9, p + 6, q + 6);
  }
  return mesh;
}

TriangleMesh tetrahedronMesh(RandomBodies& random) {
  TriangleMesh mesh;
  for (int i = 0; i < 4; ++i) mesh.vertices.push_back(0.5 * random.direction());
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

/// A prism or a pyramid: faces of many corners.
TriangleMesh drumMesh(RandomBodies& random) {
  const int sides = random.integer(3, 12);
  const double top = chance(random, 0.3) ? 0.0 : random.uniform(0.1, 0.5);
  std::vector<Vector3d> points;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * M_PI * i / sides;
    const Eigen::Vector2d p(std::cos(angle), std::sin(angle));
    points.emplace_back(0.5 * p[0], 0.5 * p[1], -0.3);
    points.emplace_back(top * p[0], top * p[1], 0.3);
  }
  return hullMesh(points);
}

TriangleMesh convexShell(RandomBodies& random, const MeshStructure& structure) {
  TriangleMesh mesh;
  switch (random.integer(0, 3)) {
    case 0:
      mesh = drumMesh(random);
      break;
    case 1:
      mesh = boxMesh({random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)});
      break;
    default:
      mesh = hullMesh(random.onSphere(random.integer(4, 30), 0.5));
  }
  if (chance(random, structure.dented)) {
    const int last = static_cast<int>(mesh.vertices.size()) - 1;
    mesh.vertices[random.integer(0, last)] += random.logUniform(1e-12, 0.2) * random.direction();
  }
  return mesh;
}

/// So many triangles that trees have levels, and that the library looks for vertices that are
/// inside.
TriangleMesh largeShell(RandomBodies& random) {
  switch (random.integer(0, 2)) {
    case 0:
      return bumpyMesh(0.5, random.integer(15, 22), random.integer(20, 25),
                       static_cast<std::uint64_t>(random.integer(1, 1 << 20)));
    case 1:
      return torusMesh(0.4, random.uniform(0.05, 0.2), random.integer(32, 40),
                       random.integer(8, 13));
    default:
      return sphereMesh(0.5, random.integer(15, 20), random.integer(20, 25));
  }
}

TriangleMesh anyShell(RandomBodies& random, const MeshStructure& structure) {
  // Nothing is drawn for families without: their scenes stay what they are.
  if (structure.large > 0.0 && chance(random, structure.large)) return largeShell(random);
  if (chance(random, structure.convex)) return convexShell(random, structure);
  switch (random.integer(0, 6)) {
    case 0:
      return tetrahedronMesh(random);
    case 1:
      return angleMesh(random.uniform(0.2, 0.8));
    case 2:
      return bumpyMesh(0.5, 3, 4, static_cast<std::uint64_t>(random.integer(1, 1 << 20)));
    case 3:
      return torusMesh(0.4, 0.1, 4, 3);
    case 4:
      return hullMesh(random.onSphere(random.integer(4, 8), 0.5));
    default:
      return boxMesh({random.uniform(0.3, 1), random.uniform(0.3, 1), random.uniform(0.3, 1)});
  }
}

void flatten(RandomBodies& random, const MeshStructure& structure, TriangleMesh& shell) {
  if (!chance(random, structure.thin)) return;
  const int axis = random.integer(0, 2);
  const double factor =
      chance(random, structure.flat) ? 0.0 : random.logUniform(structure.least_thinness, 0.1);
  for (Vector3d& v : shell.vertices) v[axis] *= factor;
}

void openShell(RandomBodies& random, TriangleMesh& shell) {
  const int lacking = random.integer(1, std::max(1, static_cast<int>(shell.triangles.size()) / 2));
  for (int i = 0; i < lacking && shell.triangles.size() > 1; ++i) {
    const auto at = random.integer(0, static_cast<int>(shell.triangles.size()) - 1);
    shell.triangles.erase(shell.triangles.begin() + at);
  }
}

void move(TriangleMesh& mesh, double scale, const Vector3d& by, const Eigen::Matrix3d& rotation,
          int bits) {
  for (Vector3d& v : mesh.vertices) v = snapped(scale * (rotation * v) + by, bits);
}

Vector3d strayPosition(RandomBodies& random, const MeshStructure& structure) {
  const double reach = chance(random, structure.stray_far) ? random.logUniform(2, 1e4) : 0.8;
  return snapped(reach * random.direction() * random.uniform(0.1, 1.0));
}

void addDegenerate(RandomBodies& random, const MeshStructure& structure, TriangleMesh& mesh) {
  if (chance(random, structure.stray_point)) {
    const std::size_t at = mesh.vertices.size();
    mesh.vertices.push_back(strayPosition(random, structure));
    mesh.triangles.emplace_back(at, at, at);
  }
  if (!chance(random, structure.degenerate)) return;
  const std::size_t at = mesh.vertices.size();
  const Vector3d p = strayPosition(random, structure), q = snapped(0.3 * random.direction());
  switch (random.integer(0, 3)) {
    case 0:  // a segment: two corners are one
      mesh.vertices.push_back(p);
      mesh.vertices.push_back(p + q);
      mesh.triangles.emplace_back(at, at + 1, at);
      return;
    case 1:  // a sheet of two sides
      mesh.vertices.push_back(p);
      mesh.vertices.push_back(p + q);
      mesh.vertices.push_back(p + snapped(0.3 * random.direction()));
      mesh.triangles.emplace_back(at, at + 1, at + 2);
      mesh.triangles.emplace_back(at, at + 2, at + 1);
      return;
    case 2:  // three corners on a line, walked both ways
      mesh.vertices.push_back(p);
      mesh.vertices.push_back(p + q);
      mesh.vertices.push_back(p + 2.0 * q);
      mesh.triangles.emplace_back(at, at + 1, at + 2);
      mesh.triangles.emplace_back(at, at + 2, at + 1);
      return;
    default:  // a vertex of its own that no triangle uses, and one triangle twice, both ways
      mesh.vertices.push_back(p);
      const fcl::Triangle t = mesh.triangles[0];
      mesh.triangles.emplace_back(t[0], t[1], t[2]);
      mesh.triangles.emplace_back(t[0], t[2], t[1]);
  }
}

}  // namespace

Vector3d snapped(const Vector3d& v, int bits) {
  return Vector3d(std::nearbyint(std::ldexp(v[0], bits)), std::nearbyint(std::ldexp(v[1], bits)),
                  std::nearbyint(std::ldexp(v[2], bits))) *
         std::ldexp(1.0, -bits);
}

TriangleMesh hullMesh(const std::vector<Vector3d>& points) {
  const fcl_prob::ConvexPolytope hull = fcl_prob::convexHull(points);
  TriangleMesh mesh;
  mesh.vertices = hull.vertices;
  for (const auto& face : hull.faces) {
    for (std::size_t i = 2; i < face.vertices.size(); ++i) {
      mesh.triangles.emplace_back(static_cast<std::size_t>(face.vertices[0]),
                                  static_cast<std::size_t>(face.vertices[i - 1]),
                                  static_cast<std::size_t>(face.vertices[i]));
    }
  }
  return mesh;
}

TriangleMesh randomMesh(RandomBodies& random, const MeshStructure& structure) {
  const int shells = random.integer(1, structure.most_shells);
  TriangleMesh mesh;
  double size = 1.0;
  Vector3d at = Vector3d::Zero();
  for (int i = 0; i < shells; ++i) {
    TriangleMesh shell = anyShell(random, structure);
    if (i > 0 && chance(random, structure.nested)) {
      size *= random.uniform(0.1, 0.5);
    } else if (i > 0) {
      size = random.uniform(0.2, 1.0);
      at = random.direction() * (chance(random, structure.far_shell) ? random.logUniform(2, 1e3)
                                                                     : random.uniform(0.2, 1.5));
    }
    const bool rotated = chance(random, 0.5);
    const Eigen::Matrix3d rotation = random.rotation();
    // Faces of more than three corners stay flat to what files round them by.
    move(shell, size, at, rotated ? rotation : Eigen::Matrix3d::Identity(),
         structure.convex > 0.0 ? 40 : 20);
    flatten(random, structure, shell);
    if (chance(random, structure.inside_out)) shell = reversed(shell);
    if (chance(random, structure.open)) openShell(random, shell);
    mesh = i == 0 ? shell : joined(mesh, shell);
  }
  addDegenerate(random, structure, mesh);
  return mesh;
}

}  // namespace fcl_prob_audit
