// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob export: the file can be read back, and the colours are where the contact is.
#include <cmath>

#include "catch.h"
#include "cli/touch_map.h"
#include "command.h"
#include "fcl_prob/mesh_io.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

TEST_CASE("export writes one file with both meshes and three ellipsoids", "[cli]") {
  const TemporaryFolder folder;
  const CommandResult result = runCommand({"export", "--scene", dataFile("finger_mug.json"),
                                           "--samples", "500", "--output", "scene.glb"},
                                          folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const TriangleMesh all = loadMesh(folder.path("scene.glb"));
  const std::size_t parts = loadMesh(dataFile("gripper_finger.off")).triangles.size() +
                            loadMesh(dataFile("mug.obj")).triangles.size();
  CHECK(all.triangles.size() > parts + 3 * 500);

  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : all.vertices) box.extend(v);
  CHECK(box.max().z() > 0.13);
  CHECK(box.min().z() == Approx(0.0).margin(1e-6));

  CHECK(runCommand({"export", "--scene", dataFile("finger_mug.json"), "--output", "x.stl"}, folder)
            .refused());
  CHECK(runCommand({"export", "--scene", dataFile("finger_mug.json")}, folder).refused());
}

TEST_CASE("every bounded primitive can be drawn", "[cli]") {
  const TemporaryFolder folder;
  for (const char* shape :
       {R"("box": [1, 1, 1])", R"("sphere": 0.5)", R"("ellipsoid": [1, 2, 3])",
        R"("capsule": {"radius": 0.5, "length": 1})", R"("cone": {"radius": 0.5, "length": 1})",
        R"("cylinder": {"radius": 0.5, "length": 1})"}) {
    CAPTURE(shape);
    folder.write("s.json", std::string(R"({"a": {)") + shape +
                               R"(}, "b": {"box": [1, 1, 1], "pose": [2, 0, 0]},
"displacement": {"sigma": [0.3, 0.3, 0]}})");
    CHECK(
        runCommand({"export", "--scene", "s.json", "--samples", "100", "--output", "s.glb"}, folder)
            .exit_code == 0);
    CHECK(loadMesh(folder.path("s.glb")).triangles.size() > 100);
  }
}

TEST_CASE("an octree is drawn as the cubes of its occupied cells", "[cli]") {
  const TemporaryFolder folder;
  folder.write("s.json", R"({"a": {"sphere": 0.05, "pose": [0.1, 0.4, 0.2]}, "b": {"octomap": ")" +
                             dataFile("shelf.bt") +
                             R"("}, "displacement": {"sigma": [0.03, 0.03, 0.03]}})");
  const CommandResult result =
      runCommand({"export", "--scene", "s.json", "--samples", "100", "--output", "s.glb"}, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  const TriangleMesh all = loadMesh(folder.path("s.glb"));
  Eigen::AlignedBox3d box;
  for (const fcl::Vector3d& v : all.vertices) box.extend(v);
  CHECK(box.min().norm() < 1e-6);
  CHECK(box.max().isApprox(Eigen::Vector3d(0.3, 0.8, 0.725), 1e-6));
  CHECK(all.triangles.size() > 12 * 1000);
}

TEST_CASE("the touched part is the part that faces the other mesh", "[cli]") {
  const TriangleMesh finger = loadMesh(dataFile("gripper_finger.off"));
  TriangleMesh wall;  // at x = 18 mm, the pad of the finger reaches to 13.5 mm
  wall.vertices = {{0.018, -1, -1}, {0.018, 1, -1}, {0.018, 0, 1}};
  wall.triangles = {{0, 1, 2}};
  // Let the mounting block be out of reach, which ends at x = 18 mm.
  TriangleMesh tip = finger;
  for (fcl::Vector3d& v : tip.vertices) {
    if (v.y() < 0.03) v.x() = std::min(v.x(), 0.0);
  }
  const auto displacement =
      GaussianDisplacement::fromStandardDeviations(Eigen::Vector3d::Constant(0.003));
  const cli::TouchMap map = cli::touchMap(tip, wall, displacement, 2000, 1);
  CHECK(map.samples == 2000);
  CHECK(map.hits > 50);
  CHECK(map.hits < 500);
  REQUIRE(map.likelihood.size() == tip.vertices.size());
  double on_pad = 0.0;
  double elsewhere = 0.0;
  for (std::size_t i = 0; i < tip.vertices.size(); ++i) {
    CHECK(map.likelihood[i] >= 0.0);
    CHECK(map.likelihood[i] <= 1.0);
    const bool pad = tip.vertices[i].y() > 0.05 && tip.vertices[i].x() > 0.011;
    (pad ? on_pad : elsewhere) = std::max(pad ? on_pad : elsewhere, map.likelihood[i]);
  }
  CHECK(on_pad == 1.0);
  CHECK(elsewhere < 1.0);
}
