// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of bodies as integrals over the patches of their boundary, with a proven bound on the
// error.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/interruption.h"
#include "fcl_prob/bounds.h"
#include "gaussian/part_cubature.h"
#include "gaussian/part_rules.h"
#include "gaussian/surface_patch.h"

namespace fcl_prob::detail {

/// A sum over patches and a bound on its error.
struct SurfaceSum {
  double mass = 0.0, error = 0.0;
};

/// Adds up the flux of F = -e_z φ(x) φ(y) Q(z), Q(z) = erfc(z/√2)/2, which has the divergence
/// φ(x) φ(y) φ(z): through a closed surface that is the mass within. It is accurate in the tail
/// where e_z is about towards the nearest point, and analytic everywhere: with
/// Q(z) = ∫₀^∞ φ(z + τ) dτ it is |F| <= exp((|Im x|² - |Re x|²)/2) / 2π where Re z >= 0, and where
/// Re z < 0 the same but for Re z, so for Re x beyond a plane n·x >= d >= 0, n_z >= 0, in any case
/// |F| <= exp((|Im x|² - d²)/2) / 2π.
///
/// Rules and their errors are as in PartCubature, of two parameters.
class SurfaceCubature {
 public:
  /// \param interruption  outlives this; once it is due, nothing is known of what is left
  /// \param displacement    how far the patches may be from the true surface
  SurfaceCubature(const CubatureLimits& limits, const Interruption& interruption,
                  double displacement = 0.0)
      : limits_(limits), interruption_(interruption), displacement_(displacement) {}

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

  CubatureLimits limits_;
  const Interruption& interruption_;
  double displacement_;
  std::size_t cells_ = 0;
  std::array<std::size_t, 3> guess_{5, 5, 5};
  SurfaceSum sum_;
};

/// What is asked of massWithin(): errors of all rules together next to the mass, tried for and
/// enough; and how far the surface may be from the true one, which counts as error.
struct SurfaceAccuracy {
  double target = 8e-8, enough = 4.5e-7;
  double displacement = 0.0;
};

/// The mass within a closed surface that goes once around what it encloses, as far as cubature and
/// the rounding of its terms tell: lower may be negative.
/// \param guess  of the mass; not too small. What it is wrong by costs time only.
Bounds massWithin(const std::vector<SurfacePatch>& surface, double guess,
                  const Interruption& interruption, const SurfaceAccuracy& accuracy = {});

}  // namespace fcl_prob::detail
