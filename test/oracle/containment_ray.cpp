// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "containment_ray.h"

#include <array>
#include <cmath>
#include <optional>

#include "origin_search.h"

namespace oracle {

namespace {

using Direction = std::array<int, 3>;

// Small whole numbers, so that products with them are exact; none lies along an axis or a diagonal.
constexpr Direction kDirections[] = {{97, 11, 5},    {-7, 89, 13},    {3, -17, 83},
                                     {-79, 19, -23}, {29, -73, 31},   {-37, 41, 71},
                                     {67, 61, -43},  {-59, -47, -53}, {101, 103, 107},
                                     {-109, 113, 2}, {1, 127, -131},  {137, -139, 149}};

LongVector asLong(const Direction& d) {
  return {static_cast<Long>(d[0]), static_cast<Long>(d[1]), static_cast<Long>(d[2])};
}

ExactVector asExact(const Direction& d) { return {Rational(d[0]), Rational(d[1]), Rational(d[2])}; }

// Whether a point of the ray may be in the box.
bool mayMeet(const PieceBox& box, const Query& query, const LongVector& direction) {
  Long from = 0, to = std::numeric_limits<Long>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Long pad = 8 * query.error[k];
    const Long first = (box.lo[k] - query.point[k] - pad) / direction[k];
    const Long second = (box.hi[k] - query.point[k] + pad) / direction[k];
    from = std::max(from, std::min(first, second));
    to = std::min(to, std::max(first, second));
  }
  // The quotients are rounded.
  const Long rounding = std::ldexp(1.0L, -60);
  return !(from > to * (1 + rounding));
}

/// The crossings of one ray with the triangles of a mesh.
class Ray {
 public:
  Ray(const Part& mesh, const Query& query, const Direction& direction, std::size_t& exact)
      : mesh_(mesh),
        query_(query),
        direction_(direction),
        along_(asLong(direction)),
        exact_questions_(exact) {}

  /// Nothing if the ray meets an edge or a vertex.
  std::optional<int> winding() {
    int sum = 0;
    std::vector<int> stack;
    if (!mesh_.nodes().empty()) stack.push_back(0);
    while (!stack.empty()) {
      const PieceNode& node = mesh_.nodes()[static_cast<std::size_t>(stack.back())];
      stack.pop_back();
      if (!mayMeet(node.box, query_, along_)) continue;
      if (node.piece >= 0) {
        if (mesh_.hasEqualCorners(node.piece)) continue;
        const std::optional<int> crossing = crossingOf(mesh_.triangle(node.piece));
        if (!crossing) return std::nullopt;
        sum += *crossing;
      } else {
        stack.push_back(node.left);
        stack.push_back(node.right);
      }
    }
    return sum;
  }

 private:
  // 1 or -1 by the side from which the ray meets the triangle, 0 if it misses it.
  std::optional<int> crossingOf(const int* triangle) {
    int around[3];
    for (int k = 0; k < 3; ++k) around[k] = sideOfEdge(triangle[k], triangle[(k + 1) % 3]);
    // A line across which all of the triangle lies, whatever the third side says.
    for (int k = 0; k < 3; ++k) {
      if (around[k] * around[(k + 1) % 3] < 0) return 0;
    }
    if (around[0] == 0 || around[1] == 0 || around[2] == 0) {
      // Within an edge's plane: perhaps far from the edge itself, which another ray will tell.
      return std::nullopt;
    }
    const int ahead = sideOfPlane(triangle);
    if (ahead == 0) return std::nullopt;
    return ahead == around[0] ? around[0] : 0;
  }

  int sideOfEdge(int from, int to) {
    const LongVector u = mesh_.vertex(from) - query_.point, v = mesh_.vertex(to) - query_.point;
    const LongVector normal = u.cross(v);
    Long doubt = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const Long ej = query_.error[j], ek = query_.error[k];
      doubt += std::fabs(along_[i]) * (ej * (std::fabs(u[k]) + std::fabs(v[k]) + ek) +
                                       ek * (std::fabs(u[j]) + std::fabs(v[j]) + ej));
    }
    const Long value = along_.dot(normal);
    if (std::fabs(value) > 8 * doubt) return value > 0 ? 1 : -1;
    ++exact_questions_;
    const ExactVector point = query_.exact();
    const Rational exact = determinant(asExact(direction_), mesh_.exactVertex(from) - point,
                                       mesh_.exactVertex(to) - point);
    return exact.sign();
  }

  int sideOfPlane(const int* t) {
    const auto relative = [&](int i) -> Vector<Long> {
      const LongVector v = mesh_.vertex(i) - query_.point;
      return {v[0], v[1], v[2]};
    };
    const int sign = certainSign(relative(t[0]), relative(t[1]), relative(t[2]),
                                 {query_.error[0], query_.error[1], query_.error[2]});
    if (sign != 0) return sign;
    ++exact_questions_;
    const ExactVector point = query_.exact();
    return determinant(mesh_.exactVertex(t[0]) - point, mesh_.exactVertex(t[1]) - point,
                       mesh_.exactVertex(t[2]) - point)
        .sign();
  }

  const Part& mesh_;
  const Query& query_;
  Direction direction_;
  LongVector along_;
  std::size_t& exact_questions_;
};

}  // namespace

Verdict isFilledAt(const Part& mesh, const Query& query, std::size_t& exact_questions) {
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(query.point[k]) > mesh.extent()[k] + query.error[k]) return Verdict::apart;
  }
  for (const Direction& direction : kDirections) {
    Ray ray(mesh, query, direction, exact_questions);
    if (const auto winding = ray.winding()) {
      return *winding != 0 ? Verdict::touching : Verdict::apart;
    }
  }
  return Verdict::undecided;
}

}  // namespace oracle
