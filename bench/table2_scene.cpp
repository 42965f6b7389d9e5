// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_scene.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "bench/least_distance.h"
#include "cli/geometry.h"
#include "cli/number_text.h"
#include "fcl_prob/mesh_io.h"

namespace fcl_prob::cli {
namespace {

const std::vector<std::string>& armJoints() {
  static const std::vector<std::string> all{
      "shoulder_pan_joint", "shoulder_lift_joint", "upperarm_roll_joint", "elbow_flex_joint",
      "forearm_roll_joint", "wrist_flex_joint",    "wrist_roll_joint"};
  return all;
}

const std::vector<std::string>& armLinks() {
  static const std::vector<std::string> all{
      "shoulder_pan_link",     "shoulder_lift_link",   "upperarm_roll_link", "elbow_flex_link",
      "forearm_roll_link",     "wrist_flex_link",      "wrist_roll_link",    "gripper_link",
      "l_gripper_finger_link", "r_gripper_finger_link"};
  return all;
}

fcl::Transform3d placed(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

GaussianDisplacement spread(double x, double y, double z) {
  return GaussianDisplacement::fromStandardDeviations({x, y, z});
}

// Of the arm that waves, down and up again once; predicted every tenth of a second.
constexpr double kSecondsOfWave = 6.0;
constexpr int kPredictions = 61;
constexpr int kSingleArms = 4;
constexpr double kPiOfScene = 3.14159265358979323846;

// Of the human's shoulder in front of the robot, metres: in the scenes that the paper's rows start
// in, and where the states of docs/states.md are closer.
const Eigen::Vector3d kShoulderOfCans(1.42, 0.0, 0.88);
const Eigen::Vector3d kShoulderOfWaving(1.40, 0.03, 1.0);
const Eigen::Vector3d kShoulderCloseBy(1.36, 0.03, 1.0);

class Table2Models {
 public:
  explicit Table2Models(const std::string& folder) : models_(folder) {
    const auto fetch = models_ / "fetch_robot";
    RobotOptions options;
    options.packages["fetch_description"] = (fetch / "fetch_description").string();
    const std::string urdf = (fetch / "fetch_description/robots/fetch.urdf").string();
    whole_.emplace(urdf, options);
    options.links = armLinks();
    arm_.emplace(urdf, options);
    allowed_ = loadAllowedPairs((fetch / "fetch.srdf").string(), *whole_);
    can_ = buildTree(load("objects/coke_can_500.obj"), "obbrss");
    TriangleMesh human = load("human/human_arm_left_2000.obj");
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : human.vertices) box.extend(vertex);
    // Its shoulder at the origin, the hand along x.
    const Eigen::Vector3d shoulder(box.min().x(), box.center().y(), box.center().z());
    for (Eigen::Vector3d& vertex : human.vertices) vertex -= shoulder;
    human_arm_ = buildTree(human, "obbrss");
  }

  Table2Scene cans() const {
    const AttachedObject held{"held can",
                              "gripper_link",
                              can_,
                              placed(0.0, 0.0, -0.0645),
                              {"l_gripper_finger_link", "r_gripper_finger_link"}};
    std::vector<Obstacle> obstacles{
        {"can", can_, placed(0.72, -0.15, 0.68), spread(0.01, 0.01, 0.002)},
        {"other can", can_, placed(0.72, 0.10, 0.68), spread(0.01, 0.01, 0.002)},
        {"human arm", human_arm_, armFrom(kShoulderOfCans, 0.04), spread(0.03, 0.02, 0.02)}};
    return {"cans",
            SelfCollision(whole_->withAttached(held), allowed_),
            {{std::make_shared<fcl::Boxd>(0.7, 1.4, 0.04), placed(0.85, 0.0, 0.66)}},
            state({0.065, -0.258, -0.555, 1.794, 0.917, -1.092, 0.260}),
            state({-0.263, -0.143, 0.968, 1.845, -0.800, -0.789, -0.616}),
            armJoints(),
            {std::make_shared<Table2Around>(
                RobotQuery(arm_->withAttached(held), std::move(obstacles)))}};
  }

  Table2Scene waving() const {
    std::vector<Obstacle> arms;
    for (int k = 0; k < kPredictions; ++k) {
      const double part = k / (kPredictions - 1.0), down = 0.45 * std::cos(2.0 * kPiOfScene * part);
      arms.push_back(predicted(kShoulderOfWaving, kSecondsOfWave * part, down, 0.01 + 0.03 * part));
    }
    Table2Scene scene = pastArms("waving", arms);
    scene.end = kSecondsOfWave;
    return scene;
  }

  std::vector<Table2Scene> singleArms() const {
    std::vector<Table2Scene> scenes;
    for (int k = 0; k < kSingleArms; ++k) {
      scenes.push_back(
          pastArms("arm at " + std::to_string(k) + " s",
                   {predicted(kShoulderCloseBy, k, 0.45 - 0.3 * k, 0.01 * (k + 1.0))}));
    }
    return scenes;
  }

 private:
  TriangleMesh load(const std::string& file) const {
    return loadMeshIsolated((models_ / file).string());
  }

  /// \param down, sigma  radians and metres
  Obstacle predicted(const Eigen::Vector3d& shoulder, double seconds, double down,
                     double sigma) const {
    return {"human arm at " + numberText(seconds, 3) + " s", human_arm_, armFrom(shoulder, down),
            spread(sigma, sigma, 0.5 * sigma)};
  }

  /// \param arms  one at a time
  Table2Scene pastArms(const std::string& name, const std::vector<Obstacle>& arms) const {
    Table2Scene scene{name,
                      SelfCollision(*whole_, allowed_),
                      {},
                      state({-0.304, -0.794, -0.016, 1.898, 0.664, -1.186, -0.272}),
                      state({-0.132, 0.786, -0.835, -1.871, 0.423, 0.755, 0.261}),
                      armJoints(),
                      {}};
    const RobotQuery first(*arm_, {arms.front()});
    for (const Obstacle& arm : arms) {
      scene.around.push_back(std::make_shared<Table2Around>(first.withObstacles({arm})));
    }
    return scene;
  }

  /// The human's arm stretched out towards the robot; `down`: its slope, radians.
  static fcl::Transform3d armFrom(const Eigen::Vector3d& shoulder, double down) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = shoulder;
    pose.rotate(Eigen::AngleAxisd(kPiOfScene, Eigen::Vector3d::UnitZ()));
    pose.rotate(Eigen::AngleAxisd(down, Eigen::Vector3d::UnitY()));
    pose.rotate(Eigen::AngleAxisd(0.5 * kPiOfScene, Eigen::Vector3d::UnitX()));
    return pose;
  }

