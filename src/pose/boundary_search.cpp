// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pose/boundary_search.h"

#include <algorithm>
#include <cmath>

#include "base/quantiles.h"
#include "pose/sampled_configuration.h"

namespace fcl_prob::detail {
namespace {

// A stream of the request's seed that no other method draws from.
constexpr std::uint64_t kStreamOfSearch = 0x626f756e;

// Points of a first look, of which so many are to meet and to miss: else they are drawn from a
// wider distribution, up to so wide a one.
constexpr int kLook = 48;
constexpr int kEnough = 6;
constexpr double kWider = 1.5;
constexpr double kWidest = 4.0;

// How far along a line the boundary is looked for, and how exactly.
constexpr double kReach = 6.0;
constexpr double kFirstStep = 1.0;
constexpr double kExact = 0.04;

// The first step from where a fitted model has the boundary: so many of its spreads, and no more
// than where nothing is known.
constexpr double kStepInSpreads = 2.0;

Eigen::Index pointsOfPlane(Eigen::Index dimension) { return 2 * dimension + 6; }

constexpr double kQuestionsOfLine = 6.0;

}  // namespace

Eigen::Index BoundarySearch::missingFor(int points_each) const {
  const Eigen::Index wanted = points_each * BoundaryModel::coefficients(dimension_, true);
  return std::max<Eigen::Index>(wanted - points_.cols(), 0);
}

double BoundarySearch::questionsOfBend(int points_each) const {
  return kQuestionsOfLine * static_cast<double>(missingFor(points_each));
}

Eigen::VectorXd BoundarySearch::nextNormals() {
  return standardNormals({seed_, kStreamOfSearch}, drawn_++, dimension_);
}

bool BoundarySearch::asked(const Eigen::VectorXd& x) {
  ++questions_;
  return collides_(x);
}

// Towards the mean of what meets from that of what misses.
std::optional<BoundaryModel> BoundarySearch::halfSpace() {
  for (double scale = 1.0; scale <= kWidest; scale *= kWider) {
    Eigen::VectorXd meeting = Eigen::VectorXd::Zero(dimension_), missing = meeting;
    int hits = 0;
    for (int i = 0; i < kLook; ++i) {
      const Eigen::VectorXd x = scale * nextNormals();
      const bool hit = asked(x);
      hits += hit ? 1 : 0;
      (hit ? meeting : missing) += x;
    }
    if (hits < kEnough || kLook - hits < kEnough) continue;
    const Eigen::VectorXd towards = meeting / hits - missing / (kLook - hits);
    if (!(towards.norm() > 0.0)) return std::nullopt;
    const double share = static_cast<double>(hits) / kLook;
    const double level = scale * std::sqrt(2.0) * erfcInverse(2.0 * share);
    return BoundaryModel(towards.normalized(), level);
  }
  return std::nullopt;
}

// From a guess outwards in growing steps, then by halves. Where contact comes and goes along the
// line any of its ends will do.
std::optional<double> BoundarySearch::levelOn(const BoundaryModel& model,
                                              const Eigen::VectorXd& across, double guess,
                                              double step) {
  double at = std::clamp(guess, -kReach, kReach);
  const bool inside = asked(model.pointAt(across, at));
  double other = at;
  for (;; step *= 2.0) {
    const double next = std::clamp(inside ? at - step : at + step, -kReach, kReach);
    if (next == at) return std::nullopt;
    if (asked(model.pointAt(across, next)) != inside) {
      other = next;
      break;
    }
    at = next;
  }
  double lo = std::min(at, other), hi = std::max(at, other);
  while (hi - lo > kExact) {
    const double middle = 0.5 * (lo + hi);
    (asked(model.pointAt(across, middle)) ? hi : lo) = middle;
  }
  return 0.5 * (lo + hi);
}

void BoundarySearch::addPoints(const BoundaryModel& model, Eigen::Index count, double step) {
  const Eigen::Index before = points_.cols();
  Eigen::Index found = before;
  points_.conservativeResize(dimension_, before + count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd across = model.acrossOf(nextNormals());
    const auto level = levelOn(model, across, model.level(across), step);
    if (level) points_.col(found++) = model.pointAt(across, *level);
  }
  points_.conservativeResize(dimension_, found);
}

std::optional<BoundaryModel> BoundarySearch::plane() {
  points_.resize(dimension_, 0);
  auto model = halfSpace();
  if (!model) return model;
  addPoints(*model, pointsOfPlane(dimension_), kFirstStep);
  if (points_.cols() <= dimension_ + 2) return std::nullopt;
  model->fit(points_, false);
  BoundaryModel turned = model->alongNormal();
  turned.fit(points_, false);
  return turned;
}

void BoundarySearch::bend(BoundaryModel& model, int points_each) {
  const double step = std::clamp(kStepInSpreads * model.spread(), kExact, kFirstStep);
  addPoints(model, missingFor(points_each), step);
  model.fit(points_, true);
}

}  // namespace fcl_prob::detail
