// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A planar section of a C-obstacle between two polygons that are refined where it counts.
#pragma once

#include <vector>

#include "base/interruption.h"
#include "exact/principal_section.h"
#include "mass/polygon_mass.h"

namespace fcl_prob::detail {

/// The polygon of points of a section and the one of lines around it. Between two neighbours what
/// is open is a triangle; the one that weighs most is divided where the section is farthest from
/// its chord (the sandwich algorithm; Rote 1992): the gap falls with the square of their number,
/// and vanishes where the section is straight or has a corner.
class SectionPolygons {
 public:
  /// \param section, interruption  outlive this
  SectionPolygons(const PrincipalSection& section, const Interruption& interruption);

  /// Certified mass of the section. \param accuracy  of its relative width
  Bounds mass(double accuracy);

 private:
  struct Node {
    SectionTouch touch;
    std::size_t next;
    bool is_sharp;  ///< searched as far as doubles allow
  };
  struct Arc {
    double gap;
    std::size_t first;
    bool operator<(const Arc& other) const { return gap < other.gap; }
  };

  bool addFirstNodes();
  void addArc(std::size_t first);
  void divide(const Arc& arc);
  void sharpen(std::size_t first);
  void refineUntil(double gap, std::size_t most_nodes);
  void sumAnew();
  double weightOf(const Eigen::Vector2d& p, const Eigen::Vector2d& apex,
                  const Eigen::Vector2d& q) const;
  Eigen::Vector2d whitened(const Eigen::Vector2d& point, double share) const;
  std::vector<std::size_t> ring() const;
  Bounds innerMass() const;
  Bounds outerMass() const;
  Bounds massOf(const Polygon2& corners, double share) const;

  const PrincipalSection& section_;
  const Interruption& interruption_;
  std::vector<Node> nodes_;
  std::vector<Arc> arcs_;  ///< a heap, widest first
  double gap_ = 0.0;       ///< of all arcs
  double summed_gap_ = 0.0;
};

}  // namespace fcl_prob::detail
