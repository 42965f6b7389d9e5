// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob export of a robot's motion: what is in the glTF file is where and as likely as it says.
#ifdef FCL_PROB_HAS_ROBOT
#include <algorithm>

#include "catch.h"
#include "cli/motion_states.h"
#include "cli/picture_colours.h"
#include "command.h"
#include "fcl_prob/mesh_io.h"
#include "fcl_prob/robot_scene.h"
#include "glb_reader.h"

using namespace fcl_prob;
using cli::Colour;
using namespace fcl_prob_test;
using nlohmann::json;

namespace {

GlbFile exported(const TemporaryFolder& folder, std::vector<std::string> options) {
  options.insert(options.begin(), "export");
  options.insert(options.end(), {"--output", "scene.glb"});
  const CommandResult result = runCommand(options, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
  return GlbFile(readWhole(folder.path("scene.glb")));
}

/// The groups that show the robot at a waypoint.
std::vector<json> waypointGroups(const GlbFile& file) {
  std::vector<json> groups;
  for (const json& group : file.groups()) {
    if (group.contains("extras")) groups.push_back(group);
  }
  return groups;
}

Colour colourOf(const GlbFile& file, const json& node) {
  const json& primitive = file.json.at("meshes").at(node.at("mesh").get<int>())["primitives"][0];
  const json& material = file.json.at("materials").at(primitive.at("material").get<int>());
  const std::vector<float> factor = material["pbrMetallicRoughness"].at("baseColorFactor");
  return {factor[0], factor[1], factor[2], factor[3]};
}

/// How far a node is from one of the robot's bodies with its name.
double distanceFromBody(const json& node, const Robot& robot, const Eigen::VectorXd& values) {
  const std::vector<fcl::Transform3d> poses = robot.poses(values);
  double least = 1e9;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (robot.bodies()[i].name() != node.at("name")) continue;
    least = std::min(least, (poses[i].matrix() - GlbFile::poseOf(node).matrix()).norm());
  }
  return least;
}

std::string sceneWith(const std::string& obstacle, const std::string& states) {
  return R"({"robot": {"urdf": ")" + dataFile("arm.urdf") + R"("}, "obstacles": [)" + obstacle +
         "], " + states + "}";
}

std::string ballWith(const std::string& displacement) {
  return R"({"name": "ball", "sphere": 0.1, "pose": [0.7, 0.4, 0], "displacement": )" +
         displacement + "}";
}

const char* const kTwoWaypoints =
    R"("waypoints": [{"turn": -0.5, "grip": 0.02}, {"turn": 0.5, "elbow": 0.3, "grip": 0.04}])";

}  // namespace

