// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/surface_patch.h"

#include <algorithm>
#include <cmath>

#include "gaussian/taylor_model.h"

namespace fcl_prob::detail {
namespace {

constexpr PartBound kUnboundedPatch{kInfinity, 0.0, 0.0, kInfinity};

/// Of what bounds are made of, for their own rounding.
constexpr double kPatchSlack = 1.0 + 1e-9;

/// Of products of two slopes.
constexpr double kSlopeRounding = 64.0 * kEpsilon;

template <class Number>
using Triple = std::array<Number, 3>;

template <class Number>
using Jet = PatchJet<Number>;

template <class Number>
Number dot(const Triple<Number>& a, const Triple<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A bilinear vector and its derivatives.
template <class Number>
Jet<Number> bilinear(const BilinearVector& corner, const Number& s, const Number& t) {
  Jet<Number> jet;
  for (int k = 0; k < 3; ++k) {
    const double along_s = corner[1][k] - corner[0][k], along_t = corner[2][k] - corner[0][k];
    const double both = (corner[3][k] - corner[2][k]) - along_s;
    const auto i = static_cast<std::size_t>(k);
    jet.first[i] = along_s + both * t;
    jet.second[i] = along_t + both * s;
    jet.value[i] = corner[0][k] + along_s * s + t * jet.second[i];
  }
  return jet;
}

/// |w(s)| and its derivative.
template <class Number>
struct BaseLength {
  Number value, slope;
};

template <class Number>
BaseLength<Number> baseLength(const SurfacePatch& patch, const Number& s) {
  Triple<Number> w;
  Triple<Number> along;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double step = patch.base[1][k] - patch.base[0][k];
    along[i] = Number(step);
    w[i] = patch.base[0][k] + step * s;
  }
  const Number square = dot(w, w);
  return {squareRoot(square), dot(w, along) * inverseSquareRoot(square)};
}

template <class Number>
void addLift(const CurvedTerm& term, const BaseLength<Number>& length, const Number& t,
             Jet<Number>& jet) {
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double step = term.lift[1][k] - term.lift[0][k];
    const Number lift = term.lift[0][k] + step * t;
    jet.value[i] = jet.value[i] + length.value * lift;
    jet.first[i] = jet.first[i] + length.slope * lift;
    jet.second[i] = jet.second[i] + step * length.value;
  }
}

/// g/|g| and its derivatives (g' - ĝ (ĝ·g')) / |g|.
template <class Number>
Jet<Number> unitJet(const Jet<Number>& g) {
  const Number inverse = inverseSquareRoot(dot(g.value, g.value));
  Jet<Number> unit;
  for (std::size_t k = 0; k < 3; ++k) unit.value[k] = inverse * g.value[k];
  const Number along_first = dot(unit.value, g.first), along_second = dot(unit.value, g.second);
  for (std::size_t k = 0; k < 3; ++k) {
    unit.first[k] = inverse * (g.first[k] - along_first * unit.value[k]);
    unit.second[k] = inverse * (g.second[k] - along_second * unit.value[k]);
  }
  return unit;
}

template <class Number>
Triple<Number> imageOf(const Eigen::Matrix3d& map, const Triple<Number>& u) {
  Triple<Number> image;
  for (int k = 0; k < 3; ++k) {
    image[static_cast<std::size_t>(k)] = map(k, 0) * u[0] + map(k, 1) * u[1] + map(k, 2) * u[2];
  }
  return image;
}

template <class Number>
void addTerm(const CurvedTerm& term, const BaseLength<Number>* length, const Number& s,
             const Number& t, Jet<Number>& sum) {
  Jet<Number> g = bilinear(term.direction, s, t);
  if (length) addLift(term, *length, t, g);
  const Jet<Number> unit = unitJet(g);
  const double growth = term.size[1] - term.size[0];
  const Number size = term.size[0] + growth * t;
  const Triple<Number> value = imageOf(term.image, unit.value);
  const Triple<Number> first = imageOf(term.image, unit.first);
  const Triple<Number> second = imageOf(term.image, unit.second);
  for (std::size_t k = 0; k < 3; ++k) {
    sum.value[k] = sum.value[k] + size * value[k];
    sum.first[k] = sum.first[k] + size * first[k];
    sum.second[k] = sum.second[k] + size * second[k] + growth * value[k];
  }
}

template <class Number>
Jet<Number> evaluate(const SurfacePatch& patch, const Number& s, const Number& t) {
  Jet<Number> sum = bilinear(patch.position, s, t);
  BaseLength<Number> length{};
  if (patch.lifted) length = baseLength(patch, s);
  for (int k = 0; k < patch.count; ++k) {
    addTerm(patch.terms[static_cast<std::size_t>(k)], patch.lifted ? &length : nullptr, s, t, sum);
  }
  return sum;
}

/// No less than the length of any vector within, and of its mean over a segment from the middle.
double mostLength(const Triple<TaylorModel>& v) {
  double middle = 0.0, spread = 0.0;
  for (const TaylorModel& z : v) {
    middle += z.middle * z.middle;
    spread += z.spread() * z.spread();
  }
  return (std::sqrt(middle) + std::sqrt(spread)) * kPatchSlack;
}

TaylorModel along(const Eigen::Vector3d& normal, const Triple<TaylorModel>& v) {
  return normal[0] * v[0] + normal[1] * v[1] + normal[2] * v[2];
}

/// The largest mean along a normal over a segment from the middle.
double mostMean(const Eigen::Vector3d& normal, const Triple<TaylorModel>& v) {
  const TaylorModel z = along(normal, v);
  return (std::abs(z.middle) + z.meanSpread()) * kPatchSlack;
}

Triple<TaylorModel> parameters(const ParameterBox& box) {
  return {TaylorModel(box.centre[0], box.half[0] * kPatchSlack, 0.0, 0.0),
          TaylorModel(box.centre[1], 0.0, box.half[1] * kPatchSlack, 0.0), TaylorModel()};
}

double mostNorm(const BilinearVector& corners) {
  double most = 0.0;
  for (const Eigen::Vector3d& v : corners) most = std::max(most, v.norm());
  return most;
}

double longestSide(const BilinearVector& corners) {
  return std::max({(corners[1] - corners[0]).norm(), (corners[3] - corners[2]).norm(),
                   (corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm()});
}

}  // namespace

PatchPoints pointsOf(const SurfacePatch& patch, double s, const Lanes& t) {
  const Jet<Lanes> jet = evaluate(patch, Lanes(s), t);
  return {jet.value, jet.first, jet.second};
}

std::array<double, 2> normalChanges(const SurfacePatch& patch, const ParameterBox& box) {
  const double s = box.centre[0], t = box.centre[1];
  std::array<double, 2> changes{0.0, 0.0};
  BaseLength<double> length{};
  if (patch.lifted) {
    length = baseLength(patch, s);
    changes[0] = box.half[0] * (patch.base[1] - patch.base[0]).norm() / length.value;
  }
  for (int k = 0; k < patch.count; ++k) {
    const CurvedTerm& term = patch.terms[static_cast<std::size_t>(k)];
    Jet<double> g = bilinear(term.direction, s, t);
    if (patch.lifted) addLift(term, length, t, g);
    const double square = dot(g.value, g.value);
    changes[0] = std::max(changes[0], box.half[0] * std::sqrt(dot(g.first, g.first) / square));
    changes[1] = std::max(changes[1], box.half[1] * std::sqrt(dot(g.second, g.second) / square));
  }
  return changes;
}

PatchCell::PatchCell(const SurfacePatch& patch, const ParameterBox& box,
                     const Eigen::Vector3d& normal)
    : patch_(patch), normal_(normal) {
  const auto [s, t, none] = parameters(box);
  const Jet<TaylorModel> jet = evaluate(patch, s, t);
  double middle = 0.0, square = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    middle += normal[static_cast<Eigen::Index>(k)] * jet.value[k].middle;
    square += jet.value[k].middle * jet.value[k].middle;
    rounding_.first_length = mostLength(jet.first);
    rounding_.second_length = mostLength(jet.second);
  }
  if (!(rounding_.first_length < kInfinity && rounding_.second_length < kInfinity)) {
    real_ = kUnboundedPatch;
    return;
  }
  findRounding(box);
  reach_ = std::sqrt(square) + 2.0 * rounding_.position;
  height_ = middle - 2.0 * rounding_.position - 4.0 * kEpsilon * reach_;
  real_ = boundOf(jet, ComplexBox(box));
}

