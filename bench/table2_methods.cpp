// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "bench/table2_methods.h"

#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <limits>

#include "cli/random_frames.h"
#include "fcl_prob/part_tree.h"
#include "fcl_prob/parts_bounds.h"
#include "geometry/mesh_visitor.h"
#include "robot/state_screen.h"

namespace fcl_prob::cli {
namespace {

using Poses = std::vector<fcl::Transform3d>;

constexpr int kSamplesOfState = 10'000;

/// Of the paper's models; ours are cut into no more, so that the bounds end.
constexpr std::size_t kMostPartsOfMesh = 8;

const GaussianDisplacement& gaussianOf(const Obstacle& obstacle) {
  return std::get<GaussianDisplacement>(obstacle.displacement);
}

bool doCollide(const fcl::CollisionGeometryd& a, const fcl::Transform3d& pose_a,
               const fcl::CollisionGeometryd& b, const fcl::Transform3d& pose_b) {
  fcl::CollisionResultd result;
  return fcl::collide(&a, pose_a, &b, pose_b, fcl::CollisionRequestd(), result) > 0;
}

/// Displaced obstacles, the same samples at every state.
class MonteCarloRow {
 public:
  MonteCarloRow(const Table2Scene& scene, std::uint64_t seed) : scene_(scene) {
    for (std::size_t j = 0; j < scene.query.obstacles().size(); ++j) {
      const Whitening whitening(gaussianOf(scene.query.obstacles()[j]));
      std::vector<Eigen::Vector3d> moved;
      for (std::uint64_t i = 0; i < kSamplesOfState; ++i) {
        moved.push_back(randomDisplacement(whitening, seed + 1000 * j, i));
      }
      moved_.push_back(std::move(moved));
    }
  }

  double operator()(const Eigen::VectorXd& values, double enough) const {
    const Poses poses = scene_.query.robot().poses(values);
    int hits = 0;
    for (std::size_t i = 0; i < kSamplesOfState; ++i) {
      hits += isHit(poses, i);
      if (hits >= enough * kSamplesOfState) break;
    }
    return static_cast<double>(hits) / kSamplesOfState;
  }

 private:
  bool isHit(const Poses& poses, std::size_t sample) const {
    const auto& obstacles = scene_.query.obstacles();
    const auto& bodies = scene_.query.robot().bodies();
    for (std::size_t j = 0; j < obstacles.size(); ++j) {
      fcl::Transform3d pose = obstacles[j].pose;
      pose.translation() += moved_[j][sample];
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (doCollide(*bodies[i].geometry, poses[i], *obstacles[j].geometry, pose)) return true;
      }
    }
    return false;
  }

  const Table2Scene& scene_;
  std::vector<std::vector<Eigen::Vector3d>> moved_;
};

/// Collision with obstacles that are thicker by so many of their largest standard deviations.
class PaddingRow {
 public:
  PaddingRow(const Table2Scene& scene, double deviations) : scene_(scene), deviations_(deviations) {
    for (const RobotBody& body : scene.query.robot().bodies()) {
      body_balls_.push_back(detail::ballAround({body.geometry, body.name()}));
    }
    for (const Obstacle& obstacle : scene.query.obstacles()) {
      const detail::Ball ball = detail::ballAround({obstacle.geometry, obstacle.name});
      obstacle_balls_.push_back(ball.placed(obstacle.pose));
    }
  }

  double operator()(const Eigen::VectorXd& values, double) const {
    const Poses poses = scene_.query.robot().poses(values);
    const auto& bodies = scene_.query.robot().bodies();
    for (std::size_t j = 0; j < obstacle_balls_.size(); ++j) {
      const Obstacle& obstacle = scene_.query.obstacles()[j];
      const double padding = deviations_ * gaussianOf(obstacle).standardDeviations().maxCoeff();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const detail::Ball ball = body_balls_[i].placed(poses[i]);
        if (isBeyond(ball, obstacle_balls_[j], padding)) continue;
        if (isWithin(*bodies[i].geometry, poses[i], obstacle, padding)) return 1.0;
      }
    }
    return 0.0;
  }

