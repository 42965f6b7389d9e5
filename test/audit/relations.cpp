// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "relations.h"

#include <cmath>

#include "mesh_shapes.h"
#include "random_shape.h"

namespace fcl_prob_audit {
namespace {

using Choice = std::uint64_t;
using Derived = std::optional<Scene>;
using fcl_prob::ContactMeaning;
using fcl_prob::ProbabilityMethod;

bool isPair(const Scene& scene) { return scene.question == Question::pair; }

/// What one of the partition's methods answers, and can be asked of a group.
bool takesGroups(const Scene& scene) {
  const auto method = scene.request.method;
  const bool plain = scene.question == Question::group ||
                     (isPair(scene) && scene.weights.empty() && !scene.truncation);
  return plain && (method == ProbabilityMethod::automatic || method == ProbabilityMethod::interval);
}

/// Neither decomposed nor rotated by the library: exactly what the deviations and axes say.
bool isPlain(const Scene& scene) {
  for (const Displacement& displacement : scene.displacements) {
    if (displacement.by_matrix || displacement.rotated) return false;
  }
  return true;
}

Derived swapped(const Scene& scene, Choice) {
  Scene result = scene;
  std::swap(result.a, result.b);
  for (Displacement& displacement : result.displacements) displacement.mean *= -1.0;
  return result;
}

Derived inOrderReversed(const Scene& scene, Choice) {
  if (scene.question != Question::group) return std::nullopt;
  Scene result = scene;
  std::reverse(result.a.begin(), result.a.end());
  std::reverse(result.b.begin(), result.b.end());
  return result;
}

/// A power of two that keeps every length within what the library takes.
int exponentOf(Choice choice) { return static_cast<int>(choice % 81) - 40; }

Derived rescaled(const Scene& scene, Choice choice) {
  if (!isPlain(scene)) return std::nullopt;
  Scene result = scene;
  scaleScene(result, exponentOf(choice));
  double largest = 0.0, least = 1.0;
  for (const auto* group : {&result.a, &result.b}) {
    for (const Member& member : *group) {
      largest = std::max({largest, extentOf(member.shape), member.pose.translation().norm()});
      // Sizes and voxels that leave the normal numbers, or whose squares do, are another question.
      least = std::min(least, member.shape.sizes.minCoeff());
    }
  }
  for (const Displacement& displacement : result.displacements) {
    largest = std::max({largest, displacement.sigma.maxCoeff(), displacement.mean.norm()});
    for (int k = 0; k < 3; ++k) {
      if (displacement.sigma[k] > 0.0) least = std::min(least, displacement.sigma[k]);
    }
  }
  // Smaller scenes are refused.
  if (largest > 1e148 || largest < 1e-138 || least < 1e-250) return std::nullopt;
  return result;
}

Matrix3d rescaledGradient(Choice choice) {
  return std::ldexp(1.0, -exponentOf(choice)) * Matrix3d::Identity();
}

/// The world turned by a third of a turn, or a half: no number is rounded.
Matrix3d exactTurn(Choice choice) {
  Matrix3d cycle;
  cycle << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Matrix3d half = Vector3d(1, -1, -1).asDiagonal();
  Matrix3d result = Matrix3d::Identity();
  for (Choice i = 0; i < choice % 3; ++i) result = cycle * result;
  return choice % 2 == 0 ? result : Matrix3d(half * result);
}

/// The displacement in the turned world. Its axes are conjugated, which swaps and mirrors them, and
/// leaves all numbers as they are.
void turn(Displacement& displacement, const Matrix3d& q) {
  displacement.mean = q * displacement.mean;
  // The order of the deviations follows the axes.
  const Vector3d sigma = displacement.sigma;
  displacement.sigma = (q * sigma).cwiseAbs();
  displacement.axes.vec() = q.determinant() * (q * displacement.axes.vec());
}

/// Up to their order and signs.
bool sameAxes(const Matrix3d& x, const Matrix3d& y) {
  int matches = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matches += x.col(i) == y.col(j) || x.col(i) == -y.col(j);
  }
  return matches == 3;
}

Derived turnedWorld(const Scene& scene, Choice choice) {
  if (!isPlain(scene)) return std::nullopt;
  Scene result = scene;
  const Matrix3d q = exactTurn(choice);
  for (auto* group : {&result.a, &result.b}) {
    for (Member& member : *group) {
      member.pose.linear() = (q * member.pose.linear()).eval();
      member.pose.translation() = (q * member.pose.translation()).eval();
    }
  }
  for (Displacement& displacement : result.displacements) {
    const Matrix3d before = makeDisplacement(displacement).axes();
    turn(displacement, q);
    // The norm of the quaternion may be rounded in another order.
    if (!sameAxes(q * before, makeDisplacement(displacement).axes())) return std::nullopt;
  }
  return result;
}

Matrix3d mirror() { return Vector3d(-1, 1, 1).asDiagonal(); }

void mirrorShape(Shape& shape) {
  for (Vector3d& v : shape.mesh.vertices) v[0] = -v[0];
  if (shape.kind != Kind::triangle) shape.mesh = fcl_prob_test::reversed(shape.mesh);
  shape.normal[0] = -shape.normal[0];
  for (Voxel& voxel : shape.voxels) voxel.index[0] = -1 - voxel.index[0];
}

Derived mirrored(const Scene& scene, Choice) {
  if (!isPlain(scene)) return std::nullopt;
  Scene result = scene;
  const Matrix3d m = mirror();
  for (auto* group : {&result.a, &result.b}) {
    for (Member& member : *group) {
      mirrorShape(member.shape);
      member.pose.linear() = (m * member.pose.linear() * m).eval();
      member.pose.translation() = (m * member.pose.translation()).eval();
    }
  }
  for (Displacement& displacement : result.displacements) turn(displacement, m);
  return result;
}

bool addsExactly(double x, double y) {
  const double sum = x + y;
  return sum - y == x && sum - x == y;
}

/// Both objects moved alike.
Derived movedBoth(const Scene& scene, Choice choice) {
  Scene result = scene;
  double size = 0.0;
  for (const Member& member : scene.a) size = std::max(size, extentOf(member.shape));
  if (!(size > 0.0)) return std::nullopt;
  const double unit = std::exp2(std::floor(std::log2(size)) + static_cast<double>(choice % 24));
  const Vector3d by = unit * Vector3d(1.0, -2.0, static_cast<double>(choice % 5));
  for (auto* group : {&result.a, &result.b}) {
    for (Member& member : *group) {
      for (int k = 0; k < 3; ++k) {
        if (!addsExactly(member.pose.translation()[k], by[k])) return std::nullopt;
      }
      member.pose.translation() += by;
    }
  }
  return result;
}

/// Every triangle as four.
std::optional<TriangleMesh> refined(const TriangleMesh& mesh) {
  if (mesh.triangles.size() > 16) return std::nullopt;
  TriangleMesh result;
  result.vertices = mesh.vertices;
  bool exact = true;
  const auto middle = [&](std::size_t i, std::size_t j) {
    const Vector3d &p = mesh.vertices[i], &q = mesh.vertices[j];
    for (int k = 0; k < 3; ++k) {
      const double sum = p[k] + q[k];
      exact = exact && sum - p[k] == q[k] && sum - q[k] == p[k] && 0.5 * sum * 2.0 == sum;
    }
    result.vertices.push_back(0.5 * (p + q));
    return result.vertices.size() - 1;
  };
  for (const fcl::Triangle& t : mesh.triangles) {
    const std::size_t pq = middle(t[0], t[1]), qr = middle(t[1], t[2]), rp = middle(t[2], t[0]);
    result.triangles.emplace_back(t[0], pq, rp);
    result.triangles.emplace_back(pq, t[1], qr);
    result.triangles.emplace_back(rp, qr, t[2]);
    result.triangles.emplace_back(pq, qr, rp);
  }
  if (!exact) return std::nullopt;
  return result;
}

Derived refinedMeshes(const Scene& scene, Choice) {
  Scene result = scene;
  bool any = false;
  for (auto* group : {&result.a, &result.b}) {
    for (Member& member : *group) {
      if (member.shape.kind != Kind::mesh) continue;
      const auto mesh = refined(member.shape.mesh);
      if (!mesh) return std::nullopt;
      member.shape.mesh = *mesh;
      any = true;
    }
  }
  if (!any) return std::nullopt;
  return result;
}

/// The first mesh that has several triangles; its group.
std::vector<Member>* groupWithMesh(Scene& scene, std::size_t& at) {
  for (auto* group : {&scene.a, &scene.b}) {
    for (at = 0; at < group->size(); ++at) {
      const Shape& shape = (*group)[at].shape;
      if (shape.kind == Kind::mesh && shape.mesh.triangles.size() > 1) return group;
    }
  }
  return nullptr;
}

Derived splitMesh(const Scene& scene, Choice choice) {
  if (!takesGroups(scene) || scene.request.contact != ContactMeaning::fcl) return std::nullopt;
  Scene result = scene;
  std::size_t at = 0;
  std::vector<Member>* const group = groupWithMesh(result, at);
  if (group == nullptr) return std::nullopt;
  Member rest = (*group)[at];
  auto& first = (*group)[at].shape.mesh.triangles;
  const auto cut = static_cast<std::ptrdiff_t>(1 + choice % (first.size() - 1));
  rest.shape.mesh.triangles.erase(rest.shape.mesh.triangles.begin(),
                                  rest.shape.mesh.triangles.begin() + cut);
  first.resize(static_cast<std::size_t>(cut));
  group->push_back(rest);
  result.question = Question::group;
  return result;
}

Derived duplicated(const Scene& scene, Choice choice) {
  if (!takesGroups(scene)) return std::nullopt;
  Scene result = scene;
  auto& group = choice % 2 == 0 ? result.a : result.b;
  group.push_back(group[choice % group.size()]);
  result.question = Question::group;
  return result;
}

Derived withoutTriangle(const Scene& scene, Choice choice) {
  if (scene.request.contact != ContactMeaning::fcl) return std::nullopt;
  Scene result = scene;
  std::size_t at = 0;
  std::vector<Member>* const group = groupWithMesh(result, at);
  if (group == nullptr) return std::nullopt;
  auto& triangles = (*group)[at].shape.mesh.triangles;
  triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(choice % triangles.size()));
  return result;
}