TEST_CASE("an exported motion has the robot at waypoints, coloured by their probability", "[cli]") {
  const TemporaryFolder folder;
  const std::string path = dataFile("arm_path.json");
  const GlbFile file = exported(folder, {"--scene", path, "--poses", "4"});
  file.checkAccessors();

  const RobotScene scene = loadRobotScene(path);
  const RobotQuery query = loadRobotQuery(scene);
  const std::vector<Eigen::VectorXd> waypoints = waypointsOf(scene, query.robot());
  ProbabilityRequest request = scene.request;
  request.threshold.reset();
  const std::vector<json> groups = waypointGroups(file);
  REQUIRE(groups.size() == 4);
  std::size_t bodies = 0;
  double largest = 0.0;
  for (const json& group : groups) {
    const json& notes = group.at("extras");
    const Eigen::VectorXd& values = waypoints.at(notes.at("waypoint").get<std::size_t>());
    const RobotResult result = query.state(values, request);
    CHECK(notes.at("lower") == result.any.lower);
    CHECK(notes.at("upper") == result.any.upper);
    CHECK(notes.at("probability") == result.probability());
    largest = std::max(largest, result.probability());
    for (const json& node : file.childrenOf(group)) {
      CAPTURE(group.at("name"), node.at("name"));
      CHECK(distanceFromBody(node, query.robot(), values) < 1e-6);
      CHECK(colourOf(file, node) == cli::heat(result.probability()));
      ++bodies;
    }
  }
  // The base, the turret and the ball of the shoulder are once where they always are.
  CHECK(bodies == 4 * 10 - 3 * 3);
  for (const Eigen::VectorXd& values : waypoints) {
    CHECK(query.state(values, request).any.lower <= largest);
  }
  CHECK(loadMesh(folder.path("scene.glb")).triangles.size() > 10'000);
}

TEST_CASE("an exported motion is animated along its waypoints", "[cli]") {
  const TemporaryFolder folder;
  folder.write("scene.json",
               sceneWith(ballWith(R"({"sigma": [0.02, 0.02, 0.02]})"), kTwoWaypoints));
  const GlbFile file = exported(folder, {"--scene", "scene.json"});
  file.checkAccessors();
  const Robot robot(dataFile("arm.urdf"));
  const Eigen::VectorXd first = robot.values({{"turn", -0.5}, {"grip", 0.02}});
  const Eigen::VectorXd last = robot.values({{"turn", 0.5}, {"elbow", 0.3}, {"grip", 0.04}});

  REQUIRE(file.json.at("animations").size() == 1);
  const json& animation = file.json["animations"][0];
  CHECK(animation.at("channels").size() == 2 * (10 - 3));
  CHECK(animation.at("samplers").size() == animation["channels"].size());
  const Eigen::MatrixXf times = file.values(animation["samplers"][0].at("input"));
  REQUIRE(times.cols() > 20);  // a radian in steps of 0.05
  CHECK(times(0) == 0.0F);
  const float end = times(times.cols() - 1);
  for (Eigen::Index i = 1; i < times.cols(); ++i) CHECK(times(i) > times(i - 1));
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"].at(channel.at("sampler").get<int>());
    CHECK(sampler.at("interpolation") == "LINEAR");
    const Eigen::MatrixXf values = file.values(sampler.at("output"));
    REQUIRE(values.cols() == times.cols());
    const bool turns = channel.at("target").at("path") == "rotation";
    REQUIRE(values.rows() == (turns ? 4 : 3));
    for (Eigen::Index i = 0; turns && i < values.cols(); ++i) {
      CHECK(values.col(i).norm() == Approx(1.0).margin(1e-6));
      CHECK((i == 0 || values.col(i).dot(values.col(i - 1)) > 0.0F));
    }
  }
  // At its times and half-way between them, where a viewer moves everything linearly.
  for (Eigen::Index i = 0; i + 1 < times.cols(); ++i) {
    for (const float share : {0.0F, 0.5F, 1.0F}) {
      const double fraction = ((1.0F - share) * times(i) + share * times(i + 1)) / end;
      const Eigen::VectorXd values = first + fraction * (last - first);
      for (const json& node : file.animatedNodes(i, share)) {
        CAPTURE(i, share, node.at("name"));
        CHECK(distanceFromBody(node, robot, values) < (share == 0.5F ? 1e-3 : 1e-6));
      }
    }
  }
}

TEST_CASE("a state, and a motion that shall be still, are exported without animation", "[cli]") {
  const TemporaryFolder folder;
  const std::string ball = ballWith(R"({"sigma": [0.02, 0.02, 0.02]})");
  folder.write("state.json", sceneWith(ball, R"("joints": {"turn": 0.4})"));
  const GlbFile state = exported(folder, {"--scene", "state.json"});
  state.checkAccessors();
  CHECK(!state.json.contains("animations"));
  CHECK(waypointGroups(state).size() == 1);
  CHECK(state.groups().size() == 2);

  folder.write("motion.json", sceneWith(ball, kTwoWaypoints));
  const GlbFile still = exported(folder, {"--scene", "motion.json", "--still"});
  CHECK(!still.json.contains("animations"));
  CHECK(waypointGroups(still).size() == 2);

  folder.write("standing.json", sceneWith(ball, R"("waypoints": [{"turn": 0.4}, {"turn": 0.4}])"));
  const GlbFile standing = exported(folder, {"--scene", "standing.json"});
  standing.checkAccessors();
  CHECK(!standing.json.contains("animations"));
  CHECK(standing.json.at("nodes").size() == 2 + 10 + 1 + 4);
}

TEST_CASE("obstacles have the ellipsoids of their errors, of any rank", "[cli]") {
  const TemporaryFolder folder;
  for (const int rank : {0, 1, 2, 3}) {
    CAPTURE(rank);
    const std::string sigma = std::string(rank > 0 ? "0.03" : "0") + (rank > 1 ? ",0.02" : ",0") +
                              (rank > 2 ? ",0.01" : ",0");
    folder.write("scene.json", sceneWith(ballWith(R"({"sigma": [)" + sigma + "]}"),
                                         R"("joints": {"turn": -0.4})"));
    const GlbFile file = exported(folder, {"--scene", "scene.json"});
    file.checkAccessors();
    const std::vector<json> shown = file.childrenOf(file.groups().back());
    REQUIRE(shown.size() == (rank > 0 ? 4 : 1));
    CHECK(GlbFile::poseOf(shown[0]).translation().isApprox(Eigen::Vector3d(0.7, 0.4, 0.0), 1e-6));
    for (std::size_t k = 1; k < shown.size(); ++k) {
      const Eigen::AlignedBox3f box = file.boxOf(shown[k]);
      const Eigen::Vector3d size = box.sizes().cast<double>();
      const double deviations = 2.0 * static_cast<double>(k);
      CHECK(size.x() == Approx(deviations * 0.03).epsilon(0.02));
      CHECK(size.z() == Approx(deviations * (rank > 2 ? 0.01 : 0.0003)).epsilon(0.02));
      // Around the place of the ball that is nearest to the robot.
      CHECK((box.center().cast<double>() - Eigen::Vector3d(0.7, 0.4, 0.0)).norm() ==
            Approx(0.1).epsilon(0.05));
    }
  }
}