 private:
  // fcl::distance has no limit beyond which it stops; a broad phase leaves these out.
  static bool isBeyond(const detail::Ball& x, const detail::Ball& y, double padding) {
    return (x.centre - y.centre).norm() > x.radius + y.radius + padding;
  }

  static bool isWithin(const fcl::CollisionGeometryd& body, const fcl::Transform3d& pose,
                       const Obstacle& obstacle, double padding) {
    if (doCollide(body, pose, *obstacle.geometry, obstacle.pose)) return true;
    fcl::DistanceResultd result;
    return fcl::distance(&body, pose, obstacle.geometry.get(), obstacle.pose,
                         fcl::DistanceRequestd(), result) <= padding;
  }

  const Table2Scene& scene_;
  double deviations_;
  std::vector<detail::Ball> body_balls_;      ///< frames of the bodies
  std::vector<detail::Ball> obstacle_balls_;  ///< world frame
};

/// Convex parts of all bodies and obstacles.
struct SceneParts {
  explicit SceneParts(const Table2Scene& scene) {
    for (const RobotBody& body : scene.query.robot().bodies()) bodies.push_back(of(*body.geometry));
    for (const Obstacle& obstacle : scene.query.obstacles()) {
      obstacles.push_back(of(*obstacle.geometry));
    }
  }

  static ConvexParts of(const fcl::CollisionGeometryd& mesh) {
    DecompositionRequest request;
    request.max_parts = kMostPartsOfMesh;
    request.pieces = 4 * kMostPartsOfMesh;
    return ConvexParts(triangleMesh(detail::meshView(mesh)), request);
  }

  std::vector<ConvexParts> bodies;
  std::vector<ConvexParts> obstacles;
};

/// Adds up what `upper` says of every body and obstacle.
template <typename Upper>
double summed(const Table2Scene& scene, const Eigen::VectorXd& values, double enough,
              const Upper& upper) {
  const Poses poses = scene.query.robot().poses(values);
  double sum = 0.0;
  for (std::size_t j = 0; j < scene.query.obstacles().size(); ++j) {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      sum += upper(i, poses[i], j, scene.query.obstacles()[j]);
      if (sum >= enough) return sum;
    }
  }
  return sum;
}

/// The printed sum over trees of convex parts.
class TreesRow {
 public:
  TreesRow(const Table2Scene& scene, const SceneParts& parts, PartVolume volume) : scene_(scene) {
    for (const ConvexParts& of_one : parts.bodies) bodies_.emplace_back(of_one, volume);
    for (const ConvexParts& of_one : parts.obstacles) obstacles_.emplace_back(of_one, volume);
  }

  double operator()(const Eigen::VectorXd& values, double enough) const {
    GeneralPcdRequest request;
    request.stop_at_one = true;
    return summed(scene_, values, enough,
                  [&](std::size_t body, const fcl::Transform3d& pose, std::size_t index,
                      const Obstacle& obstacle) {
                    return generalPcd(bodies_[body], pose, obstacles_[index], obstacle.pose,
                                      gaussianOf(obstacle).reversed(), request)
                        .raw_sum;
                  });
  }

 private:
  const Table2Scene& scene_;
  std::vector<PartTree> bodies_;
  std::vector<PartTree> obstacles_;
};

/// Hunter's bound for the parts of a body and an obstacle.
class HunterRow {
 public:
  HunterRow(const Table2Scene& scene, std::shared_ptr<const SceneParts> parts)
      : scene_(scene), parts_(std::move(parts)) {}

