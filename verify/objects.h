// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The displacement and the objects in coordinates in which regions are boxes: points x of the world
// become y' = M'^-1 (x - origin), where the columns of M' are those of the displacement and, where
// its rank is below three, any others. A region is then a box that is flat beyond the rank. What is
// decided by doubles is decided in these coordinates, of which an error is known; what is not, by
// balls in those of the world.
#pragma once

#include <vector>

#include "ball.h"
#include "certificate.h"

namespace verify {

/// `ε(y) = mean + Σ columns[i] y_i` over i below the rank.
struct Frame {
  /// \param size  about how large the objects are: a length where the rank is zero
  Frame(const Header& header, double size);
  /// `M' v` of a vector of y'.
  BallVec to_world(const BallVec& v) const;
  /// What is a normal n in y' is `M'^-T n` there, rounded.
  Vec normal_in_world(const Vec& n) const;

  int rank;
  slong bits;  // the precision in which to decide: all exact, if there is no whitening
  BallVec mean;
  std::array<BallVec, 3> columns;
  std::array<BallVec, 3> cofactors;  // each normal to the other two columns
  Ball determinant;
  std::array<Vec, 3> inverse;  // rows of M'^-1, rounded
  Vec reach{};                 // how far a ball of radius 1 reaches along y'_i, rounded up
};

/// The hull of its vertices, swept by a ball that is turned with its part.
struct Piece {
  std::vector<int> vertices;
  double radius = 0;
  const std::array<Vec, 3>* rotation = nullptr;  // of the part; only where there is a ball

  /// R v, from the frame of the part to the world; 0 without a ball.
  template <class T>
  std::array<T, 3> turned(const std::array<T, 3>& v) const {
    std::array<T, 3> result{};
    for (int i = 0; i < 3 && radius > 0; ++i) {
      for (int j = 0; j < 3; ++j) result[i] = result[i] + T((*rotation)[i][j]) * v[j];
    }
    return result;
  }
  /// R^T n, of a normal in the world; 0 without a ball.
  template <class T>
  std::array<T, 3> turned_back(const std::array<T, 3>& n) const {
    std::array<T, 3> result{};
    for (int i = 0; i < 3 && radius > 0; ++i) {
      for (int j = 0; j < 3; ++j) result[j] = result[j] + T((*rotation)[i][j]) * n[i];
    }
    return result;
  }
  /// A point of the ball, in the frame of the part: about the one that is farthest along a normal
  /// in the world.
  Vec farthest_swept(const Vec& normal) const;
  double size_of_rotation() const;  // not below its norm
};

/// Of a tree of boxes.
struct Node {
  Vec lo, hi;                 // rounded outwards
  int left = -1, right = -1;  // nodes; a leaf has none
  int piece = -1;
};

/// A or B, or a part of it, or its caps. Points of B are moved by -mean, so that A and B touch at
/// y' = l' - k'.
class Object {
 public:
  Object(const Frame& frame, int object, const Vec& origin)
      : frame_(&frame), object_(object), origin_(origin) {}
  /// Adds the vertices of a part, and its pieces unless told otherwise.
  void add_part(const Part& part, bool with_pieces = true);
  /// Adds vertices and triangles, which count on from the vertices of the only part there is.
  void add_caps(const Part& part, const Caps& caps);
  /// Builds the tree; to be called once, at the end.
  void finish();
  /// One vertex as an object with one piece.
  Object single(int vertex) const;

  std::vector<BallVec> exact;  // points in the world
  std::vector<Vec> points;     // y', rounded
  Vec error{};                 // of each coordinate of them
  Vec bound{};                 // of their absolute values
  std::vector<Piece> pieces;
  std::vector<Node> nodes;  // the root first; none if there are no pieces

 private:
  void add_vertex(const Part& part, const Vec& vertex);
  int build(int* first, int* last);

  const Frame* frame_;
  int object_;
  Vec origin_;
};

}  // namespace verify
