// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Finds where contact begins, by a few hundred questions whether there is one.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "pose/boundary_model.h"

namespace fcl_prob::detail {

class BoundarySearch {
 public:
  /// Whether there is contact at x, which is N(0, I) in so many dimensions.
  using Question = std::function<bool(const Eigen::VectorXd&)>;

  /// Keeps a reference.
  BoundarySearch(const Question& collides, Eigen::Index dimension, std::uint64_t seed)
      : collides_(collides), dimension_(dimension), seed_(seed) {}

  /// A model by a plane; nothing where no contact is seen, or nothing else, even far out.
  std::optional<BoundaryModel> plane();

  /// The same as a quadric, by more points of the boundary: so many for each of its coefficients.
  void bend(BoundaryModel& model, int points_each);

  /// How many questions bend() asks, about, with the points that there are already.
  double questionsOfBend(int points_each) const;

  std::size_t questions() const { return questions_; }

 private:
  Eigen::VectorXd nextNormals();
  bool asked(const Eigen::VectorXd& x);
  std::optional<BoundaryModel> halfSpace();
  Eigen::Index missingFor(int points_each) const;
  std::optional<double> levelOn(const BoundaryModel& model, const Eigen::VectorXd& across,
                                double guess, double step);
  void addPoints(const BoundaryModel& model, Eigen::Index count, double step);

  const Question& collides_;
  Eigen::Index dimension_;
  std::uint64_t seed_;
  std::uint64_t drawn_ = 0;
  std::size_t questions_ = 0;
  Eigen::MatrixXd points_;  ///< of the boundary
};

}  // namespace fcl_prob::detail
