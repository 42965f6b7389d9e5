// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/line_columns.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "base/constants.h"
#include "convex/slab_kernels.h"
#include "fcl_prob/normal_mass.h"

namespace fcl_prob::detail {
namespace {

// Columns that reach to the end of the space are divided so far from their inner side.
constexpr double kStep = 1.5;

// Beyond there is less of the normal distribution, the more so, the farther out.
constexpr double kMiddleOfEnd = 0.5;

constexpr double kRoundedColumns = 1e-12;

double widthOf(double lo, double hi) { return lo <= -kReach || hi >= kReach ? 2 * kStep : hi - lo; }

double within(double lo, double hi, double step) {
  if (lo <= -kReach && hi >= kReach) return 0.0;
  if (hi >= kReach) return lo + step;
  if (lo <= -kReach) return hi - step;
  return 0.5 * (lo + hi);
}

}  // namespace

bool reachesOut(const Column& column) {
  return column.lo.minCoeff() <= -kReach || column.hi.maxCoeff() >= kReach;
}

Eigen::Vector2d middleOf(const Column& column) {
  return {within(column.lo[0], column.hi[0], kMiddleOfEnd),
          within(column.lo[1], column.hi[1], kMiddleOfEnd)};
}

LineColumns::LineColumns(WholeBodyLines& lines) : lines_(lines) {
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(kReach);
  nodes_.push_back(nodeOf({-reach, reach}, lines.everything(), 1.0));
  putInOrder();
}

double LineColumns::most() const {
  double sum = 0.0;
  for (const int column : in_order_) sum += nodes_[column].mass();
  return sum * (1.0 + kRoundedColumns) + kUnderflow;
}

LineColumns::Node LineColumns::nodeOf(const Column& column, const WholeBodyLines::Met& among,
                                      double most) {
  const double measure = normalIntervalMass(column.lo[0], column.hi[0]) *
                         normalIntervalMass(column.lo[1], column.hi[1]);
  WholeBodyLines::Met met = lines_.meet(column, among);
  const double of_met = WholeBodyLines::mostOn(met);
  return {column, std::move(met), std::min(most, of_met), measure};
}

void LineColumns::divideByMass(std::size_t count) {
  by_mass_ = true;
  for (const int column : in_order_) nodes_[column].weight = nodes_[column].mass();
  divide(count, 0.0);
  by_mass_ = false;
}

void LineColumns::divide(std::size_t count, double rest) {
  std::priority_queue<std::pair<double, int>> queue;
  for (const int column : in_order_) queue.push({nodes_[column].weight, column});
  for (std::size_t now = in_order_.size(); now < count && !queue.empty(); ++now) {
    const auto [weight, node] = queue.top();
    if (!(weight > 0.0)) break;
    queue.pop();
    divideOne(node, rest);
    for (const int child : {nodes_[node].left, nodes_[node].left + 1}) {
      queue.push({nodes_[child].weight, child});
    }
  }
  putInOrder();
}

void LineColumns::divideOne(int node, double rest) {
  const Column whole = nodes_[node].column;
  const double most = nodes_[node].most;
  const WholeBodyLines::Met met = std::move(nodes_[node].met);
  const double weight = rest * nodes_[node].weight;
  const auto width = [&whole](int k) { return widthOf(whole.lo[k], whole.hi[k]); };
  const int axis = width(0) >= width(1) ? 0 : 1;
  Column low = whole, high = whole;
  low.hi[axis] = high.lo[axis] = within(whole.lo[axis], whole.hi[axis], kStep);
  nodes_[node].left = static_cast<int>(nodes_.size());
  for (const Column& half : {low, high}) {
    nodes_.push_back(nodeOf(half, met, most));
    Node& child = nodes_.back();
    child.weight = by_mass_ ? child.mass() : child.most > 0.0 ? weight : 0.0;
  }
}

bool LineColumns::mayCollideAt(const Eigen::Vector2d& u) const {
  int node = 0;
  while (nodes_[node].left >= 0) {
    const Column& low = nodes_[nodes_[node].left].column;
    node = nodes_[node].left + ((u.array() <= low.hi.array()).all() ? 0 : 1);
  }
  return nodes_[node].mass() > 0.0;
}

void LineColumns::putInOrder() {
  in_order_.clear();
  std::vector<int> stack{0};
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    if (nodes_[node].left >= 0) {
      stack.push_back(nodes_[node].left + 1);
      stack.push_back(nodes_[node].left);
    } else if (nodes_[node].mass() > 0.0) {
      in_order_.push_back(node);
    }
  }
}

}  // namespace fcl_prob::detail
