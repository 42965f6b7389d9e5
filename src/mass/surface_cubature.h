// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of bodies as integrals over the patches of their boundary, with a proven bound on the
// error.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "base/constants.h"
#include "base/interruption.h"
#include "fcl_prob/bounds.h"
#include "fcl_prob/polytope_mass.h"
#include "mass/part_cubature.h"
#include "mass/part_rules.h"
#include "mass/surface_patch.h"

namespace fcl_prob::detail {

/// A sum over patches and a bound on its error (the moment's: of each component).
struct SurfaceSum {
  double mass = 0.0, error = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double moment_error = 0.0;
  /// Of the points that rules looked at, the one nearest to the origin.
  Eigen::Vector3d nearest = Eigen::Vector3d::Constant(kInfinity);
};

/// Adds up the flux of F = -e ∫₀^∞ φ(x + τ e) dτ, which has the divergence φ(x) for any e: through
/// a closed surface that is the mass within. In coordinates with e = e_z it is -e_z φ(x) φ(y) Q(z),
/// Q(z) = erfc(z/√2)/2. It is accurate in the tail where e is about towards the nearest point, and
/// analytic everywhere: |F| <= exp((|Im x|² - |Re x|²)/2) / 2π where Re z >= 0, and where Re z < 0
/// the same but for Re z, so for Re x beyond a plane n·x >= d >= 0, n_z >= 0, in any case
/// |F| <= exp((|Im x|² - d²)/2) / 2π.
///
/// Rules and their errors are as in PartCubature, of two parameters.
///
/// The moment ∫ y φ(y) dy within is the flux of -φ e_x, -φ e_y and -φ e_z, whose bound is that of
/// 2π F over (2π)^(3/2): the same rules serve, chosen for the largest component of the area.
class SurfaceCubature {
 public:
  /// \param interruption  outlives this; once it is due, nothing is known of what is left
  /// \param axes  as rows: about orthonormal, the last is e
  /// \param displacement    how far the patches may be from the true surface
  /// \param components  all: the moment is found besides, of the surface as it is
  SurfaceCubature(const CubatureLimits& limits, const Interruption& interruption,
                  const Eigen::Matrix3d& axes, double displacement, AreaComponents components)
      : limits_(limits),
        interruption_(interruption),
        axes_(axes),
        displacement_(displacement),
        components_(components) {}

  void add(const SurfacePatch& patch);

  const SurfaceSum& sum() const { return sum_; }
  bool exhausted() const { return cells_ >= limits_.most_cells; }

 private:
  void addBox(const SurfacePatch& patch, const ParameterBox& box, int depth);
  void divideWhereBent(const SurfacePatch& patch, const ParameterBox& box,
                       const NormalChanges& changes, int depth);
  double layerOver(const PatchCell& cell, const ParameterBox& box, const PartBound& real) const;
  double layerAt(double reach) const;
  void evaluate(const SurfacePatch& patch, const PatchCell& cell, const ParameterBox& box,
                const std::array<double, 3>& points);
  bool withMoment() const { return components_ == AreaComponents::all; }

  CubatureLimits limits_;
  const Interruption& interruption_;
  Eigen::Matrix3d axes_;
  double displacement_;
  AreaComponents components_;
  std::size_t cells_ = 0;
  std::array<std::size_t, 3> guess_{5, 5, 5};
  SurfaceSum sum_;
};

/// What is asked of massWithin().
struct SurfaceEffort {
  /// Errors of all rules together next to the mass: tried for, and enough.
  double target = 8e-8, enough = 4.5e-7;
  /// Rows: about orthonormal, the last one towards the nearest point.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// How far the surface may be from the true one, which counts as error.
  double displacement = 0.0;
  /// The moment ∫ y φ(y) dy as well, which takes somewhat more points.
  bool with_moment = false;
};

struct SurfaceMass {
  Bounds mass{0.0, 1.0};
  std::optional<VectorBounds> moment;
  /// A point of the surface near the origin; none if no rule looked at any.
  std::optional<Eigen::Vector3d> nearest;
};

/// The mass within a closed surface that goes once around what it encloses, as far as cubature and
/// the rounding of its terms tell: lower may be negative.
/// \param guess  of the mass; not too small. What it is wrong by costs time only.
SurfaceMass massWithin(const std::vector<SurfacePatch>& surface, double guess,
                       const Interruption& interruption, const SurfaceEffort& effort = {});

}  // namespace fcl_prob::detail