PartBound PatchCell::bound(const ComplexBox& box) const {
  // What is unbounded for real parameters is so for complex ones.
  if (box.parameter < 0 || !(real_.weight < kInfinity)) return real_;
  const auto [s, t, none] = parameters(box.real);
  return boundOf(evaluate(patch_, s, t), box);
}

PartBound PatchCell::boundOf(const PatchModel& jet, const ComplexBox& box) const {
  const TaylorModel area = jet.first[0] * jet.second[1] - jet.first[1] * jet.second[0];
  const double fall = mostMean(normal_, jet.first) * box.real.half[0] +
                      mostMean(normal_, jet.second) * box.real.half[1];
  const double first = mostLength(jet.first), second = mostLength(jet.second);
  const double reach = reach_ + first * box.real.half[0] + second * box.real.half[1];
  const double imaginary =
      box.parameter < 0 ? 0.0 : box.imaginary * (box.parameter == 0 ? first : second);
  if (!(area.radius < kInfinity && fall < kInfinity && reach < kInfinity)) return kUnboundedPatch;
  // Differences of corners are rounded, too.
  const double weight = area.most() + kSlopeRounding * first * second;
  return {weight * kPatchSlack, height_ - fall, imaginary * imaginary, reach};
}

// Of g, next to |g|, it is a few ε times how much larger its terms are; and as much of g/|g|, since
// derivatives of that are (I - ĝĝᵀ) g'/|g|.
void PatchCell::findRounding(const ParameterBox& box) {
  const auto [s, t, none] = parameters(box);
  rounding_.position = 16.0 * kEpsilon * mostNorm(patch_.position);
  // Corners are exact, and their differences right to an ε of themselves.
  rounding_.first = rounding_.second = 16.0 * kEpsilon * longestSide(patch_.position);
  BaseLength<TaylorModel> length{};
  if (patch_.lifted) length = baseLength(patch_, s);
  for (int k = 0; k < patch_.count; ++k) {
    const CurvedTerm& term = patch_.terms[static_cast<std::size_t>(k)];
    Jet<TaylorModel> g = bilinear(term.direction, s, t);
    if (patch_.lifted) addLift(term, length, t, g);
    const double inverse = inverseSquareRoot(dot(g.value, g.value)).most();
    const double lift =
        patch_.lifted ? std::max(term.lift[0].norm(), term.lift[1].norm()) * 2.0 : 0.0;
    const double terms = 4.0 * (mostNorm(term.direction) + lift) * inverse;
    const double size = std::max(term.size[0], term.size[1]) * term.image.norm();
    const double first = 1.0 + mostLength(g.first) * inverse;
    const double second = 1.0 + mostLength(g.second) * inverse;
    rounding_.position += 32.0 * kEpsilon * size * (1.0 + terms);
    rounding_.first += 64.0 * kEpsilon * size * (1.0 + terms) * first;
    rounding_.second += 64.0 * kEpsilon * size * (1.0 + terms) * second;
  }
}

}  // namespace fcl_prob::detail
