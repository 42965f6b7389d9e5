// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/fetch_arm.h"

#include <array>
#include <filesystem>

namespace fcl_prob::cli {
namespace {

struct Joint {
  Eigen::Vector3d origin;  ///< in the frame of the link before, metres
  Eigen::Vector3d axis;
  const char* mesh;
};

/// As fetch_description/robots/fetch.urdf has them, from the torso on; rotations of frames are
/// zero.
const std::array<Joint, 7>& joints() {
  static const std::array<Joint, 7> all{{
      {{0.119525, 0, 0.34858}, {0, 0, 1}, "shoulder_pan_link_collision"},
      {{0.117, 0, 0.06}, {0, 1, 0}, "shoulder_lift_link_collision"},
      {{0.219, 0, 0}, {1, 0, 0}, "upperarm_roll_link_collision"},
      {{0.133, 0, 0}, {0, 1, 0}, "elbow_flex_link_collision"},
      {{0.197, 0, 0}, {1, 0, 0}, "forearm_roll_link_collision"},
      {{0.1245, 0, 0}, {0, 1, 0}, "wrist_flex_link_collision"},
      {{0.1385, 0, 0}, {1, 0, 0}, "wrist_roll_link_collision"},
  }};
  return all;
}

constexpr double kGripper = 0.16645;  // metres along x of the last link

// Metres along y from the wrist to the middle of the human arm, where the two touch.
constexpr double kTouching = 0.1;

std::vector<fcl::Transform3d> linkPoses(const Eigen::VectorXd& angles) {
  std::vector<fcl::Transform3d> poses;
  fcl::Transform3d frame = fcl::Transform3d::Identity();
  for (std::size_t i = 0; i < joints().size(); ++i) {
    const double angle = angles[static_cast<Eigen::Index>(i)];
    frame.translate(joints()[i].origin);
    frame.rotate(Eigen::AngleAxisd(angle, joints()[i].axis));
    poses.push_back(frame);
  }
  frame.translate(Eigen::Vector3d(kGripper, 0, 0));
  poses.push_back(frame);
  return poses;
}

std::vector<Geometry> loadLinks(const std::filesystem::path& models) {
  std::vector<Geometry> links;
  const auto load = [&](const std::string& name) {
    const auto path = models / "fetch_robot/fetch_description/meshes" / (name + ".STL");
    links.push_back(buildTree(loadMeshIsolated(path.string()), "obbrss"));
  };
  for (const Joint& joint : joints()) load(joint.mesh);
  load("gripper_link");
  return links;
}

/// The human arm with its middle at the origin.
Geometry loadObstacle(const std::filesystem::path& models) {
  TriangleMesh mesh = loadMeshIsolated((models / "human/human_arm_left_2000.obj").string());
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : mesh.vertices) box.extend(vertex);
  const Eigen::Vector3d middle = box.center();
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex -= middle;
  return buildTree(mesh, "obbrss");
}

}  // namespace

FetchArm::FetchArm(std::vector<Geometry> links, Geometry obstacle)
    : links_(std::move(links)), obstacle_(std::move(obstacle)), query_(links_, {obstacle_}) {}

FetchArm::FetchArm(const std::string& models_folder)
    : FetchArm(loadLinks(models_folder), loadObstacle(models_folder)) {}

RandomJoints FetchArm::configuration(double sigma, double aside) const {
  Eigen::VectorXd mean(7);
  mean << 0.3, 0.4, 0.2, 0.6, -0.3, 0.5, 0.1;
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() =
      linkPoses(mean)[5].translation() + Eigen::Vector3d(0.05, kTouching + aside, 0.05);
  return {mean,
          Eigen::MatrixXd(sigma * sigma * Eigen::MatrixXd::Identity(7, 7)),
          linkPoses,
          {pose},
          GaussianDisplacement::fromStandardDeviations({0.01, 0.01, 0.01})};
}

}  // namespace fcl_prob::cli
