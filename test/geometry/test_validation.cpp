// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/geometry/shape/triangle_p.h>

#include <array>
#include <limits>

#include "catch.h"
#include "fcl_prob/exceptions.h"
#include "geometry/validation.h"
#include "mesh_shapes.h"

using namespace fcl_prob;
using namespace fcl_prob::detail;
using namespace fcl_prob_test;
using Catch::Matchers::Contains;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

using Model = fcl::BVHModel<fcl::OBBRSSd>;

void validate(const fcl::CollisionGeometryd& geometry) { validateGeometry(&geometry, "part"); }

fcl::Convexd convex(std::vector<Eigen::Vector3d> vertices, int face_count, std::vector<int> faces) {
  return fcl::Convexd(std::make_shared<const std::vector<Eigen::Vector3d>>(std::move(vertices)),
                      face_count, std::make_shared<const std::vector<int>>(std::move(faces)));
}

const std::vector<Eigen::Vector3d> kTetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<int> kTetrahedronFaces = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2};

}  // namespace

TEST_CASE("good geometries pass") {
  CHECK_NOTHROW(validate(fcl::Boxd(1, 2, 3)));
  CHECK_NOTHROW(validate(fcl::Sphered(1)));
  CHECK_NOTHROW(validate(fcl::Halfspaced(1, 2, 3, 4)));
  CHECK_NOTHROW(validate(convex(kTetrahedron, 4, kTetrahedronFaces)));
  CHECK_NOTHROW(validate(*makeModel<fcl::KDOPd<24>>(torusMesh(1, 0.2, 8, 6))));
}

TEST_CASE("a model that is being replaced or updated is finished only at the end") {
  const TriangleMesh box = boxMesh({1, 1, 1});
  const auto model = makeModel<fcl::OBBRSSd>(box);
  REQUIRE(model->beginReplaceModel() == fcl::BVH_OK);
  CHECK_THROWS_AS(validate(*model), InvalidGeometry);
  REQUIRE(model->replaceSubModel(box.vertices) == fcl::BVH_OK);
  REQUIRE(model->endReplaceModel() == fcl::BVH_OK);
  CHECK_NOTHROW(validate(*model));
}

TEST_CASE("null, empty and unfinished geometries are refused") {
  CHECK_THROWS_AS(validateGeometry(nullptr, "part"), InvalidGeometry);
  CHECK_THROWS_WITH(validateGeometry(nullptr, "part"), Contains("part") && Contains("null"));
  Model empty;
  CHECK_THROWS_AS(validate(empty), InvalidGeometry);
  Model begun;
  REQUIRE(begun.beginModel() == fcl::BVH_OK);
  begun.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  CHECK_THROWS_AS(validate(begun), InvalidGeometry);
  CHECK_THROWS_WITH(validate(begun), Contains("unfinished"));
  CHECK_THROWS_AS(validate(fcl::OcTreed(0.1)), InvalidGeometry);
}

TEST_CASE("point clouds are refused") {
  Model cloud;
  REQUIRE(cloud.beginModel() == fcl::BVH_OK);
  cloud.addSubModel(boxMesh({1, 1, 1}).vertices);
  REQUIRE(cloud.endModel() == fcl::BVH_OK);
  CHECK_THROWS_AS(validate(cloud), InvalidGeometry);
  CHECK_THROWS_WITH(validate(cloud), Contains("point cloud"));
}

TEST_CASE("bad vertices and indices are refused by their number") {
  const auto model = makeModel<fcl::OBBRSSd>(boxMesh({1, 1, 1}));
  for (double bad : {kNan, kInfinity, -kInfinity}) {
    const double good = model->vertices[5][1];
    model->vertices[5][1] = bad;
    CHECK_THROWS_AS(validate(*model), InvalidGeometry);
    CHECK_THROWS_WITH(validate(*model), Contains("vertex 5"));
    model->vertices[5][1] = good;
  }
  CHECK_NOTHROW(validate(*model));
  model->tri_indices[7][2] = 8;
  CHECK_THROWS_AS(validate(*model), InvalidGeometry);
  CHECK_THROWS_WITH(validate(*model), Contains("triangle 7") && Contains("vertex 8"));
  model->tri_indices[7][2] = static_cast<std::size_t>(-1);
  CHECK_THROWS_AS(validate(*model), InvalidGeometry);
}

TEST_CASE("sizes that are not positive are refused with their value") {
  CHECK_THROWS_AS(validate(fcl::Boxd(1, 0, 1)), InvalidGeometry);
  CHECK_THROWS_WITH(validate(fcl::Boxd(1, 1, -2)), Contains("side z") && Contains("-2"));
  CHECK_THROWS_AS(validate(fcl::Sphered(-1)), InvalidGeometry);
  CHECK_THROWS_AS(validate(fcl::Sphered(kNan)), InvalidGeometry);
  CHECK_THROWS_AS(validate(fcl::Ellipsoidd(1, kInfinity, 1)), InvalidGeometry);
  CHECK_THROWS_AS(validate(fcl::Capsuled(1, -1)), InvalidGeometry);
  CHECK_THROWS_AS(validate(fcl::Cylinderd(0, 1)), InvalidGeometry);
  CHECK_THROWS_AS(validate(fcl::TrianglePd({0, 0, 0}, {1, 0, 0}, {0, kNan, 0})), InvalidGeometry);
}

