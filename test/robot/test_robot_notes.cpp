// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What readers of mesh files tell is told of the meshes of robots, too, and of what is around them.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.h"
#include "collada_tetrahedron.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/robot_scene.h"
#include "temporary_folder.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

constexpr const char* kObj =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// A robot of one link with meshes of these files.
std::string urdfOf(const std::vector<std::string>& meshes) {
  std::string text = "<robot name=\"r\"><link name=\"l\">";
  for (const std::string& mesh : meshes) {
    text += "<collision><geometry><mesh filename=\"" + mesh + "\"/></geometry></collision>";
  }
  return text + "</link></robot>";
}

/// How many sentences have a text in them.
std::size_t countOf(const std::string& text, const std::vector<std::string>& sentences) {
  const auto has = [&](const std::string& one) { return one.find(text) != std::string::npos; };
  return static_cast<std::size_t>(std::count_if(sentences.begin(), sentences.end(), has));
}

/// A robot of one mesh beside an obstacle of another, which it carries once more.
std::string sceneOf(const std::string& obstacle, double sigma, double tolerance) {
  const std::string mesh = "\"mesh\": \"" + obstacle + "\"";
  return R"({"robot": {"urdf": "r.urdf", "attached": [{"name": "held", "link": "l", )" + mesh +
         R"(, "pose": [0, 0, 5]}]}, "obstacles": [{"name": "o", )" + mesh +
         R"(, "pose": [1.1, 0, 0], "displacement": {"sigma": [0.1, 0.1, )" + std::to_string(sigma) +
         R"(]}}], "joints": {}, "request": {"absolute_tolerance": 0,)" +
         R"( "relative_tolerance": )" + std::to_string(tolerance) + "}}";
}

}  // namespace

TEST_CASE("notes of mesh files are told of the meshes that a URDF names, once a file") {
  const TemporaryFolder folder;
  folder.write("clean.obj", kObj);
  folder.write("more.obj", std::string("6540 2180\n") + kObj);
  folder.write("other.obj", std::string(kObj) + "6540 2180\n");
  const Robot clean(folder.write("clean.urdf", urdfOf({"clean.obj"})));
  CHECK(clean.notes().empty());
  const Robot robot(
      folder.write("r.urdf", urdfOf({"more.obj", "clean.obj", "other.obj", "more.obj"})));
  std::vector<std::string> expected = loadMesh(folder.path("more.obj")).notes;
  const std::vector<std::string> of_other = loadMesh(folder.path("other.obj")).notes;
  expected.insert(expected.end(), of_other.begin(), of_other.end());
  REQUIRE(expected.size() == 2);
  CHECK(robot.notes() == expected);
  CHECK(robot.bodies().size() == 4);
}

TEST_CASE("answers tell the notes of a robot's, an obstacle's and a carried mesh, once a file") {
  const TemporaryFolder folder;
  folder.write("clean.obj", kObj);
  folder.write("more.obj", std::string("6540 2180\n") + kObj);
  folder.write("other.obj", std::string("6540 2180\n") + kObj);
  folder.write("r.urdf", urdfOf({"more.obj"}));
  for (const bool is_clean : {false, true}) {
    const RobotScene scene = loadRobotScene(
        folder.write("scene.json", sceneOf(is_clean ? "clean.obj" : "other.obj", 0.1, 0.5)));
    const RobotQuery query = loadRobotQuery(scene);
    const RobotResult result =
        query.state(waypointsOf(scene, query.robot()).front(), scene.request);
    CAPTURE(result.plan);
    CHECK(countOf("more.obj", result.plan) == 1);
    CHECK(countOf("other.obj", result.plan) == (is_clean ? 0 : 1));
    CHECK(countOf("other.obj", query.robot().notes()) == (is_clean ? 0 : 1));
    CHECK(countOf("single precision", result.plan) == 0);
  }
}

TEST_CASE("single precision is told of robots and obstacles where it matters") {
  const TemporaryFolder folder;
  folder.write("t.obj", kObj);
  folder.write("t.dae", kColladaTetrahedron);
  for (const bool of_robot : {false, true}) {
    for (const bool of_obstacle : {false, true}) {
      folder.write("r.urdf", urdfOf({of_robot ? "t.dae" : "t.obj"}));
      const auto planOf = [&](double sigma, double tolerance) {
        const RobotScene scene = loadRobotScene(
            folder.write("scene.json", sceneOf(of_obstacle ? "t.dae" : "t.obj", sigma, tolerance)));
        const RobotQuery query = loadRobotQuery(scene);
        return query.state(waypointsOf(scene, query.robot()).front(), scene.request).plan;
      };
      CAPTURE(of_robot, of_obstacle);
      CHECK(countOf("single precision", planOf(0.1, 0.3)) == 0);
      for (const auto& plan : {planOf(0.1, 0.003), planOf(1e-5, 0.3)}) {
        CAPTURE(plan);
        // What is carried is part of the robot.
        CHECK(countOf("meshes of the robot are read in", plan) == (of_robot || of_obstacle));
        CHECK(countOf("obstacle o is read in single precision", plan) == of_obstacle);
      }
    }
  }
}
