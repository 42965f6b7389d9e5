// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A certified interval by columns of lines, and inside it one that holds but for a stated chance.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "gaussian/bet_sequence.h"
#include "lines/column_bounds.h"
#include "scene/scene.h"

namespace fcl_prob::detail {

/// Where convex meshes can be taken whole, P is the mean of what lines have, whose masses are known
/// but for rounding. Lines are drawn at random from a column, which is drawn in proportion to what
/// may differ in it from what was found there before; what they have more than that, weighted, is a
/// sample of P, bounded by the certified bounds of the columns. A BetSequence of such samples holds
/// at every moment, while columns are divided and what is known of them changes.
class LineBets {
 public:
  /// Null where there are no lines. Keeps references to the objects.
  /// \param error  chance that probable() is ever wrong, in (0, 1)
  static std::unique_ptr<LineBets> of(const PartitionObject& a, const PartitionObject& b,
                                      const GaussianDisplacement& displacement,
                                      const ProbabilityRequest& request, double error);

  Bounds certified() const { return certified_; }

  /// Within certified().
  Bounds probable() const { return probable_; }

  /// P, about.
  double likely() const { return likely_; }

  std::size_t columns() const { return columns_; }
  std::size_t lines() const { return drawn_lines_; }

  /// Looks at columns, divides them, or draws some lines, for one end of the interval.
  /// \param above   whether that is the lower end, which tells what P is above
  /// \param target  where it should be
  /// \return  false where that would take more lines than pay
  bool improve(bool above, double target);

 private:
  /// Columns, and what is known of their lines.
  struct Source {
    Source(WholeBodyLines& lines, Taken its_taken) : taken(its_taken), looks(lines, taken) {}

    /// What lines through a column had, the one in its middle first.
    struct Drawn {
      double sum = 0.0;
      double count = 0.0;
    };

    double meanOf(int column);

    Taken taken;  ///< what members are taken for
    ColumnLooks looks;
    std::unordered_map<int, Drawn> drawn;
  };

  /// One end of the interval.
  struct End {
    std::shared_ptr<Source> source;
    std::optional<BetSequence> bets;  ///< on P if it is the upper one, on -P if the lower one
    std::size_t looked_at = 0;        ///< columns
  };

  /// How the columns are drawn in one batch.
  struct Odds {
    std::vector<double> so_far;  ///< sums of the columns' weights
    double known = 0.0;          ///< P, if all columns have what they are known for
    double all() const { return so_far.empty() ? 0.0 : so_far.back(); }
  };

  LineBets(std::unique_ptr<const QueryScene> scene, const ProbabilityRequest& request,
           double error);
  End& endFor(bool above);
  void look(End& end, bool above);
  Odds oddsOf(Source& source, bool above) const;
  void draw(End& end, const Odds& odds, bool above, double target);
  double massOn(const Source& source, const LineColumns::Node& node,
                const Eigen::Vector2d& uniform);
  void narrow(const Bounds& bounds);

  double error_;
  std::uint64_t seed_;
  std::size_t most_columns_;
  std::unique_ptr<const QueryScene> scene_;
  std::unique_ptr<WholeBodyLines> lines_;
  End below_;
  End above_;
  std::uint64_t drawn_ = 0;
  std::size_t drawn_lines_ = 0;
  std::size_t columns_ = 0;
  Bounds certified_{0.0, 1.0};
  Bounds probable_{0.0, 1.0};
  double likely_ = 0.0;
};

}  // namespace fcl_prob::detail
