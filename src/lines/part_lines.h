// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Random lines through the displacement space, more of them where the parts of A may touch B.
#pragma once

#include <cstdint>
#include <vector>

#include "cells/roomy_box.h"

namespace fcl_prob::detail {

/// Evenly drawn a line goes through a normally distributed point in a random direction. Here such
/// points are within boxes around C-obstacles, which makes a line more frequent by the mass that it
/// has within a box, over that of the box: what is rare is met by many lines, too. There are two
/// kinds of lines (a mixture by fixed shares: Veach and Guibas 1995): in boxes that are chosen by
/// their masses, for P; and in those of all parts of A more alike, for what each of them does.
class PartLines {
 public:
  /// Keeps a reference. \param rank  of the displacement, at least 1
  PartLines(const WhitenedPair& pair, int rank, std::uint64_t seed);

  /// Whether a line is of the first kind.
  bool isOfAll(std::size_t number) const {
    return shares_.empty() || number % kPeriod + 1 < kPeriod;
  }
  /// How many of the first so many lines are.
  std::size_t countOfAll(std::size_t lines) const {
    return shares_.empty() ? lines : lines - lines / kPeriod;
  }

  RandomLine line(std::size_t number) const;

  /// How much more frequent a line is among those of a kind.
  struct Frequency {
    double of_all = 0.0;
    double of_parts = 0.0;  ///< 0 without lines of the second kind
  };
  Frequency frequency(const RandomLine& line) const;

  /// No less than P and than the mass on a line over how frequent it is among the first kind.
  double mostOfLine() const { return mass_; }

  /// A line on which parts touch is, among so many, no less frequent than the largest density where
  /// they do, times this, ...
  double leastOfAll(std::size_t lines) const;

  /// ... and, for each of these parts, the largest density where that does, times this. Infinite of
  /// a part that is out of reach.
  double leastOfPart(std::size_t part, std::size_t lines) const;

  /// No less than the mean, over even lines, of the density at an end where a part touches.
  double meanOfEnd(std::size_t part) const {
    return parts_[part].mass() / parts_[part].massOverDensity();
  }

 private:
  double shareOfAll(std::size_t lines) const {
    return static_cast<double>(countOfAll(lines)) / static_cast<double>(lines);
  }

  // Every so many lines one is of the second kind: an eighth of the standard error of P for what
  // that tells of parts that touch seldom.
  static constexpr std::size_t kPeriod = 5;

  const RoomyBox& boxOf(std::size_t number, double uniform) const;

  std::uint64_t seed_;
  int rank_;
  RoomyBox all_;
  std::vector<RoomyBox> parts_;
  bool is_by_parts_ = false;     ///< the first kind
  double mass_ = 0.0;            ///< of the boxes of the first kind, added up; 0: lines are even
  std::vector<double> shares_;   ///< of the parts in lines of the second kind
  std::vector<double> by_mass_;  ///< masses up to each part
  std::vector<double> by_share_;
};

}  // namespace fcl_prob::detail
