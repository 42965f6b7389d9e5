// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "claim_region.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace oracle {

using fcl_prob::detail::Cell;
using fcl_prob::detail::CellPlane;
using fcl_prob::detail::CoveredPart;

namespace {

// Of a sum of three products of a unit normal and a point within reach, in extended precision.
constexpr long double kRounding = 1e-17L;

double uniform(Random& random) { return std::uniform_real_distribution<double>(0.0, 1.0)(random); }

}  // namespace

ClaimRegion::ClaimRegion(const Cell& cell, const CoveredPart& within, int rank)
    : cell_(cell), within_(within), rank_(rank) {
  for (int i = 0; i < within_.count; ++i) {
    for (int k = rank; k < 3; ++k) within_.planes[static_cast<std::size_t>(i)].m[k] = 0.0;
  }
}

bool ClaimRegion::contains(const Eigen::Vector3d& y) const {
  for (int k = 0; k < rank_; ++k) {
    // A cell without extent is a sample.
    if (cell_.lo[k] == cell_.hi[k] ? y[k] != cell_.lo[k]
                                   : !(y[k] > cell_.lo[k] && y[k] < cell_.hi[k]))
      return false;
  }
  for (int i = 0; i < within_.count; ++i) {
    const CellPlane& plane = within_.planes[static_cast<std::size_t>(i)];
    const long double height = plane.m.cast<long double>().dot(y.cast<long double>());
    if (!(height - static_cast<long double>(plane.s) > kRounding)) return false;
  }
  return true;
}

Eigen::Vector3d ClaimRegion::randomDirection(Random& random) const {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  if (uniform(random) < 0.3) {
    const int axis = static_cast<int>(random() % static_cast<std::uint64_t>(rank_));
    direction[axis] = random() % 2 == 0 ? 1.0 : -1.0;
    return direction;
  }
  // In units of the cell, which may be long and thin.
  std::normal_distribution<double> normal;
  for (int k = 0; k < rank_; ++k) direction[k] = normal(random) * (cell_.hi[k] - cell_.lo[k]);
  return direction;
}

// As far as the first side or plane ahead.
ClaimRegion::Hit ClaimRegion::boundary(const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& direction) const {
  Hit hit{std::numeric_limits<double>::infinity(), Eigen::Vector3d::Zero()};
  const auto meet = [&hit](double length, const Eigen::Vector3d& normal) {
    if (length < hit.length) hit = {std::max(length, 0.0), normal};
  };
  for (int k = 0; k < rank_; ++k) {
    if (direction[k] > 0) meet((cell_.hi[k] - from[k]) / direction[k], Eigen::Vector3d::Unit(k));
    if (direction[k] < 0) meet((cell_.lo[k] - from[k]) / direction[k], Eigen::Vector3d::Unit(k));
  }
  for (int i = 0; i < within_.count; ++i) {
    const CellPlane& plane = within_.planes[static_cast<std::size_t>(i)];
    const double slope = plane.m.dot(direction);
    if (slope < 0) meet((plane.s - plane.m.dot(from)) / slope, plane.m);
  }
  return hit;
}

Eigen::Vector3d ClaimRegion::randomPoint(const Eigen::Vector3d& from, Random& random) const {
  const Eigen::Vector3d direction = randomDirection(random);
  const double ahead = boundary(from, direction).length;
  const double behind = boundary(from, -direction).length;
  if (!std::isfinite(ahead + behind)) return from;
  return from + (uniform(random) * (ahead + behind) - behind) * direction;
}

// Corners, the middle and points towards the planes, until one is inside.
std::optional<Eigen::Vector3d> ClaimRegion::start(Random& random) const {
  constexpr int kTrials = 60;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Vector3d y = 0.5 * (cell_.lo + cell_.hi);
    if (trial > 0) {
      for (int k = 0; k < rank_; ++k) {
        const double share =
            trial % 3 == 0 ? uniform(random) : (random() % 2 == 0 ? 1e-6 : 1 - 1e-6);
        y[k] = cell_.lo[k] + share * (cell_.hi[k] - cell_.lo[k]);
      }
    }
    for (int round = 0; round < 8; ++round) {
      if (contains(y)) return y;
      for (int i = 0; i < within_.count; ++i) {
        const CellPlane& plane = within_.planes[static_cast<std::size_t>(i)];
        const double missing = plane.s - plane.m.dot(y);
        if (missing > 0) y += (1 + uniform(random)) * missing / plane.m.squaredNorm() * plane.m;
      }
      for (int k = 0; k < rank_; ++k) {
        const double inset = 1e-6 * (cell_.hi[k] - cell_.lo[k]);
        y[k] = std::clamp(y[k], cell_.lo[k] + inset, cell_.hi[k] - inset);
      }
    }
  }
  return std::nullopt;
}

std::optional<Eigen::Vector3d> ClaimRegion::point(int hits, Random& random) const {
  if (cell_.lo == cell_.hi) {
    return contains(cell_.lo) ? std::optional<Eigen::Vector3d>(cell_.lo) : std::nullopt;
  }
  const auto begin = start(random);
  if (!begin) return std::nullopt;
  Eigen::Vector3d inside = *begin;
  for (int step = 0; step < 3; ++step) {
    const Eigen::Vector3d next = randomPoint(inside, random);
    if (contains(next)) inside = next;
  }
  // Along what is left of directions that stay on all that was hit.
  Eigen::Vector3d y = inside;
  std::vector<Eigen::Vector3d> normals;
  for (int hit = 0; hit < std::min(hits, rank_); ++hit) {
    Eigen::Vector3d direction = randomDirection(random);
    for (int twice = 0; twice < 2; ++twice) {
      for (const Eigen::Vector3d& normal : normals) direction -= normal.dot(direction) * normal;
    }
    const Hit met = boundary(y, direction);
    if (!(direction.norm() > 0) || !std::isfinite(met.length)) break;
    y += met.length * direction;
    Eigen::Vector3d normal = met.normal;
    for (const Eigen::Vector3d& other : normals) normal -= other.dot(normal) * other;
    if (!(normal.norm() > 1e-9)) break;
    normals.push_back(normal.normalized());
  }
  constexpr int kExponents[] = {-54, -54, -50, -40, -20};
  double share = std::ldexp(1.0, kExponents[random() % 5]);
  for (; share < 1.0; share *= 2) {
    const Eigen::Vector3d pulled = y + share * (inside - y);
    if (contains(pulled)) return pulled;
  }
  return inside;
}

}  // namespace oracle