TEST_CASE("obstacles that move are drawn at each waypoint that is shown", "[cli]") {
  const TemporaryFolder folder;
  const std::string moving =
      R"({"name": "ball", "sphere": 0.1, "pose": [0.7, 0.4, 0],
          "displacement": {"sigma": [0.02, 0.02, 0.02], "mean": [0, 0, 0.1]},
          "over_time": [{}, {"pose": [0.7, 0.4, 0.5]}]})";
  folder.write("scene.json",
               sceneWith(moving + R"(, {"name": "floor", "halfspace": {"normal": [0, 0, 1],
                                        "offset": -1}, "displacement": {"sigma": [0, 0, 0.01]}})",
                         kTwoWaypoints));
  const GlbFile file = exported(folder, {"--scene", "scene.json"});
  file.checkAccessors();
  CHECK(readWhole(folder.path("stderr")).find("floor is unbounded") != std::string::npos);
  REQUIRE(file.groups().size() == 2 + 2 + 1);
  const std::vector<json> start = file.childrenOf(file.groups()[2]);
  const std::vector<json> end = file.childrenOf(file.groups()[3]);
  CHECK(GlbFile::poseOf(start[0]).translation().z() == Approx(0.1));
  CHECK(GlbFile::poseOf(end[0]).translation().z() == Approx(0.6));
  CHECK(file.json.at("animations")[0].at("channels").size() == 2 * (10 - 3 + 1));
  CHECK(file.animatedNodes(0, 0.0F).back().at("name") == "ball");
}

TEST_CASE("the likeliest of all waypoints is shown", "[cli]") {
  std::vector<cli::MotionState> states(11);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].waypoint = i;
    states[i].result.any = i == 4 ? Bounds{0.5, 0.6} : Bounds{0.1, 0.2};
  }
  const auto waypoints = [&](std::size_t count) {
    std::vector<std::size_t> chosen;
    for (const cli::MotionState& state : cli::chosenFrom(states, count)) {
      chosen.push_back(state.waypoint);
    }
    return chosen;
  };
  CHECK(waypoints(1) == std::vector<std::size_t>{4});
  CHECK(waypoints(2) == std::vector<std::size_t>{4, 10});
  CHECK(waypoints(3) == std::vector<std::size_t>{0, 4, 10});
  CHECK(waypoints(11).size() == 11);
  CHECK(waypoints(50).size() == 11);
}

TEST_CASE("export refuses what does not belong to the scene", "[cli]") {
  const TemporaryFolder folder;
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"export", "--scene"});
    if (std::find(options.begin(), options.end(), "--output") == options.end()) {
      options.insert(options.end(), {"--output", "x.glb"});
    }
    return runCommand(options, folder).refused();
  };
  const std::string robot = dataFile("arm_path.json");
  CHECK(refused({robot, "--samples", "100"}));
  CHECK(refused({robot, "--sigma", "0.1,0.1,0.1"}));
  CHECK(refused({robot, "--poses", "0"}));
  CHECK(refused({robot, "--largest-step", "0"}));
  CHECK(refused({robot, "--output", "x.stl"}));
  CHECK(refused({robot, "--motion", "nowhere.csv"}));
  CHECK(refused({dataFile("finger_mug.json"), "--poses", "3"}));
  CHECK(refused({dataFile("finger_mug.json"), "--still"}));
  CHECK(refused({dataFile("arm_plan.json")}));
  CHECK(refused({"nowhere.json"}));

  folder.write("motion.csv", "turn,elbow\n-0.5,0.5\n0.5,0.5\n");
  const GlbFile file = exported(folder, {"--scene", dataFile("arm_plan.json"), "--motion",
                                         "motion.csv", "--poses", "3", "--largest-step", "0.5"});
  CHECK(waypointGroups(file).size() == 3);
}
#endif
