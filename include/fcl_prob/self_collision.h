// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a robot touches itself. In the library fcl_prob::robot.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"
#include "fcl_prob/robot.h"

namespace fcl_prob {

/// Two links that may touch, in either order.
struct LinkPair {
  std::string first;
  std::string second;
};

/// Reads from an SRDF which links of the robot may touch: what its `disable_collisions` name, and
/// every pair with a link of a `disable_default_collisions` that no `enable_collisions` names.
/// Everything else in the file is ignored. It is trusted no more than a URDF: documents with a
/// DOCTYPE, deeper than 64 elements or larger than 16 MiB are refused.
/// \throws FileError naming the file and the element: no SRDF, one of a robot of another name, a
///         link that the robot does not have
std::vector<LinkPair> loadAllowedPairs(const std::string& srdf_file, const Robot& robot);

/// Bodies of a robot, by their index in Robot::bodies(); first < second.
struct BodyPair {
  std::size_t first;
  std::size_t second;
};

/// A robot's bodies against each other, by fcl::collide, and how likely they touch where joints
/// have errors. As there, meshes are surfaces, of which one inside another does not touch it.
///
/// Left out are pairs that may touch, pairs of one link or of two links with a joint between them,
/// and pairs of bodies that do not move relative to each other. For an attached object only the
/// links that it names and what does not move relative to it are left out.
///
/// Const and thread-safe after construction.
class SelfCollision {
 public:
  /// \throws InvalidRequest for an allowed link that the robot does not have; UnsupportedGeometry
  ///         for a pair that fcl::collide does not support; InvalidGeometry
  explicit SelfCollision(const Robot& robot, const std::vector<LinkPair>& allowed = {});

  const Robot& robot() const;

  /// Those that are looked at.
  const std::vector<BodyPair>& pairs() const;

  /// Whether any of pairs() touch. \throws InvalidRequest as Robot::requireWithinLimits()
  bool collides(const Eigen::VectorXd& values) const;

  /// Which of pairs() touch. \throws as collides()
  std::vector<BodyPair> collisions(const Eigen::VectorXd& values) const;

  /// The same of poses (metres, world frame) as Robot::poses() gives them, whatever the joints are.
  bool collidesAt(const std::vector<fcl::Transform3d>& poses) const;

  /// P that any of pairs() touch, where joints have Gaussian errors: counted, with its standard
  /// error and an interval that covers P with the request's confidence; against a threshold until
  /// that is decided. What is drawn may be beyond limits.
  /// \param values            about which the joints are, within their limits
  /// \param joint_covariance  radians, metres; in the order of Robot::joints(), of any rank: see
  ///                          jointCovariance()
  /// \throws InvalidRequest as collides(), and for a method other than automatic and monte_carlo, a
  ///         gradient, a band, or a contact other than fcl; InvalidDistribution
  ProbabilityResult probability(const Eigen::VectorXd& values,
                                const Eigen::MatrixXd& joint_covariance,
                                const ProbabilityRequest& request) const;

 private:
  struct Implementation;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace fcl_prob
