// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cells/whole_body_tester.h"

#include "base/left_out.h"

#include <utility>

namespace fcl_prob::detail {
namespace {

bool isClear(const NodeBox& box, const Eigen::Vector3d& pad, const Eigen::Vector3d& middle,
             const Eigen::Vector3d& half) {
  for (int k = 0; k < 3; ++k) {
    if (middle[k] - half[k] > box.hi[k] + pad[k] || middle[k] + half[k] < box.lo[k] - pad[k]) {
      return true;
    }
  }
  return false;
}

}  // namespace

std::unique_ptr<WholeBodyTester> WholeBodyTester::of(const QueryScene& scene) {
  if (!scene.convexBody() || isLeftOut("quick tester")) return nullptr;
  return of(*scene.convexBody(), scene.pair(), scene.whitening().matrix());
}

std::unique_ptr<WholeBodyTester> WholeBodyTester::of(const WholeBody& whole,
                                                     const WhitenedPair& pair,
                                                     const Eigen::Matrix3d& matrix) {
  if (pair.band) return nullptr;
  auto tester = std::make_unique<WholeBodyTester>();
  for (std::size_t i = 0; i < whole.body.parts.size(); ++i) {
    const PieceTree::Part& part = whole.body.tree->parts[i];
    WhitenedFan fan(pair, part, *part.fan, whole.body_is_a,
                    matrix * whole.body.parts[i].pose.linear());
    if (!fan.usable() || mayHoldPart(whole, i, fan)) return nullptr;
    tester->members_.emplace_back(std::move(fan));
  }
  return tester;
}

PointContact WholeBodyTester::at(const Eigen::Vector3d& y) {
  PointContact found = PointContact::none;
  for (Member& member : members_) {
    const PointContact contact = memberAt(member, y);
    if (contact == PointContact::touching) return contact;
    if (contact == PointContact::unknown) found = contact;
  }
  return found;
}

WholeBodyTester::Visit WholeBodyTester::visitOf(const Member& member, int node,
                                                const Eigen::Vector3d& y) {
  const NodeBox box = member.fan.cornerBox(node);
  const Eigen::Map<const Eigen::Vector3d> lo(box.lo), hi(box.hi);
  return {node, y - 0.5 * (lo + hi), 0.5 * (hi - lo)};
}

// What is nearer to the middle of P comes first: it may touch.
PointContact WholeBodyTester::memberAt(Member& member, const Eigen::Vector3d& y) {
  const WhitenedFan& fan = member.fan;
  const auto& nodes = fan.mesh().tree->nodes;
  PointContact found = PointContact::none;
  stack_.assign(1, visitOf(member, 0, y));
  while (!stack_.empty()) {
    const Visit visit = stack_.back();
    stack_.pop_back();
    if (isClear(fan.box(), fan.pad(), visit.middle, visit.half)) continue;
    if (member.contact.isClearOf(visit.middle, visit.half)) continue;
    const PieceTree::Node& node = nodes[visit.node];
    if (node.isLeaf()) {
      const Eigen::Matrix3d corners = (-fan.corners(node.piece)).colwise() + y;
      const PointContact contact = member.contact.with(corners);
      if (contact == PointContact::touching) return contact;
      if (contact == PointContact::unknown) found = contact;
      continue;
    }
    Visit left = visitOf(member, node.left, y);
    Visit right = visitOf(member, node.right, y);
    if (left.middle.squaredNorm() < right.middle.squaredNorm()) std::swap(left, right);
    stack_.push_back(left);
    stack_.push_back(right);
  }
  return found;
}

}  // namespace fcl_prob::detail
