// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The density from which rare events are sampled.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "base/random_words.h"
#include "sampling/obstacle_cover.h"

namespace fcl_prob::detail {

/// An elliptic component of the mixture: a multivariate t distribution with four degrees of
/// freedom, whose tails are heavier than those of any set under the normal density.
struct MixtureComponent {
  double weight;           ///< of all components together 1
  Eigen::Vector3d centre;  ///< whitened frame; coordinates that do not move are 0
  Eigen::Matrix3d
      scatter;  ///< its leading rank x rank block is positive definite, the rest ignored
};

/// A defensive mixture in the whitened frame (Hesterberg 1995): with probability `cover_share` the
/// standard normal within the cover (in a box of it, chosen by its mass: Karp & Luby's estimator of
/// a union); else one of the components. As nothing collides outside the cover, the first part
/// bounds the weight of every hit by the mass of the cover / cover_share.
class ImportanceDensity {
 public:
  /// \param rank  1 to 3: the number of coordinates that move
  /// \param cover  not empty
  ImportanceDensity(int rank, ObstacleCover cover, double cover_share,
                    const std::vector<MixtureComponent>& components);

  Eigen::Vector3d sample(RandomStream stream, std::uint64_t index) const;

  /// q(y) / φ(y) at a point that collides, φ being the standard normal density: it counts for its
  /// inverse, which is at most largestWeight().
  double ratio(const Eigen::Vector3d& y) const;

  /// The largest weight 1 / ratio(y) that a point of the cover can have.
  double largestWeight() const { return cover_.mass / cover_share_; }

 private:
  struct Prepared {
    double cumulated;  // of the weights up to this component
    double log_scale;  // log(weight) - log(det(root)) and the constants of the density
    Eigen::Vector3d centre;
    Eigen::Matrix3d root;  // Cholesky factor of the scatter, zero outside the moving block
    Eigen::Matrix3d inverse_root;
  };

  Eigen::Vector3d sampleShell(RandomStream stream, std::uint64_t index, double uniform) const;
  Eigen::Vector3d sampleBoxes(RandomStream stream, std::uint64_t index, double choice) const;
  double coverCount(const Eigen::Vector3d& y) const;

  int rank_;
  ObstacleCover cover_;
  double cover_share_;
  std::vector<Prepared> components_;
};

}  // namespace fcl_prob::detail
