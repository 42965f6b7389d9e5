// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "mass/surface_patch.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mass/taylor_model.h"

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

/// By how much |w(s)| exceeds what is linear between its ends, and the derivative of that.
template <class Number>
struct BaseExcess {
  Number value, slope;
};

// Differences of models count roundings next to the lengths, which is more than roots have.
template <class Number>
BaseExcess<Number> baseExcess(const SurfacePatch& patch, const Number& s) {
  Triple<Number> w;
  Triple<Number> along;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double step = patch.base[1][k] - patch.base[0][k];
    along[i] = Number(step);
    w[i] = patch.base[0][k] + step * s;
  }
  const Number square = dot(w, w);
  const double from = patch.base[0].norm(), growth = patch.base[1].norm() - from;
  return {squareRoot(square) - (from + growth * s),
          dot(w, along) * inverseSquareRoot(square) - growth};
}

/// The same with the value right next to itself: with ℓ what is linear between the ends,
/// |w|² - ℓ² = -2 s (1 - s) (|w₀||w₁| - w₀·w₁).
BaseExcess<double> baseExcess(const SurfacePatch& patch, double s) {
  const Eigen::Vector3d &w = patch.base[0], &end = patch.base[1];
  const Eigen::Vector3d step = end - w, at = w + s * step;
  const double from = w.norm(), to = end.norm(), product = from * to;
  const double apart = w.cross(end).squaredNorm() / (product + w.dot(end));
  const double growth = to - from, length = at.norm();
  return {-2.0 * s * (1.0 - s) * apart / (length + from + growth * s),
          at.dot(step) / length - growth};
}

