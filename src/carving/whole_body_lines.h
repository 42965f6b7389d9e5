// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lines through the displacement space against convex meshes, taken whole, and another mesh.
#pragma once

#include <deque>
#include <memory>
#include <vector>

#include "carving/fan_line.h"
#include "carving/inner_mass.h"
#include "pieces/containment.h"
#include "pieces/whole_body.h"

namespace fcl_prob::detail {

/// What may be left out of a line's mass.
struct LeftOut {
  double share;  ///< of it
  double mass;
};

/// What a convex body covers of a plane, about.
struct Silhouette {
  double radius;  ///< of a disc in it
  double area;    ///< no less
};

/// What members that are nearly convex are taken for. With hulls lines have no less than with the
/// members, and bounds hold from above only; with cores they have no more, and bounds hold from
/// below only, as of surfaces. None: where there are such members, there are no lines.
enum class StandIns { none, hulls, cores };

class WholeBodyLines {
 public:
  /// Null where no object can be taken whole. Keeps references to the pair and the solids.
  /// \param matrix  that of the whitening by which the pair was moved
  /// \param solids  null: surfaces
  static std::unique_ptr<WholeBodyLines> of(const WhitenedPair& pair, const PartitionObject& a,
                                            const PartitionObject& b,
                                            const GaussianDisplacement& displacement,
                                            const Eigen::Matrix3d& matrix,
                                            const SolidContact* solids, StandIns stand_ins);

  std::size_t memberCount() const { return members_.size(); }

  /// Whether bounds on one side of what the members have can be told: from below, or above.
  bool boundsBelow() const { return stand_ins_ != StandIns::hulls; }
  bool boundsAbove() const { return stand_ins_ != StandIns::cores; }

  /// No less than what any line { (s, u) } of a column has of collisions, under N(0, 1): certain.
  double mostOn(const Column& column);

  /// One member where it touches a point of the other mesh.
  struct Touch {
    int member;
    Eigen::Vector3d point;
  };

  struct LineContacts {
    double mass;  ///< about what the line has of collisions, under N(0, 1)
    std::vector<Touch> touches;
  };

  LineContacts contactsOn(const Eigen::Vector2d& u);

  /// No more than what the lines of a column have of collisions in the mean, under N(0, 1):
  /// certain. Those with one member there are counted.
  double leastOn(const Column& column, const Touch& touch) const;

  /// What the line at u has of collisions, under N(0, 1), but for the larger of both.
  double massOn(const Eigen::Vector2d& u, const LeftOut& negligible);

  /// Of what lines can meet of the smallest member in one place: nothing smaller sticks out of the
  /// C-obstacle.
  Silhouette leastSilhouette() const;

 private:
  struct Member {
    Member(WhitenedFan whitened, int its_index)
        : fan(std::move(whitened)), line(fan), inner(fan), index(its_index) {}
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

    WhitenedFan fan;
    FanLine line;
    InnerMass inner;
    int index;
  };

  struct Place {
    Member* member;
    int node;
  };

  struct Visit {
    Place place;
    LineSpan span;
  };

  /// A part of the line on which surfaces touch.
  struct Stretch {
    LineSpan span;
    Place first;            ///< what begins it
    Place last;             ///< what ends it
    Eigen::Vector3d point;  ///< of the triangle that begins it, where it is touched first
  };

  void begin(const Column& column);
  void meet(const Column& column);
  bool isMet(const LineSpan& span) const;
  void addMet(LineSpan span);
  void pushChildren(const Visit& visit);
  bool isSettled(LineSpan& span);
  void beginLine(const LeftOut& negligible);
  void testKnown(const Eigen::Vector2d& u);
  bool endsStretch(double s) const;
  void test(const Visit& visit, const Eigen::Vector2d& u);
  std::optional<double> endOf(const Visit& visit, const Eigen::Matrix3d& corners,
                              const Eigen::Vector2d& u);
  void add(Stretch stretch);
  void joinContained(const Eigen::Vector2d& u);

  std::deque<Member> members_;
  const SolidContact* solids_ = nullptr;
  StandIns stand_ins_ = StandIns::none;  ///< none where all members are convex

  std::vector<LineSpan> met_;  ///< by lines of the column that was looked at last, apart

  // Of the line that is looked at.
  std::vector<Visit> stack_;
  std::vector<Stretch> stretches_;  ///< in order, none of which meet
  std::vector<Place> known_;        ///< leaves at the ends of those of the last line
  double mass_ = 0.0;
  LeftOut negligible_{0.0, 0.0};
  double beyond_ = 0.0;          ///< what is farther out is negligible
  bool left_out_below_ = false;  ///< something was, at that end
  bool left_out_above_ = false;
};

}  // namespace fcl_prob::detail
