// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The parts of a polytope swept by a ball, and bounds on the normal density over them.
//
// A polytope K is within K ⊕ ball(r); what is around it is made of a prism on every face, a wedge
// along every edge and a sector at every corner (Steiner's formula), which nothing else covers. In
// the whitened frame each is the image of a box of three parameters, the last of which is the
// distance ρ from K in metres:
//   prism   y = corner + a first + b second + ρ along        (or a b second: a triangle)
//   wedge   y = corner + t edge + ρ W u(θ),                   u(θ) = cos θ p + sin θ q
//   sector  y = corner + ρ W g/|g|,  g = n₀ + a (n₁ - n₀) + a b (n₂ - n₁)
// and the mass is (2π)^(-3/2) factor ∫∫∫ weight exp(-|y|²/2), weight 1 (a), ρ, or ρ² a/|g|³. All
// terms are positive: nothing cancels, however small, large or far away the body is.
//
// The integrands are analytic in every parameter. If one of them is complex, within an ellipse
// around its range, and the others are real, then |exp(-y·y/2)| = exp((|Im y|² - |Re y|²)/2), and
// Re y is not in a half-space n·y < distance: that is what `Cell::bound` tells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <variant>

namespace fcl_prob::detail {

struct ParameterBox {
  std::array<double, 3> centre, half;
};

/// A box one parameter of which is within the ellipse with these semi-axes around its range.
struct ComplexBox {
  explicit ComplexBox(const ParameterBox& range) : real(range) {}
  ComplexBox(const ParameterBox& range, int k, double real_axis, double imaginary_axis)
      : real(range), parameter(k), imaginary(imaginary_axis) {
    real.half[static_cast<std::size_t>(k)] = real_axis;
  }

  double lo(std::size_t k) const { return real.centre[k] - real.half[k]; }
  double hi(std::size_t k) const { return real.centre[k] + real.half[k]; }
  double modulus(std::size_t k) const { return std::abs(real.centre[k]) + real.half[k]; }

  ParameterBox real;  ///< of the real parts
  int parameter = -1;
  double imaginary = 0.0;
};

/// |weight exp(-y·y/2)| <= weight exp((growth - distance²)/2) and |y| <= reach; infinite weight:
/// nothing is known.
struct PartBound {
  double weight, distance, growth, reach;
};

/// Where a part is for fixed values a and b of the first two parameters: point + ρ direction.
struct PartLine {
  Eigen::Vector3d point, direction;
  double weight;  ///< but for the power of ρ
};

/// What all parts have.
struct SolidPart {
  Eigen::Vector3d corner;
  double radius = 0.0;          ///< the upper end of ρ, metres
  double factor = 0.0;          ///< determinant of the map, its constant part; whitened
  double factor_error = 0.0;    ///< absolute
  double position_error = 0.0;  ///< rounding of y, absolute
};

struct Prism : SolidPart {
  static constexpr int kPowerOfDistance = 0;
  Eigen::Vector3d first, second, along;
  bool triangle = false;

  /// Where b is fixed.
  struct Row {
    Eigen::Vector3d point, step, direction;
    bool triangle;

    PartLine at(double a) const { return {point + a * step, direction, triangle ? a : 1.0}; }
  };

  ParameterBox parameters() const { return {{0.5, 0.5, 0.5 * radius}, {0.5, 0.5, 0.5 * radius}}; }
  Row rowAt(double b) const {
    if (triangle) return {corner, first + b * second, along, true};
    return {corner + b * second, first, along, false};
  }

  class Cell {
   public:
    Cell(const Prism& part, const ParameterBox&, const Eigen::Vector3d& normal);
    PartBound bound(const ComplexBox& box) const;

   private:
    const Prism& part_;
    double corner_, first_, second_, along_;  // along the normal
    double corner_length_, first_length_, second_length_, along_length_;
  };
};

struct Wedge : SolidPart {
  static constexpr int kPowerOfDistance = 1;
  Eigen::Vector3d edge, p, q;  ///< W p, W q
  double angle = 0.0;          ///< θ from 0 to this

  struct Row {
    Eigen::Vector3d point, step, direction;

    PartLine at(double t) const { return {point + t * step, direction, 1.0}; }
  };

  ParameterBox parameters() const {
    return {{0.5, 0.5 * angle, 0.5 * radius}, {0.5, 0.5 * angle, 0.5 * radius}};
  }
  Row rowAt(double theta) const {
    return {corner, edge, std::cos(theta) * p + std::sin(theta) * q};
  }

  class Cell {
   public:
    Cell(const Wedge& part, const ParameterBox& box, const Eigen::Vector3d& normal);
    PartBound bound(const ComplexBox& box) const;

   private:
    double corner_, edge_, radial_, tangential_;  // along the normal, at the middle angle
    double radial_length_, tangential_length_;    // of W u and W u' there
    double corner_length_, edge_length_;
  };
};

struct Sector : SolidPart {
  static constexpr int kPowerOfDistance = 2;
  std::array<Eigen::Vector3d, 3> normals;   ///< n₀, n₁ - n₀, n₂ - n₁
  std::array<Eigen::Vector3d, 3> whitened;  ///< W times these
  double stretch = 0.0;                     ///< no less than |W|

  struct Row {
    Eigen::Vector3d point, normal, normal_step, direction, direction_step;

    PartLine at(double a) const {
      const double inverse = 1.0 / (normal + a * normal_step).norm();
      return {point, (direction + a * direction_step) * inverse, a * inverse * inverse * inverse};
    }
  };

  ParameterBox parameters() const { return {{0.5, 0.5, 0.5 * radius}, {0.5, 0.5, 0.5 * radius}}; }
  Row rowAt(double b) const {
    return {corner, normals[0], normals[1] + b * normals[2], whitened[0],
            whitened[1] + b * whitened[2]};
  }

  class Cell {
   public:
    Cell(const Sector& part, const ParameterBox& box, const Eigen::Vector3d& normal);
    PartBound bound(const ComplexBox& box) const;

   private:
    struct Turn;
    Turn turnOf(const ComplexBox& box, double least_length, double spread) const;

    const Sector& part_;
    double corner_, corner_length_;
    std::array<double, 3> along_;  // of the whitened normals
    Eigen::Vector3d middle_, whitened_middle_;
    double middle_length_;
  };
};

using AnyPart = std::variant<Prism, Wedge, Sector>;

}  // namespace fcl_prob::detail
