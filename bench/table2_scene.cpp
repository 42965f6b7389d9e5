// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_scene.h"

#include <filesystem>

#include "cli/geometry.h"
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

/// A box as a mesh, since only meshes have convex parts. Sides in metres, its middle at the origin.
TriangleMesh tableMesh(const Eigen::Vector3d& sides) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs((corner & 1) - 0.5, (corner >> 1 & 1) - 0.5, (corner >> 2) - 0.5);
    mesh.vertices.push_back(sides.cwiseProduct(signs));
  }
  // Counter-clockwise from outside.
  const std::size_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                   {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& quad : quads) {
    mesh.triangles.emplace_back(quad[0], quad[1], quad[2]);
    mesh.triangles.emplace_back(quad[0], quad[2], quad[3]);
  }
  return mesh;
}

fcl::Transform3d placed(double x, double y, double z) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, z);
  return pose;
}

GaussianDisplacement spread(double x, double y, double z) {
  return GaussianDisplacement::fromStandardDeviations({x, y, z});
}

// Of the arm that waves, one a second.
constexpr int kPredictions = 4;

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
        {"table", buildTree(tableMesh({0.7, 1.4, 0.04}), "obbrss"), placed(0.85, 0.0, 0.66),
         spread(0.003, 0.003, 0.003)},
        {"can", can_, placed(0.72, -0.15, 0.68), spread(0.01, 0.01, 0.002)},
        {"other can", can_, placed(0.66, 0.17, 0.68), spread(0.01, 0.01, 0.002)},
        {"human arm", human_arm_, armFrom({1.38, 0.0, 0.84}, 0.04), spread(0.03, 0.02, 0.02)}};
    return {"cans",
            RobotQuery(arm_->withAttached(held), std::move(obstacles)),
            SelfCollision(whole_->withAttached(held), allowed_),
            state({0.065, -0.258, -0.555, 1.794, 0.917, -1.092, 0.260}),
            state({-0.247, -0.026, 0.909, 1.776, -0.909, -0.825, -0.598}),
            armJoints()};
  }

  Table2Scene waving() const {
    std::vector<Obstacle> obstacles;
    for (int k = 0; k < kPredictions; ++k) obstacles.push_back(predicted(k));
    return pastArms("waving", std::move(obstacles));
  }

  std::vector<Table2Scene> singleArms() const {
    std::vector<Table2Scene> scenes;
    for (int k = 0; k < kPredictions; ++k) {
      scenes.push_back(pastArms("arm at " + std::to_string(k) + " s", {predicted(k)}));
    }
    return scenes;
  }

 private:
  TriangleMesh load(const std::string& file) const {
    return loadMeshIsolated((models_ / file).string());
  }

  Obstacle predicted(int second) const {
    const double sigma = 0.01 * (second + 1);  // metres
    return {"human arm at " + std::to_string(second) + " s", human_arm_,
            armFrom({1.36, 0.03, 1.0}, 0.45 - 0.3 * second), spread(sigma, sigma, 0.5 * sigma)};
  }

  Table2Scene pastArms(const std::string& name, std::vector<Obstacle> obstacles) const {
    return {name,
            RobotQuery(*arm_, std::move(obstacles)),
            SelfCollision(*whole_, allowed_),
            state({-0.304, -0.794, -0.016, 1.898, 0.664, -1.186, -0.272}),
            state({-0.132, 0.786, -0.835, -1.871, 0.423, 0.755, 0.261}),
            armJoints()};
  }

  /// The human's arm stretched out towards the robot; `down`: its slope, radians.
  static fcl::Transform3d armFrom(const Eigen::Vector3d& shoulder, double down) {
    fcl::Transform3d pose = fcl::Transform3d::Identity();
    pose.translation() = shoulder;
    pose.rotate(Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitZ()));
    pose.rotate(Eigen::AngleAxisd(down, Eigen::Vector3d::UnitY()));
    pose.rotate(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitX()));
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
