// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A box cut by half-spaces, exactly: as simplices with rational vertices.
#pragma once

#include <gmpxx.h>

#include <map>
#include <unordered_map>
#include <vector>

#include "certificate.h"

namespace verify {

using ExactPoint = std::array<mpq_class, 3>;
/// An enclosure.
BallVec ball(const ExactPoint& point);

class Polytope {
 public:
  Polytope(int rank, const Vec& lo, const Vec& hi);
  /// Keeps what is on the side `side * (normal · y - level) > 0`.
  void cut(const Plane& plane, int side);
  bool empty() const { return simplices_.empty(); }

  int rank() const { return rank_; }
  /// Vertices of the simplices. All lie in the polytope, and its corners are among them.
  std::vector<int> used() const;
  /// Whether all planes are normal to an axis, so that it is a box as well.
  bool is_box() const { return is_box_; }
  /// Normals of the planes that cut it.
  const std::vector<Vec>& normals() const { return normals_; }
  const std::vector<ExactPoint>& vertices() const { return vertices_; }
  /// `rank + 1` vertices each; no two overlap.
  using Simplex = std::array<int, 4>;
  const std::vector<Simplex>& simplices() const { return simplices_; }

 private:
  void keep_positive(Simplex simplex, std::vector<Simplex>& kept);
  int crossing(int positive, int negative);

  int rank_;
  std::vector<ExactPoint> vertices_;
  std::vector<Simplex> simplices_;
  std::vector<Vec> normals_;
  bool is_box_ = true;
  // Of the cut under way: height over the plane, and the new vertex of each
  // edge that crosses it.
  std::vector<mpq_class> heights_;
  std::map<std::pair<int, int>, int> crossings_;
};

/// What is asked of a polytope's inside, an open set, in which something is claimed.
struct Region {
  explicit Region(const Polytope& polytope);

  std::vector<Vec> corners;  // rounded
  Vec bound{};               // of |y|
  /// Corners times positive numbers, to have no division and so no rounding.
  std::vector<BallVec> exact;
  std::vector<Ball> times;
  BallVec center;            // encloses a point of it
  std::vector<Vec> normals;  // of its planes, but for the sides of the box
};

/// Keeps the values at sides, which neighbouring cells share.
class Masses {
 public:
  /// The precision of masses of boxes, of which differences with 1 are wanted.
  explicit Masses(slong bits) : bits_(bits) {}
  Ball box(int rank, const Vec& lo, const Vec& hi);
  /// Of a polytope in this box: to a relative error of some 1e-13, by Gauss and Legendre's rule
  /// with a bound of its error.
  Ball polytope(const Polytope& polytope, const Vec& lo, const Vec& hi);

 private:
  Ball interval(double lo, double hi);
  const Ball& above(double x);  // of x >= 0
  void add_polytope(const Polytope& polytope, Vec lo, Vec hi, Ball& sum);
  slong bits_;
  std::unordered_map<double, Ball> above_;
};

}  // namespace verify
