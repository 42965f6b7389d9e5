// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <queue>

#include "mass/part_cubature.h"
#include "mass/part_rules.h"

namespace fcl_prob::detail {
namespace {

/// For what is only wanted roughly.
constexpr double kRoughTolerance = 1e-3;
constexpr double kRoughPoints = 7.0;
constexpr int kMostRoughBoxes = 3000;
constexpr double kRoughShare = 0.1;

/// Next to the density at the nearest point that was seen, if no box was small enough.
constexpr double kRoughLeast = 1e-6;

/// The boxes of parts, the heaviest first as far as a few points of each tell; in logarithms, as
/// these may be where the density is no number.
class RoughSum {
 public:
  explicit RoughSum(const std::vector<AnyPart>& parts) {
    for (const AnyPart& any : parts) {
      std::visit([&](const auto& part) { push(any, part, part.parameters()); }, any);
    }
  }

  double mass() {
    for (int k = 0; k < kMostRoughBoxes && !queue_.empty(); ++k) {
      const Entry top = queue_.top();
      if (sum_ > 0.0 && top.weight < std::log(kRoughShare * sum_)) break;
      queue_.pop();
      std::visit([&](const auto& part) { look(top, part); }, *top.part);
    }
    return sum_ > 0.0 ? sum_ : kRoughLeast * std::exp(-0.5 * nearest_ * nearest_);
  }

 private:
  struct Entry {
    double weight;
    const AnyPart* part;
    ParameterBox box;

    bool operator<(const Entry& other) const { return weight < other.weight; }
  };

  template <class Part>
  void push(const AnyPart& any, const Part& part, const ParameterBox& box) {
    const double volume =
        scaleOf(part) * volumeOf(box) * std::pow(box.centre[2], Part::kPowerOfDistance);
    if (!(volume > 0.0)) return;
    // No point is much farther from all of them, and none is before the plane.
    const NearPoint near = nearPoint(part, box);
    const typename Part::Cell cell(part, box, directionOf(near.point));
    const double distance = std::max(
        {0.0, near.point.norm() - 0.75 * near.spread, cell.bound(ComplexBox(box)).distance});
    nearest_ = std::min(nearest_, near.point.norm());
    queue_.push({std::log(volume) - 0.5 * distance * distance, &any, box});
  }

  template <class Part>
  void look(const Entry& top, const Part& part) {
    const typename Part::Cell cell(part, top.box, directionOf(nearPoint(part, top.box).point));
    const double largest = supremumOf(cell.bound(ComplexBox(top.box)));
    if (!(largest > 0.0)) return;
    const PartPlan plan =
        planBox(cell, top.box, kRoughTolerance * largest * volumeOf(top.box), guess_);
    if (plan.points[plan.worst()] <= kRoughPoints) {
      const double sum = evaluateBox(part, top.box, plan).sum;
      if (sum > 3.0 * plan.error) {
        sum_ += scaleOf(part) * sum;
        return;
      }
    }
    for (const ParameterBox& half : halves(top.box, plan)) push(*top.part, part, half);
  }

  std::priority_queue<Entry> queue_;
  double sum_ = 0.0, nearest_ = kInfinity;
  EllipseGuess guess_{5, 5, 5};
};

}  // namespace

double roughMass(const std::vector<AnyPart>& parts) { return RoughSum(parts).mass(); }

}  // namespace fcl_prob::detail