  Eigen::VectorXd state(const std::vector<double>& angles) const {
    std::map<std::string, double> values{{"torso_lift_joint", 0.2},
                                         {"l_gripper_finger_joint", 0.035},
                                         {"r_gripper_finger_joint", 0.035}};
    for (std::size_t i = 0; i < angles.size(); ++i) values[armJoints()[i]] = angles[i];
    return arm_->values(values);
  }

  std::filesystem::path models_;
  std::optional<Robot> whole_;
  std::optional<Robot> arm_;
  std::vector<LinkPair> allowed_;
  Geometry can_;
  Geometry human_arm_;
};

}  // namespace

Table2State Table2Scene::at(const TimedWaypoint& state) const {
  const auto last = static_cast<double>(around.size() - 1);
  const double part = isTimed() ? std::clamp(state.time / end, 0.0, 1.0) : 0.0;
  const Table2Around& by_then = *around[static_cast<std::size_t>(std::lround(part * last))];
  return {state.values, by_then.query, by_then.screen};
}

bool Table2Scene::isFree(const Eigen::VectorXd& values) const {
  if (self.collides(values)) return false;
  const auto poses = robot().poses(values);
  const auto touches = [&](const ExactObstacle& obstacle) {
    return touchesAny(robot(), poses, *obstacle.geometry, obstacle.pose);
  };
  return std::none_of(exact.begin(), exact.end(), touches);
}

std::vector<Table2Scene> table2Scenes(const std::string& models_folder) {
  const Table2Models models(models_folder);
  std::vector<Table2Scene> scenes;
  scenes.push_back(models.cans());
  scenes.push_back(models.waving());
  return scenes;
}

std::vector<Table2Scene> singleArmScenes(const std::string& models_folder) {
  return Table2Models(models_folder).singleArms();
}

}  // namespace fcl_prob::cli
