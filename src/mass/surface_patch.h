// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Patches that the boundaries of sums of curved convex bodies are made of.
#pragma once

#include <Eigen/Core>
#include <array>

#include "gaussian/lanes.h"
#include "mass/solid_part.h"
#include "mass/taylor_model.h"

namespace fcl_prob::detail {

/// What a vector is at the corners (s, t) = (0,0), (1,0), (0,1), (1,1) of a square, on which it is
/// bilinear. Corners, not slopes, so that neighbours agree along the edge that they share.
using BilinearVector = std::array<Eigen::Vector3d, 4>;

/// A point of the ellipsoid { H u : |u| = 1 }, flat if a column of H is 0: size H g/|g|, the
/// support point of the normal that g = Hᵀn stands for. The size is linear in t or, if that is
/// constant, its taper is in s. g is bilinear and, where it stands for normals of a cone's side,
/// has
/// (|w(s)| - (1 - s) |w(0)| - s |w(1)|) lift(t) added, w being the patch's: nothing at corners.
struct CurvedTerm {
  Eigen::Matrix3d image;
  BilinearVector direction;
  std::array<Eigen::Vector3d, 2> lift{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<double, 2> size{1.0, 1.0};   ///< at t = 0 and 1
  std::array<double, 2> taper{1.0, 1.0};  ///< at s = 0 and 1
};

/// x(s, t) for s and t from 0 to 1: a bilinear vector and up to two curved terms. ∂x/∂s × ∂x/∂t is
/// towards the outside.
struct SurfacePatch {
  static constexpr int kMostTerms = 3;

  void add(const CurvedTerm& term) { terms[static_cast<std::size_t>(count++)] = term; }

  BilinearVector position;
  std::array<CurvedTerm, kMostTerms> terms;
  int count = 0;
  bool lifted = false;                  ///< whether any term has a lift
  std::array<Eigen::Vector3d, 2> base;  ///< w at s = 0 and at 1
};

/// A value and its derivatives along s and t.
template <class Number>
struct PatchJet {
  std::array<Number, 3> value, first, second;
};

/// Points of a patch, and a model of it over a box.
using PatchPoints = PatchJet<Lanes>;
using PatchModel = PatchJet<TaylorModel>;

/// Points of a patch for one s. There g, ∂g/∂s and what H makes of both are linear in t, so that
/// x = H g/|g| has the derivatives (H g' - (g·g') x/|g|) / |g|.
class PatchLine {
 public:
  PatchLine(const SurfacePatch& patch, double s);

  PatchPoints at(const Lanes& t) const;

 private:
  /// from + t step
  struct Linear {
    Eigen::Vector3d from, step;
  };
  struct Term {
    Linear direction, along_first;  ///< g and ∂g/∂s
    Linear image, image_along_first;
    double size, growth;  ///< the size is size + t growth
    double taper;         ///< ∂size/∂s
  };

  static Linear lineOf(const BilinearVector& corners, double s);
  static Linear slopeOf(const BilinearVector& corners);
  static void addTerm(const Term& term, const Lanes& t, PatchPoints& sum);

  Linear position_, position_along_first_;
  std::array<Term, SurfacePatch::kMostTerms> terms_;
  int count_;
};

/// How far normals turn in a box.
struct NormalChanges {
  /// By what share of itself the normal of the middle changes at the most along each parameter.
  std::array<double, 2> along{0.0, 0.0};
  /// By what share of itself its square may change: from about 1 on models know nothing.
  double of_square = 0.0;
};

/// About: which boxes are too long, and along which parameter. Nothing certain follows.
NormalChanges normalChanges(const SurfacePatch& patch, const ParameterBox& box);

/// Bounds on how much rounding can change of what pointsOf() finds in a box, and on the derivatives
/// there, for real parameters.
struct PatchRounding {
  double position = 0.0, first = 0.0, second = 0.0;
  double first_length = 0.0, second_length = 0.0;
};

/// Which components of ∂x/∂s × ∂x/∂t are asked for: what a mass or, besides, a moment takes.
enum class AreaComponents { along_field, all };

/// Bounds over a box of a patch (the third parameter of boxes is none) along a unit normal.
class PatchCell {
 public:
  /// \param field  about a unit vector
  PatchCell(const SurfacePatch& patch, const ParameterBox& box, const Eigen::Vector3d& normal,
            const Eigen::Vector3d& field, AreaComponents components = AreaComponents::along_field);

  /// Of the integrand ∂x/∂s × ∂x/∂t · field exp(-x·x/2) (or with the largest of that, e_x, e_y and
  /// e_z) and of what it is made of. With the mean
  /// value theorem x(s, t) - x(middle) is a mean of ∂x/∂s times one step and a mean of ∂x/∂t times
  /// another, both within discs around what they are at the middle; and Im x(s + iη) is η times a
  /// mean of Re ∂x/∂s, since x is real where the parameters are.
  PartBound bound(const ComplexBox& box) const;

  /// In the box that the cell was made of.
  const PatchRounding& rounding() const { return rounding_; }

 private:
  void findRounding(const ParameterBox& box);
  PartBound boundOf(const PatchModel& jet, const ComplexBox& box) const;

  const SurfacePatch& patch_;
  Eigen::Vector3d normal_, field_;
  AreaComponents components_;
  double height_ = 0.0;  ///< of the middle, along the normal, less its rounding
  double reach_ = 0.0;
  PartBound real_;  ///< for real parameters
  PatchRounding rounding_;
};

}  // namespace fcl_prob::detail
