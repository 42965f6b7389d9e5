// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Stiff and extreme scenes whose probability is known.
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/random_words.h"
#include "bench/stability_truth.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::cli {

/// The absolute tolerance asked for where P itself is not small.
inline constexpr double kAbsoluteTolerance = 1e-12;

/// The same where small P is what the family is about.
inline constexpr double kTinyTolerance = 1e-303;

/// Random numbers that a seed, a family and the number of a case determine.
class StabilityRandom {
 public:
  StabilityRandom(std::uint64_t seed, std::uint64_t family, std::uint64_t index)
      : stream_{seed, family}, index_(index) {}

  double uniform(double lo, double hi);
  double logUniform(double lo, double hi);
  bool coin() { return uniform(0, 1) < 0.5; }
  int integer(int lo, int hi);  ///< both included
  Eigen::Vector3d uniformVector(double lo, double hi);
  Eigen::Quaterniond rotation();

 private:
  detail::RandomStream stream_;
  std::uint64_t index_;
  std::uint64_t block_ = 0;
  std::array<std::uint64_t, 4> words_{};
  std::size_t used_ = 4;
};

struct StabilityCase {
  std::shared_ptr<const fcl::CollisionGeometryd> a, b;
  fcl::Transform3d pose_a = fcl::Transform3d::Identity();
  fcl::Transform3d pose_b = fcl::Transform3d::Identity();
  std::vector<GaussianMixture::Component> displacement;  ///< one, or a mixture
  ContactMeaning contact = ContactMeaning::fcl;
  Truth truth;
  std::optional<Truth> nearby;  ///< of P with all inputs moved by one ε, where that is known
};

/// Scenes of one kind.
struct StabilityFamily {
  std::string name;
  std::string objects;
  std::vector<ProbabilityMethod> methods;
  double absolute_tolerance;  ///< what an answer may be off by however small P is
  std::function<StabilityCase(StabilityRandom&)> make;
};

std::vector<StabilityFamily> stabilityFamilies();

/// Two boxes whose sides are along the principal axes of the displacement: the C-obstacle is a box
/// in the whitened frame.
struct BoxScene {
  Eigen::Vector3d half_a, half_b;                  ///< half sides
  Eigen::Vector3d at_a, at_b;                      ///< world frame
  Eigen::Vector3d sigma;                           ///< along the axes of `turn`
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();  ///< world frame
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  bool covariance_matrix = false;  ///< pass Σ as a matrix (only if not turned)

  bool isTurned() const { return turn.vec() != Eigen::Vector3d::Zero(); }
  GaussianDisplacement displacement() const;

  /// Of the boxes as solids or, if not `solid`, as surfaces: then one inside the other is free.
  Truth truth(bool solid) const;

  /// The least and the largest that P may be with lengths and positions moved by one ε each.
  Truth nearby(bool solid) const;

  /// What the boxes are turned by: the axes that the displacement reports, in the order of sigma.
  Eigen::Matrix3d frame() const;

 private:
  Truth truthWithin(bool solid, const std::array<Precise, 3>& slack) const;
};

/// How the boxes of a scene are made.
enum class BoxForm { shapes, surfaces, solids };

/// A change of the meshes that does not change the surface.
using MeshChange = std::function<void(TriangleMesh&, StabilityRandom&)>;

StabilityCase boxCase(const BoxScene& scene, BoxForm form, StabilityRandom& random,
                      const MeshChange& change = {});

/// Families without boxes on both sides.
std::vector<StabilityFamily> otherStabilityFamilies();

}  // namespace fcl_prob::cli