template <class Number>
void addLift(const CurvedTerm& term, const BaseExcess<Number>& excess, const Number& t,
             Jet<Number>& jet) {
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double step = term.lift[1][k] - term.lift[0][k];
    const Number lift = term.lift[0][k] + step * t;
    jet.value[i] = jet.value[i] + excess.value * lift;
    jet.first[i] = jet.first[i] + excess.slope * lift;
    jet.second[i] = jet.second[i] + step * excess.value;
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

template <class Size, class Number>
void addScaled(const Size& size, const Jet<Number>& jet, Jet<Number>& sum) {
  for (std::size_t k = 0; k < 3; ++k) {
    sum.value[k] = sum.value[k] + size * jet.value[k];
    sum.first[k] = sum.first[k] + size * jet.first[k];
    sum.second[k] = sum.second[k] + size * jet.second[k];
  }
}

template <class Number>
void addTerm(const CurvedTerm& term, const BaseExcess<Number>* excess, const Number& s,
             const Number& t, Jet<Number>& sum) {
  Jet<Number> g = bilinear(term.direction, s, t);
  if (excess) addLift(term, *excess, t, g);
  const Jet<Number> unit = unitJet(g);
  const Jet<Number> image{imageOf(term.image, unit.value), imageOf(term.image, unit.first),
                          imageOf(term.image, unit.second)};
  const double growth = term.size[1] - term.size[0], taper = term.taper[1] - term.taper[0];
  if (growth == 0.0 && taper == 0.0) {
    addScaled(term.size[0] * term.taper[0], image, sum);
    return;
  }
  const Number size = taper == 0.0 ? term.taper[0] * (term.size[0] + growth * t)
                                   : term.size[0] * (term.taper[0] + taper * s);
  addScaled(size, image, sum);
  for (std::size_t k = 0; k < 3; ++k) {
    sum.first[k] = sum.first[k] + term.size[0] * taper * image.value[k];
    sum.second[k] = sum.second[k] + term.taper[0] * growth * image.value[k];
  }
}

template <class Number>
Jet<Number> evaluate(const SurfacePatch& patch, const Number& s, const Number& t) {
  Jet<Number> sum = bilinear(patch.position, s, t);
  BaseExcess<Number> excess{};
  if (patch.lifted) excess = baseExcess(patch, s);
  for (int k = 0; k < patch.count; ++k) {
    addTerm(patch.terms[static_cast<std::size_t>(k)], patch.lifted ? &excess : nullptr, s, t, sum);
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

/// normal · (u × v)
TaylorModel alongProduct(const Eigen::Vector3d& normal, const Triple<TaylorModel>& u,
                         const Triple<TaylorModel>& v) {
  TaylorModel sum;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double along_i = normal[static_cast<Eigen::Index>(i)],
                 along_j = normal[static_cast<Eigen::Index>(j)];
    if (along_i == 0.0 && along_j == 0.0) continue;
    sum = sum + (along_i * u[j] - along_j * u[i]) * v[k];
  }
  return sum;
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

/// What a bilinear vector is a sum of in a box: rounding is next to these lengths.
double mostTerms(const BilinearVector& corners, const ParameterBox& box) {
  const double s = box.centre[0] + box.half[0], t = box.centre[1] + box.half[1];
  const double first = corners[0].norm() + s * (corners[0].norm() + corners[1].norm());
  const double second = corners[2].norm() + s * (corners[2].norm() + corners[3].norm());
  return first + t * (first + second);
}

/// Of a square, along each parameter.
std::array<double, 2> longestSides(const BilinearVector& corners) {
  return {std::max((corners[1] - corners[0]).norm(), (corners[3] - corners[2]).norm()),
          std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm())};
}

}  // namespace

PatchLine::Linear PatchLine::lineOf(const BilinearVector& corners, double s) {
  const Eigen::Vector3d from = corners[0] + s * (corners[1] - corners[0]);
  const Eigen::Vector3d along = corners[2] - corners[0];
  return {from, along + s * ((corners[3] - corners[1]) - along)};
}

PatchLine::Linear PatchLine::slopeOf(const BilinearVector& corners) {
  const Eigen::Vector3d along = corners[1] - corners[0];
  return {along, (corners[3] - corners[2]) - along};
}

PatchLine::PatchLine(const SurfacePatch& patch, double s)
    : position_(lineOf(patch.position, s)),
      position_along_first_(slopeOf(patch.position)),
      count_(patch.count) {
  BaseExcess<double> excess{};
  if (patch.lifted) excess = baseExcess(patch, s);
  for (int k = 0; k < count_; ++k) {
    const CurvedTerm& term = patch.terms[static_cast<std::size_t>(k)];
    Term& line = terms_[static_cast<std::size_t>(k)];
    line.direction = lineOf(term.direction, s);
    line.along_first = slopeOf(term.direction);
    if (patch.lifted) {
      const Eigen::Vector3d step = term.lift[1] - term.lift[0];
      line.direction.from += excess.value * term.lift[0];
      line.direction.step += excess.value * step;
      line.along_first.from += excess.slope * term.lift[0];
      line.along_first.step += excess.slope * step;
    }
    line.image = {term.image * line.direction.from, term.image * line.direction.step};
    line.image_along_first = {term.image * line.along_first.from,
                              term.image * line.along_first.step};
    const double taper = term.taper[1] - term.taper[0], share = term.taper[0] + taper * s;
    line.size = term.size[0] * share;
    line.growth = (term.size[1] - term.size[0]) * share;
    line.taper = term.size[0] * taper;
  }
}

void PatchLine::addTerm(const Term& term, const Lanes& t, PatchPoints& sum) {
  Triple<Lanes> g, along;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    g[i] = term.direction.from[k] + term.direction.step[k] * t;
    along[i] = term.along_first.from[k] + term.along_first.step[k] * t;
  }
  const Lanes inverse = inverseSquareRoot(dot(g, g)), square = inverse * inverse;
  const Lanes fall_first = dot(g, along) * square;
  const Eigen::Vector3d& step = term.direction.step;
  const Lanes fall_second = (step[0] * g[0] + step[1] * g[1] + step[2] * g[2]) * square;
  const Lanes size = (term.size + term.growth * t) * inverse;
  const Lanes grown = term.growth * inverse, tapered = term.taper * inverse;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Lanes image = term.image.from[k] + term.image.step[k] * t;
    const Lanes slope = term.image_along_first.from[k] + term.image_along_first.step[k] * t;
    sum.value[i] = sum.value[i] + size * image;
    sum.first[i] = sum.first[i] + size * (slope - fall_first * image) + tapered * image;
    sum.second[i] =
        sum.second[i] + size * (term.image.step[k] - fall_second * image) + grown * image;
  }
}

PatchPoints PatchLine::at(const Lanes& t) const {
  PatchPoints sum;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    sum.value[i] = position_.from[k] + position_.step[k] * t;
    sum.first[i] = position_along_first_.from[k] + position_along_first_.step[k] * t;
    sum.second[i] = Lanes(position_.step[k]);
  }
  for (int k = 0; k < count_; ++k) addTerm(terms_[static_cast<std::size_t>(k)], t, sum);
  return sum;
}

