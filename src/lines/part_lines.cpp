// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/part_lines.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/random_words.h"

namespace fcl_prob::detail {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr std::uint64_t kStream = 0x6c696e65;

RoomyBox boxOfNode(const WhitenedPair& pair, int node, int rank) {
  return node < 0 ? RoomyBox(rank, 0.0) : RoomyBox(pair, {node, 0}, rank);
}

// Of a part among lines of the second kind: one that touches a millionth as often as another has a
// thirtieth of its lines, which is little for what touches never and enough to tell what it does.
double weightOf(const RoomyBox& part) { return std::sqrt(std::sqrt(part.mass())); }

Eigen::Vector3d randomDirection(const std::array<std::uint64_t, 4>& words, int rank) {
  if (rank == 1) return Eigen::Vector3d::UnitX();
  const double angle = kTwoPi * unitUniform(words[0]);
  const double z = rank == 2 ? 0.0 : 2.0 * unitUniform(words[1]) - 1.0;
  const double flat = std::sqrt((1.0 - z) * (1.0 + z));
  return {flat * std::cos(angle), flat * std::sin(angle), z};
}

std::size_t chosen(const std::vector<double>& cumulated, double uniform) {
  const double at = cumulated.back() * uniform;
  const auto one = std::upper_bound(cumulated.begin(), cumulated.end() - 1, at);
  return static_cast<std::size_t>(one - cumulated.begin());
}

}  // namespace

PartLines::PartLines(const WhitenedPair& pair, int rank, std::uint64_t seed)
    : seed_(seed), rank_(rank), all_(rank) {
  const PieceTree& tree = *pair.a.tree;
  const bool is_empty = tree.isEmpty() || pair.b.tree->isEmpty();
  double share = 0.0;
  for (const PieceTree::Part& part : tree.parts) {
    parts_.push_back(boxOfNode(pair, is_empty ? -1 : part.root, rank));
    by_mass_.push_back(mass_ += parts_.back().mass());
    by_share_.push_back(share += weightOf(parts_.back()));
  }
  if (!(mass_ > 0.0)) return;
  if (parts_.size() > 1) {
    for (const RoomyBox& part : parts_) shares_.push_back(weightOf(part) / share);
  }
  all_ = boxOfNode(pair, 0, rank);
  is_by_parts_ = mass_ < all_.mass();
  mass_ = std::min(mass_, all_.mass());
}

const RoomyBox& PartLines::boxOf(std::size_t number, double uniform) const {
  if (!isOfAll(number)) return parts_[chosen(by_share_, uniform)];
  return is_by_parts_ ? parts_[chosen(by_mass_, uniform)] : all_;
}

RandomLine PartLines::line(std::size_t number) const {
  const auto words = randomWords({seed_, kStream}, number);
  const RoomyBox& box = boxOf(number, unitUniform(words[3]));
  const Eigen::Vector3d point = box.point(words);
  const Eigen::Vector3d u = randomDirection(randomWords({seed_, kStream}, number, 1), rank_);
  return {point - point.dot(u) * u, u};
}

PartLines::Frequency PartLines::frequency(const RandomLine& line) const {
  Frequency frequency;
  if (!is_by_parts_) frequency.of_all = all_.massAlong(line) / all_.mass();
  if (!is_by_parts_ && shares_.empty()) return frequency;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double mass = parts_[i].mass() > 0.0 ? parts_[i].massAlong(line) : 0.0;
    if (!(mass > 0.0)) continue;
    if (is_by_parts_) frequency.of_all += mass / mass_;
    if (!shares_.empty()) frequency.of_parts += shares_[i] * mass / parts_[i].mass();
  }
  return frequency;
}

double PartLines::leastOfAll(std::size_t lines) const {
  return is_by_parts_ || !(mass_ > 0.0) ? 0.0 : shareOfAll(lines) / mass_ * all_.massOverDensity();
}

double PartLines::leastOfPart(std::size_t part, std::size_t lines) const {
  const RoomyBox& box = parts_[part];
  if (!(box.mass() > 0.0)) return kInfinity;
  double frequency = is_by_parts_ ? shareOfAll(lines) / mass_ : 0.0;
  if (!shares_.empty()) frequency += (1.0 - shareOfAll(lines)) * shares_[part] / box.mass();
  return frequency * box.massOverDensity();
}

}  // namespace fcl_prob::detail
