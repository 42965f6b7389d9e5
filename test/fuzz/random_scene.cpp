// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "random_scene.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <array>
#include <cmath>

#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/triangle_mesh.h"

using namespace fcl_prob;

namespace fcl_prob_fuzz {
namespace {

using Bytes = FuzzedDataProvider;

int upTo(Bytes& input, int most) { return input.ConsumeIntegralInRange<int>(0, most); }

/// Multiples of 1/16 up to 8: coordinates that coincide are frequent, and exact.
double onGrid(Bytes& input) { return input.ConsumeIntegral<std::int8_t>() / 16.0; }

double sizeOnGrid(Bytes& input) { return (1 + input.ConsumeIntegral<std::uint8_t>()) / 32.0; }

Eigen::Vector3d pointOnGrid(Bytes& input) {
  const double x = onGrid(input);
  const double y = onGrid(input);
  return {x, y, onGrid(input)};
}

std::vector<Eigen::Vector3d> points(Bytes& input, int count) {
  std::vector<Eigen::Vector3d> result;
  // Half of the time in general position.
  const double bend = input.ConsumeBool() ? 0.01 : 0.0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p = pointOnGrid(input);
    result.push_back(p + bend * Eigen::Vector3d(std::sin(p.y() + i), std::sin(p.z() + 2 * i),
                                                std::sin(p.x() + 3 * i)));
  }
  return result;
}

TriangleMesh soup(Bytes& input) {
  TriangleMesh mesh;
  mesh.vertices = points(input, 3 + upTo(input, 5));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  const int count = 1 + upTo(input, 7);
  for (int i = 0; i < count; ++i) {
    const int first = upTo(input, last);
    const int second = upTo(input, last);
    mesh.triangles.emplace_back(first, second, upTo(input, last));
  }
  return mesh;
}

/// Closed, so that it may be a solid; flat or inside out if the points are so.
TriangleMesh tetrahedron(Bytes& input) {
  TriangleMesh mesh;
  mesh.vertices = points(input, 4);
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

using NewGeometry = std::shared_ptr<fcl::CollisionGeometryd>;

NewGeometry convex(Bytes& input) {
  const ConvexPolytope hull = convexHull(points(input, 4 + upTo(input, 6)));
  std::vector<int> faces;
  for (const ConvexPolytope::Face& face : hull.faces) {
    faces.push_back(static_cast<int>(face.vertices.size()));
    faces.insert(faces.end(), face.vertices.begin(), face.vertices.end());
  }
  return std::make_shared<fcl::Convexd>(
      std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices),
      static_cast<int>(hull.faces.size()), std::make_shared<const std::vector<int>>(faces));
}

NewGeometry primitive(Bytes& input, int kind) {
  const double x = sizeOnGrid(input);
  const double y = sizeOnGrid(input);
  const double z = sizeOnGrid(input);
  switch (kind) {
    case 0:
      return std::make_shared<fcl::Boxd>(x, y, z);
    case 1:
      return std::make_shared<fcl::Sphered>(x);
    case 2:
      return std::make_shared<fcl::Ellipsoidd>(x, y, z);
    case 3:
      return std::make_shared<fcl::Capsuled>(x, y);
    case 4:
      return std::make_shared<fcl::Coned>(x, y);
    case 5:
      return std::make_shared<fcl::Cylinderd>(x, y);
    case 6:
      return std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(x, -y, z).normalized(), y - z);
    default:
      return std::make_shared<fcl::Planed>(Eigen::Vector3d(-x, y, z).normalized(), y - x);
  }
}

NewGeometry triangle(Bytes& input) {
  const std::vector<Eigen::Vector3d> p = points(input, 3);
  return std::make_shared<fcl::TrianglePd>(p[0], p[1], p[2]);
}

/// Meshes most often: they have the most code behind them.
NewGeometry newGeometry(Bytes& input) {
  const int kind = upTo(input, 15);
  if (kind < 8) return primitive(input, kind);
  if (kind == 8) return convex(input);
  if (kind == 9) return triangle(input);
  if (kind == 10) return buildModel<fcl::AABBd>(soup(input));
  if (kind < 13) return buildModel<fcl::OBBRSSd>(tetrahedron(input));
  return buildModel<fcl::OBBRSSd>(soup(input));
}

Geometry geometry(Bytes& input) {
  const NewGeometry result = newGeometry(input);
  result->computeLocalAABB();
  return result;
}

fcl::Transform3d pose(Bytes& input) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  const int kind = upTo(input, 3);
  if (kind == 1) result.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  if (kind >= 2) {
    const Eigen::Vector4d q(onGrid(input), onGrid(input), onGrid(input), 0.01 + sizeOnGrid(input));
    result.linear() = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  }
  const double scale = upTo(input, 15) == 0 ? 1e6 : 1.0;
  result.translation() = scale * pointOnGrid(input);
  return result;
}

double deviation(Bytes& input) {
  constexpr std::array<double, 12> kValues = {0.0,  1.0,  0.5,  0.2, 0.1, 0.03,
                                              0.01, 1e-4, 1e-9, 5.0, 1e3, 1e9};
  return kValues[static_cast<std::size_t>(upTo(input, 11))];
}

GaussianDisplacement displacement(Bytes& input) {
  const Eigen::Vector3d sigma(deviation(input), deviation(input), deviation(input));
  const Eigen::Quaterniond axes(pose(input).linear());
  return GaussianDisplacement::fromStandardDeviations(sigma, axes, pointOnGrid(input));
}

ProbabilityRequest request(Bytes& input) {
  using Method = ProbabilityMethod;
  constexpr std::array<Method, 8> kMethods = {
      Method::automatic, Method::automatic,  Method::interval,    Method::estimate,
      Method::exact,     Method::convex_pcd, Method::general_pcd, Method::general_pcd_min};
  ProbabilityRequest result;
  result.method = kMethods[static_cast<std::size_t>(upTo(input, 7))];
  result.contact = upTo(input, 3) == 0 ? ContactMeaning::solid : ContactMeaning::fcl;
  result.max_cells = static_cast<std::size_t>(1 + upTo(input, 40));
  if (upTo(input, 7) == 0) result.max_memory = static_cast<std::size_t>(1 + upTo(input, 100'000));
  result.relative_tolerance = input.ConsumeBool() ? 0.1 : 1e-9;
  if (input.ConsumeBool()) result.threshold = upTo(input, 20) / 20.0;
  result.gradient = input.ConsumeBool();
  return result;
}

}  // namespace

PairScene sceneFrom(Bytes& input) {
  PairScene scene;
  scene.request = request(input);
  scene.displacement = displacement(input);
  scene.pose_a = pose(input);
  scene.pose_b = pose(input);
  scene.a = geometry(input);
  scene.b = geometry(input);
  return scene;
}

}  // namespace fcl_prob_fuzz