Derived asSolids(const Scene& scene, Choice) {
  if (scene.request.contact != ContactMeaning::fcl) return std::nullopt;
  Scene result = scene;
  result.request.contact = ContactMeaning::solid;
  return result;
}

/// Boxes and hulls as closed meshes that are solids.
Derived asMeshes(const Scene& scene, Choice) {
  Scene result = scene;
  bool any = false;
  for (auto* group : {&result.a, &result.b}) {
    for (Member& member : *group) {
      Shape& shape = member.shape;
      if (shape.kind == Kind::mesh && scene.request.contact != ContactMeaning::solid) {
        return std::nullopt;
      }
      if (shape.kind == Kind::box) shape.mesh = fcl_prob_test::boxMesh(shape.sizes);
      if (shape.kind != Kind::box && shape.kind != Kind::convex) continue;
      shape.kind = Kind::mesh;
      any = true;
    }
  }
  if (!any) return std::nullopt;
  result.request.contact = ContactMeaning::solid;
  return result;
}

Derived tighter(const Scene& scene, Choice) {
  Scene result = scene;
  result.request.relative_tolerance /= 4.0;
  result.request.absolute_tolerance /= 4.0;
  result.request.max_cells = 2 * std::min<std::size_t>(scene.request.max_cells, 1000);
  return result;
}

