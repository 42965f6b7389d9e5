// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random configurations: whatever places the members of two groups, and is not only a translation.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"
#include "fcl_prob/pose_error.h"

namespace fcl_prob {

/// Where everything is, up to one Gaussian translation.
struct PlacedConfiguration {
  std::vector<fcl::Transform3d> poses_a;  ///< of the members of A, metres, world frame
  std::vector<fcl::Transform3d> poses_b;
  GaussianDisplacement displacement;  ///< that all of A has relative to all of B besides
};

/// A random configuration z ~ N(0, I) places the members of two groups; given z, A is displaced
/// relative to B by a Gaussian translation. A pose error, errors in the joints of an arm and a base
/// that is localised badly are all of this kind.
///
/// Implementations are immutable: at() may be called from several threads.
class RandomConfiguration {
 public:
  virtual ~RandomConfiguration() = default;

  /// Of z; 0 if only the displacement is random.
  virtual int dimension() const = 0;

  /// \param z  as many standard normals as dimension()
  virtual PlacedConfiguration at(const Eigen::VectorXd& z) const = 0;
};

/// Two rigid groups, each with an error of its own: of the pose of a frame that carries it.
class RandomPoses : public RandomConfiguration {
 public:
  /// A group that moves as one, with the frame whose pose is uncertain.
  struct Body {
    std::vector<fcl::Transform3d> members;  ///< where they are without error, metres, world frame
    fcl::Transform3d frame = fcl::Transform3d::Identity();  ///< the same of the frame
    PoseError error;                                        ///< of the frame's pose
  };

  /// \throws InvalidPose
  RandomPoses(Body a, Body b);
  ~RandomPoses() override;

  /// One body that is at `pose_a` up to `error`, and another one that stays.
  static RandomPoses ofOne(const fcl::Transform3d& pose_a, const PoseError& error,
                           const fcl::Transform3d& pose_b);

  int dimension() const override;
  PlacedConfiguration at(const Eigen::VectorXd& z) const override;

 private:
  struct Side;
  std::shared_ptr<const Side> a_;
  std::shared_ptr<const Side> b_;
};

/// An arm whose joint values are Gaussian, beside obstacles with a Gaussian translation.
///
/// Nothing here knows limits of joints: neither the mean nor what is drawn around it is held
/// against any, and values beyond them count as the kinematics place them. randomJoints() in
/// robot_joints.h makes one of a Robot and refuses a mean beyond the limits.
class RandomJoints : public RandomConfiguration {
 public:
  /// The poses of the members of A (metres, world frame) at joint values. Called from several
  /// threads; must not throw for values within a few standard deviations of the mean.
  using ForwardKinematics = std::function<std::vector<fcl::Transform3d>(const Eigen::VectorXd&)>;

  /// \param mean, covariance  of the joint values, in the unit that `kinematics` takes (radians or
  ///                          metres); the covariance of any rank
  /// \param poses_b           metres, world frame
  /// \param displacement      of A relative to B besides, metres, world frame
  /// \throws InvalidDistribution if the mean or covariance is not finite, their sizes differ, or
  /// the
  ///         covariance is not symmetric (1e-9) and positive semidefinite (1e-12, as correlation)
  RandomJoints(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
               ForwardKinematics kinematics, std::vector<fcl::Transform3d> poses_b,
               const GaussianDisplacement& displacement);

  int dimension() const override { return static_cast<int>(factor_.cols()); }
  PlacedConfiguration at(const Eigen::VectorXd& z) const override;

 private:
  Eigen::VectorXd mean_;
  Eigen::MatrixXd factor_;
  ForwardKinematics kinematics_;
  std::vector<fcl::Transform3d> poses_b_;
  GaussianDisplacement displacement_;
};

/// A configuration whose group A is carried by a base with an error of its own, independent of the
/// rest: an arm on a robot that is localised badly.
class RandomBase : public RandomConfiguration {
 public:
  /// \param base  pose of the frame that `error` is of, metres, world frame
  /// \throws InvalidPose
  RandomBase(std::shared_ptr<const RandomConfiguration> carried, const fcl::Transform3d& base,
             const PoseError& error);
  ~RandomBase() override;

  int dimension() const override;
  PlacedConfiguration at(const Eigen::VectorXd& z) const override;

 private:
  struct Base;
  std::shared_ptr<const RandomConfiguration> carried_;
  std::shared_ptr<const Base> base_;
};

}  // namespace fcl_prob