NormalChanges normalChanges(const SurfacePatch& patch, const ParameterBox& box) {
  const double s = box.centre[0], t = box.centre[1];
  NormalChanges changes;
  BaseExcess<double> excess{};
  if (patch.lifted) {
    excess = baseExcess(patch, s);
    const Eigen::Vector3d step = box.half[0] * (patch.base[1] - patch.base[0]);
    const Eigen::Vector3d middle = patch.base[0] + s * (patch.base[1] - patch.base[0]);
    const double square = middle.squaredNorm();
    changes.along[0] = std::sqrt(step.squaredNorm() / square);
    changes.of_square = (2.0 * std::abs(middle.dot(step)) + step.squaredNorm()) / square;
  }
  for (int k = 0; k < patch.count; ++k) {
    const CurvedTerm& term = patch.terms[static_cast<std::size_t>(k)];
    Jet<double> g = bilinear(term.direction, s, t);
    if (patch.lifted) addLift(term, excess, t, g);
    const double square = dot(g.value, g.value);
    double most = 2.0 * (box.half[0] * std::abs(dot(g.value, g.first)) +
                         box.half[1] * std::abs(dot(g.value, g.second)));
    for (std::size_t i = 0; i < 3; ++i) {
      const double step = box.half[0] * std::abs(g.first[i]) + box.half[1] * std::abs(g.second[i]);
      most += step * step;
    }
    changes.of_square = std::max(changes.of_square, most / square);
    const auto share = [&](const Triple<double>& slope, double half) {
      return half * std::sqrt(dot(slope, slope) / square);
    };
    changes.along[0] = std::max(changes.along[0], share(g.first, box.half[0]));
    changes.along[1] = std::max(changes.along[1], share(g.second, box.half[1]));
  }
  return changes;
}

PatchCell::PatchCell(const SurfacePatch& patch, const ParameterBox& box,
                     const Eigen::Vector3d& normal, const Eigen::Vector3d& field,
                     AreaComponents components)
    : patch_(patch), normal_(normal), field_(field), components_(components) {
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
  double area = 0.0;
  const auto consider = [&](const TaylorModel& component) {
    area = component.radius < kInfinity ? std::max(area, component.most()) : kInfinity;
  };
  consider(alongProduct(field_, jet.first, jet.second));
  if (components_ == AreaComponents::all) {
    for (int k = 0; k < 3; ++k) {
      consider(alongProduct(Eigen::Vector3d::Unit(k), jet.first, jet.second));
    }
  }
  if (!(area < kInfinity)) return kUnboundedPatch;
  const double fall = mostMean(normal_, jet.first) * box.real.half[0] +
                      mostMean(normal_, jet.second) * box.real.half[1];
  const double first = mostLength(jet.first), second = mostLength(jet.second);
  const double reach = reach_ + first * box.real.half[0] + second * box.real.half[1];
  const double imaginary =
      box.parameter < 0 ? 0.0 : box.imaginary * (box.parameter == 0 ? first : second);
  if (!(fall < kInfinity && reach < kInfinity)) return kUnboundedPatch;
  // Differences of corners are rounded, too.
  const double weight = area + kSlopeRounding * first * second;
  return {weight * kPatchSlack, height_ - fall, imaginary * imaginary, reach};
}

// Of g, next to |g|, it is a few ε times how much larger its terms are; and as much of g/|g|, since
// derivatives of that are (I - ĝĝᵀ) g'/|g|.
void PatchCell::findRounding(const ParameterBox& box) {
  const auto [s, t, none] = parameters(box);
  rounding_.position = 8.0 * kEpsilon * mostTerms(patch_.position, box);
  // Corners are exact, and their differences right to an ε of themselves.
  rounding_.first = 16.0 * kEpsilon * longestSides(patch_.position)[0];
  rounding_.second = 16.0 * kEpsilon * longestSides(patch_.position)[1];
  BaseExcess<TaylorModel> excess{};
  double base = 0.0;
  if (patch_.lifted) {
    excess = baseExcess(patch_, s);
    base = 2.0 * (patch_.base[0].norm() + patch_.base[1].norm());
  }
  for (int k = 0; k < patch_.count; ++k) {
    const CurvedTerm& term = patch_.terms[static_cast<std::size_t>(k)];
    Jet<TaylorModel> g = bilinear(term.direction, s, t);
    if (patch_.lifted) addLift(term, excess, t, g);
    const double inverse = inverseSquareRoot(dot(g.value, g.value)).most();
    const double lift = std::max(term.lift[0].norm(), term.lift[1].norm());
    const double terms =
        (mostTerms(term.direction, box) + 2.0 * lift * excess.value.most()) * inverse;
    // Differences of corners are right next to themselves, slopes of |w| next to w.
    const std::array<double, 2> sides = longestSides(term.direction);
    const double bend = (term.lift[1] - term.lift[0]).norm() * excess.value.most();
    const double along_first = (sides[0] + lift * base) * inverse;
    const double along_second = (sides[1] + bend) * inverse;
    const double size = std::max(term.size[0], term.size[1]) *
                        std::max(term.taper[0], term.taper[1]) * term.image.norm();
    const double first = 1.0 + mostLength(g.first) * inverse;
    const double second = 1.0 + mostLength(g.second) * inverse;
    rounding_.position += 32.0 * kEpsilon * size * (1.0 + terms);
    rounding_.first += 64.0 * kEpsilon * size * ((1.0 + terms) * first + along_first);
    rounding_.second += 64.0 * kEpsilon * size * ((1.0 + terms) * second + along_second);
  }
}

}  // namespace fcl_prob::detail