Derived byAnotherMethod(const Scene& scene, Choice choice) {
  static const std::vector<ProbabilityMethod> kMethods = {
      ProbabilityMethod::interval,       ProbabilityMethod::automatic,
      ProbabilityMethod::estimate,       ProbabilityMethod::exact,
      ProbabilityMethod::convex_pcd,     ProbabilityMethod::general_pcd,
      ProbabilityMethod::general_pcd_min};
  Scene result = scene;
  result.request.method = kMethods[choice % kMethods.size()];
  if (result.request.method == scene.request.method) return std::nullopt;
  result.request.gradient = false;
  return result;
}

Derived onThreads(const Scene& scene, Choice) {
  Scene result = scene;
  result.request.threads = 2;
  return result;
}

Matrix3d unchanged(Choice) { return Matrix3d::Identity(); }

}  // namespace

const std::vector<Relation>& relations() {
  using Holds = Relation::Holds;
  static const std::vector<Relation> all = {
      {"swapped", swapped, Holds::equal, [](Choice) -> Matrix3d { return -Matrix3d::Identity(); }},
      {"members reversed", inOrderReversed, Holds::equal, unchanged},
      {"scaled", rescaled, Holds::equal, rescaledGradient},
      {"turned", turnedWorld, Holds::equal, exactTurn},
      {"mirrored", mirrored, Holds::equal, [](Choice) { return mirror(); }},
      {"moved together", movedBoth, Holds::equal, unchanged},
      {"triangles refined", refinedMeshes, Holds::equal, unchanged},
      {"split into members", splitMesh, Holds::equal, unchanged},
      {"member twice", duplicated, Holds::equal, unchanged},
      {"a triangle less", withoutTriangle, Holds::at_most, {}},
      {"as solids", asSolids, Holds::at_least, {}},
      {"as closed meshes", asMeshes, Holds::equal, {}},
      {"tighter", tighter, Holds::equal, unchanged},
      {"another method", byAnotherMethod, Holds::equal, {}},
      {"two threads", onThreads, Holds::equal, unchanged}};
  return all;
}

}  // namespace fcl_prob_audit
