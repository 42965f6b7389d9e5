// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where lines along the first axis are within the C-obstacles of a convex mesh, taken whole.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <unordered_map>
#include <vector>

#include "scene/whitened_fan.h"

namespace fcl_prob::detail {

/// A plane across the lines: the one at u passes it at s = at + slope·u.
struct LinePlane {
  double at;
  Eigen::Vector2d slope;

  double on(const Eigen::Vector2d& u) const { return at + slope.dot(u); }
};

/// Lines { (s, u_0, u_1) } against P ⊕ T. Nothing of where they enter and leave it is certified.
class FanLine {
 public:
  /// Keeps a reference to the fan.
  explicit FanLine(const WhitenedFan& fan);

  /// The least sign·s for which (s, u_0, u_1) is in P ⊕ T; nothing if there is none below a limit.
  std::optional<double> first(int triangle, const Eigen::Vector2d& u, double sign, double limit);

  /// After first(): the largest s for which (s, u_0, u_1) is in P put to where T was touched.
  double endBehindFirst();

  /// What all of P ⊕ T is behind: certain, whatever lines first() was asked for before. Nothing
  /// before it was asked for any, with sign 1.
  std::optional<LinePlane> planeBefore(int triangle) const;

  /// After first(): that point of T.
  Eigen::Vector3d touchedPoint(const Eigen::Vector2d& u) const {
    return Eigen::Vector3d(0.0, u[0], u[1]) - touched_;
  }

 private:
  /// Faces that planes of C-obstacles were last found at, behind the one that faces the lines most.
  struct Starts {
    std::vector<int> faces;
    std::size_t oldest = 1;
  };

  // What bounds a vertex: a face of P, or one of three edges of T.
  static constexpr int kFirstEdge = -3;
  static constexpr int kLastEdge = -1;
  static constexpr int kNoPlane = -4;

  /// Three planes g·z = h in the space of z = (t, α, β), by the inverse of the matrix of their g.
  struct Vertex {
    Eigen::Matrix3d inverse;
    Eigen::Vector3d h;
    std::array<int, 3> planes{kNoPlane, kNoPlane, kNoPlane};
    int corner = 0;     ///< of T, which α and β are from
    int exchanges = 0;  ///< that led here

    Eigen::Vector3d place() const { return inverse * h; }
    bool exchange(const Eigen::RowVector3d& g, const Eigen::RowVector3d& terms, double bound,
                  int plane);
  };

  /// One corner of T, and the ways to the other two.
  struct Sides {
    Sides(const Eigen::Matrix3d& corners, int corner)
        : c(corners.col(corner)),
          p(corners.col((corner + 1) % 3) - c),
          q(corners.col((corner + 2) % 3) - c) {}

    Eigen::Vector3d c, p, q;
  };

  /// A few faces, to be looked at in one go.
  struct FacesInARow {
    static constexpr int kCount = 4;

    Eigen::Array<double, kCount, 3> d;
    std::array<int, kCount> faces;
  };

  void packNeighbours();
  bool begin(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign,
             Vertex& vertex) const;
  int startFor(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign) const;
  void remember(int face, double sign);
  int highestFace(const Eigen::Vector3d& point, double sign);

  const WhitenedFan& fan_;
  std::vector<Eigen::Vector3d> faces_;  ///< d: P is where d·y <= 1 for all of them
  std::vector<FacesInARow> blocks_;     ///< the neighbours of all faces
  std::vector<int> blocks_begin_;       ///< of each of them, and the end
  std::array<Starts, 2> starts_;        ///< for lines from above and from below
  std::array<std::unordered_map<int, Vertex>, 2>
      vertices_;                  ///< at which searches ended, by triangle
  std::array<int, 2> highest_{};  ///< faces that were found last, from above and from below
  Eigen::Vector3d touched_;       ///< (0, u_0, u_1) less the point of T
};

}  // namespace fcl_prob::detail
