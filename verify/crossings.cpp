// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Whether a point is inside a closed surface: by what a ray from it crosses.
#include <cmath>

#include "scene.h"

namespace verify {
namespace {

// A box of directions, seen from the point, that the ray along d misses for certain.
bool misses(const Vec& lo, const Vec& hi, const Vec& d) {
  Vec center, half;
  for (int i = 0; i < 3; ++i) {
    if ((d[i] >= 0 && hi[i] < 0) || (d[i] <= 0 && lo[i] > 0)) return true;
    center[i] = 0.5 * (lo[i] + hi[i]);
    half[i] = 0.5 * (hi[i] - lo[i]) + 4 * kUnit * (std::abs(lo[i]) + std::abs(hi[i]));
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double a = center[j] * d[k], b = center[k] * d[j];
    const double reach = half[j] * std::abs(d[k]) + half[k] * std::abs(d[j]);
    if (std::abs(a - b) > (reach + 8 * kUnit * (std::abs(a) + std::abs(b))) * (1 + 1e-10)) {
      return true;
    }
  }
  return false;
}

// 1 or -1 for a triangle that the ray crosses, by its orientation; 0 for none; `unclear` if it may
// be on an edge, or the point on the triangle.
template <class Sign>
int crossing(const Sign& sign, bool& unclear) {
  const int ab = sign(0, 1), bc = sign(1, 2), ca = sign(2, 0);
  if ((ab > 0 || bc > 0 || ca > 0) && (ab < 0 || bc < 0 || ca < 0)) return 0;
  if (ab == 0 || bc == 0 || ca == 0) {
    unclear = true;
    return 0;
  }
  const int side = sign(-1, -1);  // of det(a, b, c)
  if (side == 0) unclear = true;
  return side == ab ? side : 0;
}

}  // namespace

Scene::Crossings Scene::crossings(int x, int vertex, const Object& surface,
                                  const BallVec& exact_y) const {
  Vec y;
  for (int i = 0; i < 3; ++i) y[i] = exact_y[i].nearest();
  const Object& object = objects[x];
  const double s = x == 0 ? 1 : -1;  // A moves by y; as seen from A, B moves by -y
  Vec eye, error;
  for (int i = 0; i < 3; ++i) {
    eye[i] = object.points[vertex][i] + s * y[i];
    error[i] = object.error[i] + surface.error[i] +
               4 * kUnit * (object.bound[i] + surface.bound[i] + std::abs(y[i]));
    error[i] = error[i] * (1 + 1e-10) + DBL_MIN;
  }
  BallVec exact_eye = object.world(vertex);
  const BallVec moved = plus(frame.to_world(exact_y), frame.mean);
  exact_eye = x == 0 ? plus(exact_eye, moved) : minus(exact_eye, moved);

  // No direction that a modeller would draw an edge along.
  const Vec directions[] = {{1, 0.131278, 0.0731297},
                            {-0.0912771, 1, 0.21879},
                            {0.157361, -0.29871, 1},
                            {0.61723, 0.4117, -1.0931},
                            {-1.1393, 0.7731, 0.31777}};
  std::vector<int> open;
  for (const Vec& d : directions) {
    Crossings result;
    bool unclear = false;
    const BallVec exact_d = frame.to_world(balls(d));
    const auto visit = [&](const Piece& piece) {
      Vec seen[3];
      for (int i = 0; i < 3; ++i) seen[i] = minus(surface.points[piece.vertices[i]], eye);
      const auto by_doubles = [&](int i, int j) {
        return i >= 0 ? certain_sign(d, {}, seen[i], seen[j], error)
                      : certain_sign(seen[0], error, seen[1], seen[2], error);
      };
      bool retry = false;
      int found = crossing(by_doubles, retry);
      if (retry) {
        BallVec exact[3];
        for (int i = 0; i < 3; ++i) exact[i] = minus(surface.world(piece.vertices[i]), exact_eye);
        const int mirrored = frame.determinant.sign();
        const auto exactly = [&](int i, int j) {
          return mirrored * (i >= 0 ? dot(exact_d, cross(exact[i], exact[j])).sign()
                                    : dot(exact[0], cross(exact[1], exact[2])).sign());
        };
        found = crossing(exactly, unclear);
      }
      result.odd ^= found != 0;
      result.winding += found;
    };
    open.assign(surface.nodes.empty() ? 0 : 1, 0);
    while (!open.empty() && !unclear) {
      const Node& node = surface.nodes[open.back()];
      open.pop_back();
      Vec lo, hi;
      for (int i = 0; i < 3; ++i) {
        lo[i] = node.lo[i] - eye[i] - error[i];
        hi[i] = node.hi[i] - eye[i] + error[i];
      }
      if (misses(lo, hi, d)) continue;
      if (node.piece >= 0) {
        visit(surface.pieces[node.piece]);
      } else {
        open.push_back(node.left);
        open.push_back(node.right);
      }
    }
    result.known = !unclear;
    if (result.known) return result;
  }
  return {};
}

}  // namespace verify
