// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "random_shape.h"

#include <cmath>
#include <set>

namespace fcl_prob_audit {
namespace {

/// Multiples of an eighth of the size.
double onGrid(RandomBodies& random, double size) { return size * random.integer(1, 8) / 8.0; }

Vector3d randomSizes(RandomBodies& random, const Traits& traits, double size) {
  const bool grid = chance(random, traits.on_grid);
  Vector3d sizes;
  for (int k = 0; k < 3; ++k) {
    sizes[k] = grid ? onGrid(random, size) : size * random.uniform(0.2, 1.0);
  }
  if (chance(random, traits.thin)) {
    const int axis = random.integer(0, 2);
    sizes[axis] = size * random.logUniform(1e-9, 1e-2);
    if (chance(random, 0.3)) sizes[(axis + 1) % 3] = size * random.logUniform(1e-9, 1e-2);
  }
  return sizes;
}

void makeVoxels(RandomBodies& random, double size, Shape& shape) {
  shape.resolution = std::ldexp(1.0, static_cast<int>(std::floor(std::log2(size))) - 2);
  std::set<std::array<int, 3>> known;
  const int count = random.integer(1, 8);
  const int reach = chance(random, 0.3) ? 200 : 3;
  for (int i = 0; i < count; ++i) {
    const std::array<int, 3> index = {random.integer(-reach, reach), random.integer(-reach, reach),
                                      random.integer(-reach, reach)};
    if (known.insert(index).second) shape.voxels.push_back({index, i == 0 || chance(random, 0.7)});
  }
}

void scatterOccupancy(RandomBodies& random, Shape& shape) {
  const std::vector<double> values = {0.0, 0.1, 0.3, 0.5, 0.7, 1.0};
  shape.cost_density = anyOf(random, values);
  shape.threshold_occupied = anyOf(random, values);
  // Below the other, so that nothing is both free and occupied.
  shape.threshold_free = std::min(anyOf(random, values), 0.5 * shape.threshold_occupied) - 0.01;
}

Vector3d onTriangle(RandomBodies& random, const TriangleMesh& mesh) {
  const fcl::Triangle& t = anyOf(random, mesh.triangles);
  double u = random.uniform(0, 1), v = random.uniform(0, 1);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  if (chance(random, 0.15)) u = 0.0;
  const Vector3d &p = mesh.vertices[t[0]], &q = mesh.vertices[t[1]], &r = mesh.vertices[t[2]];
  return p + u * (q - p) + v * (r - p);
}

Vector3d inOctree(RandomBodies& random, const Shape& shape, double reach) {
  const Voxel& voxel = shape.voxels[0];
  Vector3d p;
  for (int k = 0; k < 3; ++k) {
    const int at = voxel.index[static_cast<std::size_t>(k)];
    p[k] = shape.resolution * (at + 0.5 + reach * random.uniform(-0.5, 0.5));
  }
  return p;
}

}  // namespace

bool chance(RandomBodies& random, double probability) {
  return random.uniform(0.0, 1.0) < probability;
}

Shape randomShape(RandomBodies& random, const Traits& traits, Kind kind, double size) {
  Shape shape;
  shape.kind = kind;
  shape.sizes = randomSizes(random, traits, size);
  shape.tree = static_cast<Tree>(chance(random, 0.5) ? 3 : random.integer(0, kTrees - 1));
  switch (kind) {
    case Kind::mesh:
      shape.mesh = randomMesh(random, traits.mesh);
      // By a power of two, which keeps coordinates on their grid.
      scaleShape(shape, std::ldexp(1.0, static_cast<int>(std::round(std::log2(size)))));
      break;
    case Kind::convex:
      shape.mesh = hullMesh(random.onSphere(random.integer(4, 9), 0.5 * size));
      break;
    case Kind::triangle:
      for (int k = 0; k < 3; ++k) shape.mesh.vertices.push_back(0.5 * size * random.direction());
      shape.mesh.triangles = {{0, 1, 2}};
      break;
    case Kind::octree:
      makeVoxels(random, size, shape);
      break;
    case Kind::halfspace:
    case Kind::plane:
      shape.normal = chance(random, traits.aligned) ? Vector3d(Vector3d::UnitZ())
                                                    : Vector3d(random.direction());
      shape.offset = size * random.uniform(-1, 1);
      break;
    default:
      shape.sizes *= 0.5;
      if (kind == Kind::box) shape.sizes *= 2.0;
      break;
  }
  if (chance(random, traits.occupancy)) scatterOccupancy(random, shape);
  return shape;
}

Vector3d pointOf(RandomBodies& random, const Shape& shape) {
  const Vector3d& size = shape.sizes;
  Vector3d p = random.direction();
  switch (shape.kind) {
    case Kind::box: {
      for (int k = 0; k < 3; ++k) p[k] = random.uniform(-0.5, 0.5) * size[k];
      const int face = random.integer(0, 2);
      p[face] = 0.5 * (p[face] < 0 ? -size[face] : size[face]);
      return p;
    }
    case Kind::sphere:
      return size[0] * p;
    case Kind::ellipsoid:
      return size.cwiseProduct(p);
    case Kind::capsule:
      return size[0] * p + Vector3d(0, 0, (p[2] < 0 ? -0.5 : 0.5) * size[1]);
    case Kind::cylinder:
      return {size[0] * p[0], size[0] * p[1], random.uniform(-0.5, 0.5) * size[1]};
    case Kind::cone:
      return {0, 0, random.uniform(-0.5, 0.5) * size[1]};
    case Kind::halfspace:
    case Kind::plane:
      return shape.normal * shape.offset + shape.normal.cross(p);
    case Kind::octree:
      return inOctree(random, shape, 1.0);
    default:
      return onTriangle(random, shape.mesh);
  }
}

Vector3d middleOf(RandomBodies& random, const Shape& shape) {
  if (shape.kind == Kind::octree) return inOctree(random, shape, 0.0);
  if (shape.kind != Kind::mesh && shape.kind != Kind::convex) return Vector3d::Zero();
  // Between points of a few triangles that follow each other: most often of one shell.
  const auto& triangles = shape.mesh.triangles;
  const int first = random.integer(0, static_cast<int>(triangles.size()) - 1);
  const int last = std::min(first + 8, static_cast<int>(triangles.size()));
  Vector3d sum = Vector3d::Zero();
  for (int i = first; i < last; ++i) {
    sum += shape.mesh.vertices[triangles[static_cast<std::size_t>(i)][0]];
  }
  return sum / (last - first);
}

Matrix3d randomOrientation(RandomBodies& random, const Traits& traits) {
  Matrix3d rotation = random.rotation();
  if (chance(random, traits.aligned)) {
    rotation.setIdentity();
    const int turn = random.integer(0, 2);
    if (chance(random, 0.5)) {
      rotation.col(0) = Vector3d::Unit(turn);
      rotation.col(1) = Vector3d::Unit((turn + 1) % 3);
      rotation.col(2) = Vector3d::Unit((turn + 2) % 3);
    }
  }
  if (chance(random, traits.near_rotation)) {
    Matrix3d off;
    for (int k = 0; k < 9; ++k) off(k) = random.uniform(-1, 1);
    rotation += random.logUniform(1e-13, 3e-10) * off;
  }
  return rotation;
}

Displacement randomDisplacement(RandomBodies& random, const Traits& traits, double size) {
  Displacement result;
  const double largest = size * random.logUniform(traits.least_ratio, traits.most_ratio);
  const int rank = anyOf(random, traits.ranks);
  const int offset = random.integer(0, 2);
  const double condition = random.uniform(0.0, traits.condition);
  for (int k = 0; k < 3; ++k) {
    const double decades = k == 0 ? 0.0 : condition * random.uniform(0.0, 1.0);
    result.sigma[(k + offset) % 3] = k < rank ? largest * std::pow(10.0, -decades) : 0.0;
  }
  if (chance(random, 0.2) && traits.condition <= 1.0 && rank == 3) {
    result.sigma.setConstant(largest);
  }
  if (!chance(random, traits.aligned)) result.axes = random.quaternion();
  if (chance(random, traits.with_mean)) {
    result.mean = size * random.uniform(0.0, 2.0) * random.direction();
  }
  if (chance(random, traits.near_rotation)) {
    result.rotated = randomOrientation(random, traits);
  } else if (chance(random, traits.by_matrix)) {
    result.by_matrix = true;
  }
  return result;
}

void scaleShape(Shape& shape, double factor) {
  shape.sizes *= factor;
  for (Vector3d& v : shape.mesh.vertices) v *= factor;
  shape.offset *= factor;
  shape.resolution *= factor;
}

void scaleScene(Scene& scene, int exponent) {
  const double factor = std::ldexp(1.0, exponent);
  for (auto* group : {&scene.a, &scene.b}) {
    for (Member& member : *group) {
      scaleShape(member.shape, factor);
      member.pose.translation() *= factor;
    }
  }
  for (Displacement& displacement : scene.displacements) {
    displacement.sigma *= factor;
    displacement.mean *= factor;
  }
}

}  // namespace fcl_prob_audit