TEST_CASE("half-spaces need a unit normal") {
  fcl::Halfspaced halfspace(0, 0, 1, 2);
  halfspace.n *= 2;
  CHECK_THROWS_AS(validate(halfspace), InvalidGeometry);
  halfspace.n = Eigen::Vector3d(0, 0, kNan);
  CHECK_THROWS_AS(validate(halfspace), InvalidGeometry);
  halfspace.n = Eigen::Vector3d(0, 0, 1);
  halfspace.d = kInfinity;
  CHECK_THROWS_AS(validate(halfspace), InvalidGeometry);
}

// Only faces that fcl::Convex's own constructor survives: it reads through bad indices.
TEST_CASE("Convex shapes with broken faces are refused") {
  auto inward = kTetrahedronFaces;
  for (std::size_t f = 0; f < 4; ++f) std::swap(inward[4 * f + 1], inward[4 * f + 2]);
  CHECK_THROWS_WITH(validate(convex(kTetrahedron, 4, inward)), Contains("counter-clockwise"));

  const std::vector<int> open(kTetrahedronFaces.begin(), kTetrahedronFaces.begin() + 12);
  CHECK_THROWS_WITH(validate(convex(kTetrahedron, 3, open)), Contains("do not close"));

  auto with_stray = kTetrahedron;
  with_stray.push_back({5, 5, 5});
  CHECK_THROWS_WITH(validate(convex(with_stray, 4, kTetrahedronFaces)),
                    Contains("vertex 4") && Contains("no face"));

  auto with_nan = kTetrahedron;
  with_nan[2][1] = kNan;
  CHECK_THROWS_WITH(validate(convex(with_nan, 4, kTetrahedronFaces)), Contains("vertex 2"));

  const std::vector<Eigen::Vector3d> dented = {{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                               {0, -1, 0}, {0, 0, 1}, {0, 0, 0.2}};
  const std::vector<int> dented_faces = {3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4,
                                         3, 1, 0, 5, 3, 2, 1, 5, 3, 3, 2, 5, 3, 0, 3, 5};
  CHECK_THROWS_WITH(validate(convex(dented, 8, dented_faces)), Contains("not convex"));
}

// A trough whose bottom is a strip: across it no two faces share an edge that would tell.
TEST_CASE("Convex shapes that are dented along a narrow face are refused") {
  for (const double width : {0.1, 1e-5, 1e-7, 1e-10, 1e-13}) {
    for (const double bottom : {0.5, 1.5}) {
      std::vector<Eigen::Vector3d> vertices;
      for (const double y : {0.0, 1.0}) {
        vertices.insert(vertices.end(), {{0, y, 0},
                                         {2, y, 0},
                                         {2, y, 1},
                                         {1 + width, y, bottom},
                                         {1 - width, y, bottom},
                                         {0, y, 1}});
      }
      std::vector<int> faces;
      for (int i = 0; i < 6; ++i) {
        const int j = (i + 1) % 6;
        faces.insert(faces.end(), {4, i, i + 6, j + 6, j});
      }
      // Both ends, in triangles that are right for either bottom.
      for (const auto& [i, j, k] :
           std::vector<std::array<int, 3>>{{0, 4, 5}, {0, 3, 4}, {0, 1, 3}, {1, 2, 3}}) {
        faces.insert(faces.end(), {3, i, j, k, 3, i + 6, k + 6, j + 6});
      }
      const fcl::Convexd body = convex(vertices, 14, faces);
      CAPTURE(width, bottom);
      if (bottom > 1.0) {
        CHECK_NOTHROW(validate(body));
      } else {
        CHECK_THROWS_WITH(validate(body), Contains("not convex"));
      }
    }
  }
}

TEST_CASE("poses must be finite and rigid") {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  CHECK_NOTHROW(validatePose(pose, "part"));
  pose.linear() = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  CHECK_NOTHROW(validatePose(pose, "part"));
  fcl::Transform3d scaled = pose;
  scaled.linear() *= 1.0 + 1e-6;
  CHECK_THROWS_AS(validatePose(scaled, "part"), InvalidPose);
  fcl::Transform3d mirrored = pose;
  mirrored.linear().col(0) *= -1;
  CHECK_THROWS_WITH(validatePose(mirrored, "part"), Contains("determinant"));
  fcl::Transform3d lost = pose;
  lost.translation()[1] = kNan;
  CHECK_THROWS_WITH(validatePose(lost, "part"), Contains("part") && Contains("nan"));
  fcl::Transform3d broken = pose;
  broken.linear()(0, 0) = kInfinity;
  CHECK_THROWS_AS(validatePose(broken, "part"), InvalidPose);
}

TEST_CASE("lengths whose squares overflow are refused by name") {
  const double huge = 1e300;
  CHECK_THROWS_WITH(validate(fcl::Boxd(1, huge, 3)), Contains("side y"));
  CHECK_THROWS_WITH(validate(fcl::Sphered(huge)), Contains("radius"));
  CHECK_THROWS_WITH(validate(fcl::Cylinderd(1, huge)), Contains("lz"));
  CHECK_THROWS_WITH(validate(fcl::Halfspaced(1, 0, 0, huge)), Contains("offset"));
  CHECK_THROWS_WITH(validate(*makeModel<fcl::AABBd>(boxMesh({1, huge, 1}))), Contains("vertex"));
  auto far = kTetrahedron;
  far[1][0] = -huge;
  CHECK_THROWS_WITH(validate(convex(far, 4, kTetrahedronFaces)), Contains("vertex 1"));
  CHECK_THROWS_AS(validate(fcl::TrianglePd(far[0], far[1], far[2])), InvalidGeometry);
  const fcl::Transform3d pose(Eigen::Translation3d(0, huge, 0));
  CHECK_THROWS_AS(validatePose(pose, "part"), InvalidPose);
  CHECK_NOTHROW(validate(fcl::Boxd(1, 1e149, 3)));
}
