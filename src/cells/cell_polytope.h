// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A cell of the displacement space that is a convex polytope, and its mass.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "fcl_prob/bounds.h"
#include "mass/cell_mass.h"
#include "mass/simplex_mass.h"

namespace fcl_prob::detail {

/// A closed surface of polygons around a convex body, up to rounding.
class CellPolytope {
 public:
  /// Vertices closer to a plane than this count as in it.
  static constexpr double kSnap = 1e-13;

  /// A cut of a polytope whose vertices are within kSnap of its planes moves no more than a layer
  /// as thick as this along its faces.
  static constexpr double kCutLayer = 16 * kSnap;

  /// A face has a plane if it is wider.
  static constexpr double kThinFace = 1e-6;

  CellPolytope() = default;
  explicit CellPolytope(const Cell& box);

  bool empty() const { return first_.empty(); }
  const std::vector<Eigen::Vector3d>& vertices() const { return vertices_; }
  std::size_t faceCount() const { return first_.size(); }

  struct Extent {
    double lo;
    double hi;
  };

  /// Of its vertices along a direction.
  Extent along(const Eigen::Vector3d& n) const;

  Eigen::Vector3d middle() const;

  /// How far a point is behind the nearest of its faces' planes, about; negative outside. 0 if a
  /// face is too thin for its plane to be known.
  double depth(const Eigen::Vector3d& point) const;

  struct Ball {
    Eigen::Vector3d middle;
    double radius;  ///< 0 if none was found
  };

  /// Certainly within it.
  Ball ballWithin() const;

  /// Around it.
  Cell box() const;

  /// Bound on the distance between any two points.
  double diameter() const;

  /// Of the distance from the origin, about.
  double nearest() const;

  std::size_t memory() const {
    return vertices_.capacity() * sizeof(Eigen::Vector3d) +
           (corners_.capacity() + first_.capacity()) * sizeof(int);
  }

  /// Certified mass of what the surface encloses under N(0, I), about as accurate as asked
  /// for.
  Bounds mass(const MassAccuracy& accuracy) const;

 private:
  friend class PolytopeCutter;
  /// In that of four vertices far apart, whatever is known of the faces.
  Ball ballOfTetrahedron() const;
  int end(std::size_t face) const {
    return face + 1 < first_.size() ? first_[face + 1] : static_cast<int>(corners_.size());
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<int> first_;
  std::vector<int> corners_;
};

/// Cuts polytopes in two along planes; keeps its memory from one to the next.
class PolytopeCutter {
 public:
  /// \param below  what is in { n·y <= s }, \param above  the rest; either may be null. Both have
  /// the same vertices in the plane.
  void cut(const CellPolytope& body, const Eigen::Vector3d& n, double s, CellPolytope* below,
           CellPolytope* above);

 private:
  struct Crossing {
    int low;
    int high;
    int vertex;
  };
  int crossing(int one, int other);
  void keep(const CellPolytope& body, double side, CellPolytope& part);
  void close(CellPolytope& part);

  CellPolytope low_;
  CellPolytope high_;
  std::vector<Eigen::Vector3d> vertices_;  // the body's and the new ones
  std::vector<double> height_;             // above the plane
  std::vector<Crossing> crossings_;
  std::vector<std::pair<int, int>> rim_;
  std::vector<int> loop_;
  std::vector<int> index_;
};

}  // namespace fcl_prob::detail
