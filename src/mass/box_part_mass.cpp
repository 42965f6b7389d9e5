// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Masses of a box cut by one or two half-spaces.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/constants.h"
#include "base/number_text.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/normal_mass.h"
#include "fcl_prob/polytope_mass.h"
#include "mass/polytope_clip.h"

namespace fcl_prob {
namespace {

using detail::kEpsilon;

// Beyond this the mass is below 1e-430: an unbounded box may end here.
constexpr double kFarthestSide = 45;

constexpr double kBoxPartUnderflow = 1e-300;

struct Box {
  Eigen::Vector3d lo, hi;

  bool isEmpty() const { return !(lo.array() < hi.array()).all(); }
};

void requireBox(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
  if (lo.array().isNaN().any() || hi.array().isNaN().any()) {
    throw InvalidGeometry("bounds of a box are not numbers: " + detail::numberText(lo) + " to " +
                          detail::numberText(hi));
  }
}

void requireHalfSpace(const HalfSpace& h) {
  if (!(std::abs(h.normal.squaredNorm() - 1) < 1e-9)) {
    throw InvalidGeometry("normal of a half-space is not a unit vector: " +
                          detail::numberText(h.normal));
  }
  if (std::isnan(h.offset)) throw InvalidGeometry("offset of a half-space is not a number");
}

Bounds boxMass(const Box& box) {
  const double mass = normalBoxMass(box.lo, box.hi);
  const double margin = 4 * kIntervalMassRelativeError * mass + kBoxPartUnderflow;
  if (box.isEmpty()) return {0, 0};
  return {std::max(0.0, mass - margin), std::min(1.0, mass + margin)};
}

// The axis that the normal is exactly along, or -1.
int alignedAxis(const Eigen::Vector3d& normal) {
  for (int k = 0; k < 3; ++k) {
    if (normal.cwiseAbs() == Eigen::Vector3d::Unit(k)) return k;
  }
  return -1;
}

// How far clipping may move the half-space, for y in the box: its tolerance, and rounding of the
// distances and positions of vertices.
double planeRounding(const Box& box, const HalfSpace& h) {
  const double reach = box.lo.cwiseAbs().cwiseMax(box.hi.cwiseAbs()).norm();
  return 3 * detail::kClipTolerance * (reach + std::abs(h.offset));
}

ConvexPolytope polytopeOf(const Box& box) {
  ConvexPolytope polytope;
  for (int k = 0; k < 8; ++k) {
    polytope.vertices.emplace_back(k & 1 ? box.hi.x() : box.lo.x(), k & 2 ? box.hi.y() : box.lo.y(),
                                   k & 4 ? box.hi.z() : box.lo.z());
  }
  const std::vector<std::vector<int>> loops{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int f = 0; f < 6; ++f) {
    const int axis = f / 2;
    ConvexPolytope::Face face;
    face.normal = (f % 2 == 0 ? -1 : 1) * Eigen::Vector3d::Unit(axis);
    face.offset = f % 2 == 0 ? -box.lo[axis] : box.hi[axis];
    face.vertices = loops[static_cast<std::size_t>(f)];
    polytope.faces.push_back(std::move(face));
  }
  return polytope;
}

class BoxPart {
 public:
  BoxPart(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi) {
    requireBox(lo, hi);
    box_ = {lo.cwiseMax(-kFarthestSide).cwiseMin(kFarthestSide),
            hi.cwiseMin(kFarthestSide).cwiseMax(-kFarthestSide)};
  }

  void cutBy(const HalfSpace& h) {
    requireHalfSpace(h);
    const int axis = alignedAxis(h.normal);
    if (axis < 0) {
      // An infinite offset takes all or nothing; a finite one beyond the box does the same.
      oblique_.push_back({h.normal, std::clamp(h.offset, -4 * kFarthestSide, 4 * kFarthestSide)});
      return;
    }
    if (h.normal[axis] > 0) {
      box_.lo[axis] = std::max(box_.lo[axis], h.offset);
    } else {
      box_.hi[axis] = std::min(box_.hi[axis], -h.offset);
    }
  }

  Bounds mass() {
    if (box_.isEmpty() || dropTrivialCuts()) return {0, 0};
    // The cut part is a subset of the box, whatever rounding does.
    const Bounds whole = boxMass(box_);
    if (oblique_.empty()) return whole;
    const Bounds inner = polytopeMassOf(1);
    const Bounds outer = polytopeMassOf(-1);
    return {inner.lower, std::min(whole.upper, outer.upper)};
  }

 private:
  // Removes half-spaces that contain the box; returns whether one misses it.
  bool dropTrivialCuts() {
    const auto extreme = [&](const HalfSpace& h, double side) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        sum += h.normal[k] * (side * h.normal[k] > 0 ? box_.hi[k] : box_.lo[k]);
      }
      return sum - h.offset;
    };
    for (std::size_t k = oblique_.size(); k-- > 0;) {
      const double rounding = planeRounding(box_, oblique_[k]);
      if (!(extreme(oblique_[k], 1) > -rounding)) return true;
      if (extreme(oblique_[k], -1) > rounding) {
        oblique_.erase(oblique_.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
    return false;
  }

  // `side` 1: a polytope inside of the true part; -1: one around it.
  Bounds polytopeMassOf(double side) const {
    ConvexPolytope part = polytopeOf(box_);
    for (const HalfSpace& h : oblique_) {
      part = detail::clipped(part, {h.normal, h.offset + side * planeRounding(box_, h)});
      if (part.faces.empty()) return {0, 0};
    }
    // A cut vertex is exactly on its edge if that is an edge of the box.
    double reach = 0;
    for (const Eigen::Vector3d& v : part.vertices) reach = std::max(reach, v.norm());
    return polytopeMass(part, oblique_.size() > 1 ? 4 * kEpsilon * reach : 0.0);
  }

  Box box_;
  std::vector<HalfSpace> oblique_;
};

}  // namespace

Bounds boxHalfSpaceMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const HalfSpace& h) {
  BoxPart part(lo, hi);
  part.cutBy(h);
  return part.mass();
}

Bounds boxWedgeMass(const Eigen::Vector3d& lo, const Eigen::Vector3d& hi, const HalfSpace& h1,
                    const HalfSpace& h2) {
  BoxPart part(lo, hi);
  part.cutBy(h1);
  part.cutBy(h2);
  return part.mass();
}

}  // namespace fcl_prob
