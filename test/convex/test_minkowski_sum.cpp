// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/minkowski_sum.h"

#include <Eigen/Geometry>

#include "catch.h"
#include "face_geometry.h"
#include "fcl_prob/convex_polytope.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob_test;
using namespace fcl_prob::detail;
using Points = std::vector<Eigen::Vector3d>;

double sizeOf(const Points& points) {
  double size = 0.0;
  for (const Eigen::Vector3d& p : points) size = std::max(size, p.norm());
  return size;
}

double hullVolume(const Points& points) {
  const fcl_prob::ConvexPolytope hull = fcl_prob::convexHull(points);
  double volume = 0.0;
  for (const auto& face : hull.faces) {
    const Eigen::Vector3d a = hull.vertices[face.vertices[0]] - points[0];
    for (std::size_t i = 1; i + 1 < face.vertices.size(); ++i) {
      volume += a.dot((hull.vertices[face.vertices[i]] - points[0])
                          .cross(hull.vertices[face.vertices[i + 1]] - points[0])) /
                6.0;
    }
  }
  return volume;
}

/// Compares with the hull (Qhull) of the sums of all pairs of points.
void checkSum(const Points& p, const Points& q, RandomBodies& random, bool compare_volume = true) {
  const ConvexMesh mesh_p = makeConvexMesh(p);
  const ConvexMesh mesh_q = makeConvexMesh(q);
  MinkowskiSum sum;
  FaceSet faces;
  const std::optional<double> defect = sum.compute(mesh_p, mesh_q, faces);
  REQUIRE(defect.has_value());
  const double size = sizeOf(p) + sizeOf(q);
  CHECK(*defect <= 1e-9 * size);
  CHECK(faces.closed());
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d direction = random.direction();
    const double expected = supportOf(p, direction) + supportOf(q, direction);
    CHECK(std::abs(supportOf(faces.vertices(), direction) - expected) <= 1e-13 * size);
  }
  if (!compare_volume) return;
  const Points all = allSums(p, q);
  CHECK(std::abs(volumeOf(faces) - hullVolume(all)) <= 1e-12 * size * size * size);
}

TEST_CASE("the Minkowski sum of random hulls is the hull of the sums") {
  RandomBodies random(11);
  for (int i = 0; i < 150; ++i) {
    checkSum(random.cloud(random.integer(4, 20), random.logUniform(0.01, 100)),
             random.cloud(random.integer(4, 20), random.logUniform(0.01, 100)), random);
  }
}

TEST_CASE("the Minkowski sum of two hulls of a hundred vertices") {
  RandomBodies random(12);
  for (int i = 0; i < 3; ++i) {
    const Points p = random.onSphere(100, 1.0);
    const Points q = random.onSphere(100, 0.7);
    REQUIRE(makeConvexMesh(p).vertices.size() == 100);
    checkSum(p, q, random);
  }
}

TEST_CASE("triangles: eleven pairs of planes, coplanar and parallel ones included") {
  RandomBodies random(13);
  for (int i = 0; i < 300; ++i) {
    const Points p = random.cloud(3, 1.0);
    Points q = random.cloud(3, random.logUniform(0.01, 10.0));
    if (i % 3 == 1) {  // an edge in common
      q[0] = p[0];
      q[1] = p[1];
    }
    if (i % 3 == 2) {  // parallel planes
      for (Eigen::Vector3d& v : q) {
        v = random.normal() * (p[1] - p[0]) + random.normal() * (p[2] - p[0]);
      }
    }
    checkSum(p, q, random, i % 3 != 2);
    MinkowskiSum sum;
    FaceSet faces;
    REQUIRE(sum.compute(makeConvexMesh(p), makeConvexMesh(q), faces));
    CHECK(faces.faceCount() <= 22);
    CHECK(faces.vertices().size() <= 9);
  }
}

TEST_CASE("bodies with parallel faces and edges: a body and its mirror image, boxes, prisms") {
  RandomBodies random(14);
  for (int i = 0; i < 100; ++i) {
    const Points p = random.cloud(random.integer(4, 12), 1.0);
    checkSum(p, p, random);
    Points mirrored;
    for (const Eigen::Vector3d& v : p) mirrored.push_back(-v);
    checkSum(p, mirrored, random);

    const Eigen::Matrix3d axes = i % 2 ? random.rotation() : Eigen::Matrix3d::Identity();
    Points box_a;
    Points box_b;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d signs((corner & 1) - 0.5, ((corner >> 1) & 1) - 0.5,
                                  (corner >> 2) - 0.5);
      box_a.push_back(axes * signs.cwiseProduct(Eigen::Vector3d(1, 2, 3)));
      box_b.push_back(axes * signs.cwiseProduct(Eigen::Vector3d(3, 0.5, 0.1)));
    }
    checkSum(box_a, box_b, random);
  }
}

TEST_CASE("points, segments and polygons can be added") {
  RandomBodies random(15);
  const Points body = random.cloud(10, 1.0);
  const Points point = {Eigen::Vector3d(1, 2, 3)};
  const Points segment = {Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0, -1, 2)};
  const Points square = {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1),
                         Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 1, 1)};
  for (const Points& thin : {point, segment, square}) {
    checkSum(body, thin, random);
    checkSum(thin, body, random);
    checkSum(thin, thin, random, false);
  }
  checkSum(square, segment, random);
  checkSum(segment, {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 1, 1)}, random, false);
  checkSum(point, segment, random, false);
}

TEST_CASE("reflecting a mesh turns its faces round") {
  RandomBodies random(16);
  const ConvexMesh mesh = makeConvexMesh(random.cloud(12, 1.0));
  const Eigen::Matrix3d rotation = random.rotation();
  ConvexMesh image;
  reflect(mesh, rotation, image);
  for (const ConvexMesh::Face& face : image.faces) {
    const auto corner = [&](int i) -> Eigen::Vector3d {
      return image.vertices[image.corners[face.first + i]];
    };
    const Eigen::Vector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    CHECK(area.normalized().dot(face.normal) == Approx(1.0));
    for (const Eigen::Vector3d& v : image.vertices) {
      CHECK(face.normal.dot(v - corner(0)) <= 1e-14);
    }
  }
  for (const ConvexMesh::Edge& edge : image.edges) {
    const ConvexMesh::Face& left = image.faces[edge.left];
    int found = 0;
    for (int c = 0; c < left.count; ++c) {
      found += image.corners[left.first + c] == edge.from &&
               image.corners[left.first + (c + 1) % left.count] == edge.to;
    }
    CHECK(found == 1);
  }
}

}  // namespace
