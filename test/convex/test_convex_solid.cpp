// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Which meshes are convex solids, and the room that one leaves another.
#include "convex/convex_solid.h"

#include <algorithm>

#include "catch.h"
#include "convex/convex_set.h"
#include "convex/room_within.h"
#include "dented_mesh.h"
#include "mesh_shapes.h"
#include "random_bodies.h"

namespace {

using namespace fcl_prob;
using namespace fcl_prob_test;
using detail::convexSolidOf;
using detail::RoomWithin;

std::unique_ptr<const detail::ConvexSolid> solidOf(const TriangleMesh& mesh) {
  return convexSolidOf(detail::viewOf(mesh), "mesh");
}

// How far a place is from being room: the guest's vertex farthest beyond a face of the host.
double beyond(const ConvexBody& host, const ConvexBody& guest, const Eigen::Matrix3d& turn,
              const Eigen::Vector3d& place) {
  double most = -1e300;
  for (const auto& face : host.set().outerMesh().faces) {
    const Eigen::Vector3d n = face.normal;
    most = std::max(most, n.dot(place + turn * guest.supportPoint(turn.transpose() * n) -
                                host.supportPoint(n)));
  }
  return most;
}

}  // namespace

TEST_CASE("boxes as meshes are convex to the last bit, their normals along the axes") {
  const auto solid = solidOf(boxMesh({0.3, 0.7, 1.1}));
  REQUIRE(solid);
  CHECK(solid->inset == 0.0);
  for (const auto& face : solid->hull.set().outerMesh().faces) {
    CHECK(face.normal.cwiseAbs().maxCoeff() == 1.0);
    CHECK(face.normal.cwiseAbs().sum() == 1.0);
  }
}

TEST_CASE("only closed, connected and convex meshes are convex solids") {
  RandomBodies random(3);
  const TriangleMesh hull = hullMesh(random.onSphere(40, 0.5));
  const auto solid = solidOf(hull);
  REQUIRE(solid);
  CHECK(solid->inset < 8 * 2.3e-16 * 0.5);
  CHECK_FALSE(solidOf(torusMesh(0.5, 0.1, 16, 8)));
  CHECK_FALSE(solidOf(bumpyMesh(0.5, 8, 12, 1)));
  CHECK_FALSE(solidOf(withDents(sphereMesh(0.5, 8, 12), 1, 1e-9, random)));
  CHECK_FALSE(solidOf(joined(hull, transformed(hull, Eigen::Isometry3d(Eigen::Translation3d(
                                                         Eigen::Vector3d(1e-18, 0, 0)))))));
  TriangleMesh open = hull;
  open.triangles.pop_back();
  CHECK_FALSE(solidOf(open));
}

TEST_CASE("the room within a polytope is between two polytopes that differ by rounding") {
  RandomBodies random(5);
  for (int i = 0; i < 60; ++i) {
    const ConvexBody host(random.onSphere(30, 1.0)), guest(random.onSphere(12, 0.2));
    const Eigen::Matrix3d turn = random.rotation();
    const RoomWithin room(host, guest, turn.cast<long double>(), 0.0);
    CAPTURE(i);
    REQUIRE_FALSE(room.isEmpty());
    const auto around = room.around(), inside = room.inside();
    REQUIRE(around);
    REQUIRE(inside);
    for (const Eigen::Vector3d& place : inside->set().outerMesh().vertices) {
      CHECK(beyond(host, guest, turn, place) <= 1e-15);
    }
    for (int k = 0; k < 50; ++k) {
      const Eigen::Vector3d u = random.direction();
      const double out = u.dot(around->supportPoint(u)), in = u.dot(inside->supportPoint(u));
      CHECK(out > in);
      CHECK(out - in < 1e-12);
      // A little farther out there is none.
      CHECK(beyond(host, guest, turn, around->supportPoint(u) + 1e-9 * u) > 0.0);
    }
  }
}

TEST_CASE("there is no room for a polytope that is too wide, and hardly any for the same one") {
  const auto solid = solidOf(boxMesh({0.3, 0.7, 1.1})), slim = solidOf(boxMesh({0.1, 0.71, 1.0}));
  const detail::LongMatrix3 same = detail::LongMatrix3::Identity();
  CHECK(RoomWithin(solid->hull, slim->hull, same, 0.0).isEmpty());
  const RoomWithin room(solid->hull, solid->hull, same, 0.0);
  CHECK_FALSE(room.isEmpty());
  CHECK_FALSE(room.inside());
  const auto around = room.around();
  REQUIRE(around);
  for (const Eigen::Vector3d& place : around->set().outerMesh().vertices) {
    CHECK(place.norm() < 1e-12);
  }
}
