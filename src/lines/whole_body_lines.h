// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Lines through the displacement space against convex meshes, taken whole, and another mesh.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "lines/corner_means.h"
#include "lines/fan_line.h"
#include "lines/inner_mass.h"
#include "lines/node_spans.h"
#include "scene/scene.h"

namespace fcl_prob::detail {

/// What may be left out of a line's mass.
struct LeftOut {
  double share;  ///< of it
  double mass;
};

/// What members that are nearly convex are taken for on a line: their hulls, with which a line has
/// no less, or their cores, with which it has no more, as of surfaces.
enum class Taken { hulls, cores };

class WholeBodyLines {
  struct Member;

 public:
  /// Null where no object can be taken whole. Keeps a reference.
  static std::unique_ptr<WholeBodyLines> of(const QueryScene& scene);

  /// Null where the members cannot be taken whole. Keeps references to the pair and the solids.
  /// \param matrix  that of the whitening by which the pair was moved
  /// \param solids  null: surfaces
  static std::unique_ptr<WholeBodyLines> of(const WholeBody& whole, const WhitenedPair& pair,
                                            const Eigen::Matrix3d& matrix,
                                            const SolidContact* solids);

  std::size_t memberCount() const { return members_.size(); }

  /// Whether all members are convex: then it makes no difference what they are taken for.
  bool isConvex() const { return is_convex_; }

  /// By so many deviations, about, rounding moves the ends of what lines have of members.
  double rounding() const;

  /// A member, and a node of the other mesh.
  struct Place {
    Member* member;
    int node;

    bool operator==(const Place& other) const {
      return member == other.member && node == other.node;
    }
  };

  /// A place, and around what some lines have of it.
  struct Visit {
    Place place;
    LineSpan span;
  };

  /// What the lines { (s, u) } of a column may meet: certain.
  struct Met {
    std::vector<LineSpan> spans;  ///< all collisions, in order, apart
    std::vector<Visit> visits;    ///< where all of them are, nearer ones before others
  };

  /// Of all lines.
  Met everything();

  /// \param among  of a column around this one
  Met meet(const Column& column, const Met& among);

  /// No less than what a line has of collisions, under N(0, 1): certain.
  static double mostOn(const Met& met);

  /// A triangle of the other mesh, where a member touches it.
  struct Touching {
    int member;
    int triangle;
  };

  struct LineContacts {
    double mass;                  ///< about what the line has of collisions, under N(0, 1)
    std::vector<Touching> chain;  ///< of one stretch of contact, the next where one ends
  };

  /// \param met  of a column around the line, here and below
  LineContacts contactsOn(const Eigen::Vector2d& u, const Met& met, Taken taken);

  /// No more than what the lines of a column have of collisions in the mean, under N(0, 1):
  /// certain. Those with the triangles of a chain are counted, and nothing where a line at a corner
  /// of the column misses one.
  double leastOn(const Column& column, const std::vector<Touching>& chain);

  /// No less than what the lines of a column have of collisions in the mean, under N(0, 1):
  /// certain. \param met  of that column
  double mostMeanOn(const Column& column, const Met& met);

  /// What the line at u has of collisions, under N(0, 1), but for the larger of both.
  double massOn(const Eigen::Vector2d& u, const Met& met, const LeftOut& negligible, Taken taken);

  /// No less than the area across the lines of the smallest member, about: nothing smaller sticks
  /// out of the C-obstacle.
  double leastArea() const;

 private:
  /// Where it is nearly convex, all of it is within the fan, and the body is its core.
  struct Member {
    Member(WhitenedFan whitened, std::unique_ptr<WhitenedFan> its_core, int its_index)
        : fan(std::move(whitened)),
          core(std::move(its_core)),
          nodes(fan),
          line(body()),
          inner(body()),
          index(its_index) {}
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

    const WhitenedFan& body() const { return core ? *core : fan; }
    FanLine& outermost() { return hull ? *hull : line; }
    FanLine& lineOf(Taken taken) { return taken == Taken::hulls ? outermost() : line; }

    WhitenedFan fan;
    std::unique_ptr<WhitenedFan> core;
    NodeSpans nodes;
    FanLine line;
    std::unique_ptr<FanLine> hull;  ///< null where the body is all of it
    InnerMass inner;
    int index;
  };

  /// Of lines at the corners of a column.
  struct CornerSpans {
    CornerValues from;
    CornerValues to;
  };

  /// A part of the line on which surfaces touch.
  struct Stretch {
    LineSpan span;
    Place first;  ///< what begins it
    Place last;   ///< what ends it
  };

  void addMember(const WholeBody& whole, std::size_t index, const WhitenedPair& pair,
                 const Eigen::Matrix3d& linear);
  static int triangleOf(const Place& place) {
    return place.member->fan.mesh().tree->nodes[place.node].piece;
  }
  void begin(const Column& column, const Met& among);
  CornerValues entriesAt(const CornerMeans& means, const Column& column, const Met& met);
  void lowerTo(const CornerMeans& means, const Visit& leaf, const Eigen::Vector2d& middle,
               CornerValues& entries);
  std::optional<CornerSpans> spansAt(const CornerMeans& means, const Touching& touching);
  std::vector<Touching> chainOf() const;
  void pushChildren(const Visit& visit);
  void testAll(const Eigen::Vector2d& u);
  bool isSettled(LineSpan& span);
  void beginLine(const LeftOut& negligible);
  void remember(const Place& place);
  void testKnown(const Eigen::Vector2d& u);
  void count(const Stretch& stretch);
  bool endsStretch(double s) const;
  void test(const Visit& visit, const Eigen::Vector2d& u);
  std::optional<double> endOf(const Visit& visit, const Eigen::Vector2d& u);
  void add(Stretch stretch);
  void joinContained(const Eigen::Vector2d& u);

  std::deque<Member> members_;
  const SolidContact* solids_ = nullptr;
  bool is_convex_ = true;

  // Of the line that is looked at.
  Taken taken_ = Taken::cores;
  std::vector<Visit> stack_;
  std::vector<Stretch> stretches_;  ///< in order, none of which meet
  std::vector<Stretch> parts_;      ///< what they are made of, one triangle each
  std::vector<Place> known_;        ///< leaves at the ends of those of the last lines
  double mass_ = 0.0;               ///< no more than that of the stretches until all are known
  LeftOut negligible_{0.0, 0.0};
  double beyond_ = 0.0;          ///< what is farther out is negligible
  bool left_out_below_ = false;  ///< something was, at that end
  bool left_out_above_ = false;
};

}  // namespace fcl_prob::detail