  double operator()(const Eigen::VectorXd& values, double enough) const {
    return summed(scene_, values, enough,
                  [&](std::size_t body, const fcl::Transform3d& pose, std::size_t index,
                      const Obstacle& obstacle) {
                    return partsBounds(parts_->bodies[body], pose, parts_->obstacles[index],
                                       obstacle.pose, gaussianOf(obstacle).reversed())
                        .any.upper;
                  });
  }

 private:
  const Table2Scene& scene_;
  std::shared_ptr<const SceneParts> parts_;
};

constexpr std::size_t kCellsOfDecision = 2'000;

/// Ours: as planCertified() decides.
class CertifiedRow {
 public:
  CertifiedRow(const Table2Scene& scene, std::shared_ptr<const detail::StateScreen> screen,
               double threshold)
      : scene_(scene), screen_(std::move(screen)) {
    request_.threshold = threshold;
    request_.relative_tolerance = 0.05;
    request_.max_cells = kCellsOfDecision;
  }

  double operator()(const Eigen::VectorXd& values, double enough) const {
    if (screen_->isBelow(values, enough)) return 0.0;
    if (screen_->isHardlyBelow(values, enough)) return 1.0;
    return scene_.query.state(values, request_).decision == Decision::below ? 0.0 : 1.0;
  }

 private:
  const Table2Scene& scene_;
  std::shared_ptr<const detail::StateScreen> screen_;
  ProbabilityRequest request_;
};

/// Ours, too, and never certified: after the same screens, from the first of bounds, cells and
/// samples that tells.
class ProbableRow {
 public:
  ProbableRow(const Table2Scene& scene, std::shared_ptr<const detail::StateScreen> screen,
              double threshold, std::uint64_t seed)
      : scene_(scene), screen_(std::move(screen)), threshold_(threshold) {
    request_.max_cells = kCellsOfDecision;
    request_.seed = seed;
  }

  double operator()(const Eigen::VectorXd& values, double enough) const {
    if (screen_->isBelow(values, enough)) return 0.0;
    if (screen_->isHardlyBelow(values, enough)) return 1.0;
    const ProbableDecision decision =
        scene_.query.decideProbably({values}, threshold_, kChanceOfError, request_).decision;
    const bool below = decision == ProbableDecision::certainly_below ||
                       decision == ProbableDecision::probably_below;
    return below ? 0.0 : 1.0;
  }

 private:
  const Table2Scene& scene_;
  std::shared_ptr<const detail::StateScreen> screen_;
  double threshold_;
  ProbabilityRequest request_;
};

}  // namespace

std::vector<Table2Method> table2Methods(const Table2Scene& scene, double threshold,
                                        std::uint64_t seed) {
  const auto parts = std::make_shared<const SceneParts>(scene);
  std::vector<Table2Method> methods;
  const auto screen = std::make_shared<const detail::StateScreen>(scene.query.among());
  methods.push_back(
      {"certified decision", "", CertifiedRow(scene, screen, threshold), Table2Answer::certified});
  methods.push_back({"probable decision", "", ProbableRow(scene, screen, threshold, seed),
                     Table2Answer::probable});
  methods.push_back({"padding by 2 sigma", "", PaddingRow(scene, 2.0), Table2Answer::padding});
  methods.push_back({"padding by 3 sigma", "", PaddingRow(scene, 3.0), Table2Answer::padding});
  const std::vector<std::pair<std::string, PartVolume>> volumes{{"sphere", PartVolume::sphere},
                                                                {"aabb", PartVolume::aabb},
                                                                {"obb", PartVolume::obb},
                                                                {"kdop26", PartVolume::kdop26},
                                                                {"convex", PartVolume::convex}};
  for (const auto& [name, volume] : volumes) {
    methods.push_back({name + ", printed sum", name, TreesRow(scene, *parts, volume)});
  }
  methods.push_back({"convex, Hunter's bound", "", HunterRow(scene, parts)});
  methods.push_back({"Monte Carlo, 10,000 samples", "monte-carlo", MonteCarloRow(scene, seed)});
  return methods;
}

}  // namespace fcl_prob::cli
