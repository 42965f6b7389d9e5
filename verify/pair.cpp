// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Contact of two convex pieces in all of a region: whether L - K contains it, by the half-spaces
// across the faces of L - K.
#include <algorithm>
#include <cmath>
#include <map>

#include "claims.h"

namespace verify {
namespace {

// An edge with the third vertices of the two faces at it; -1 where there are not just two.
struct FaceEdge {
  int from, to;
  int across[2];
};

std::vector<FaceEdge> edges_of(const Object& object, const Piece& piece,
                               const std::vector<Triangle>& faces) {
  (void)object;
  std::map<std::pair<int, int>, FaceEdge> edges;
  for (const Triangle& face : faces) {
    for (int i = 0; i < 3; ++i) {
      const int from = face[i], to = face[(i + 1) % 3], third = face[(i + 2) % 3];
      const auto [edge, is_new] =
          edges.try_emplace(std::minmax(from, to), FaceEdge{from, to, {third, -1}});
      if (!is_new) edge->second.across[1] = edge->second.across[1] == -1 ? third : -2;
    }
  }
  std::vector<FaceEdge> result;
  for (const auto& edge : edges) result.push_back(edge.second);
  for (FaceEdge& edge : result) {
    if (edge.across[1] < 0 || piece.vertices.size() == 3) edge.across[0] = edge.across[1] = -1;
  }
  return result;
}

class Containment {
 public:
  Containment(const Scene& scene, const Region& region, const Piece& k, const Piece& l)
      : scene_(scene), region_(region), a_(scene.objects[0]), b_(scene.objects[1]), k_(k), l_(l) {
    for (int i = 0; i < 3; ++i) {
      const double bounds = a_.bound[i] + b_.bound[i] + region_.bound[i];
      error_[i] = (a_.error[i] + b_.error[i] + 16 * kUnit * bounds) * (1 + 1e-10) + DBL_MIN;
    }
  }

  std::string check(const std::vector<Triangle>& faces_k,
                    const std::vector<Triangle>& faces_l) const {
    const auto of_k = edges_of(a_, k_, faces_k);
    const auto of_l = edges_of(b_, l_, faces_l);
    if (!has_inside(of_k, of_l)) return "L - K may have no inside";
    for (const Triangle& f : faces_k) {
      if (!within(a_, f[0], f[1], a_, f[0], f[2])) return fault("a face of K");
    }
    for (const Triangle& f : faces_l) {
      if (!within(b_, f[0], f[1], b_, f[0], f[2])) return fault("a face of L");
    }
    for (const FaceEdge& e : of_k) {
      for (const FaceEdge& f : of_l) {
        if (is_no_face(e, f) || within(a_, e.from, e.to, b_, f.from, f.to)) continue;
        return fault("an edge of each");
      }
    }
    return "";
  }

 private:
  static std::string fault(const std::string& what) {
    return "the region is not certainly inside of the half-spaces of " + what;
  }

  Vec edge(const Object& object, int from, int to) const {
    return minus(object.points[to], object.points[from]);
  }

  // Whether the plane along the two edges certainly supports K only if it does not support L, or
  // the like: at one of the edges both faces have to be on one side of it.
  bool is_no_face(const FaceEdge& e, const FaceEdge& f) const {
    const Vec u = edge(a_, e.from, e.to), v = edge(b_, f.from, f.to);
    const auto crosses = [&](const Object& object, const FaceEdge& at) {
      if (at.across[0] < 0) return false;
      int signs = 1;
      for (const int third : at.across) {
        signs *= certain_sign(edge(object, at.from, third), error_, u, v, error_);
      }
      return signs < 0;
    };
    return crosses(a_, e) || crosses(b_, f);
  }

  // Four edges, of which three that are in no plane are looked for.
  bool has_inside(const std::vector<FaceEdge>& of_k, const std::vector<FaceEdge>& of_l) const {
    if (k_.vertices.size() > 3 || l_.vertices.size() > 3)
      return true;  // checked to be no flat hulls
    std::vector<BallVec> edges;
    for (int i = 0; i < 2; ++i) {
      edges.push_back(minus(a_.world(of_k[i].to), a_.world(of_k[i].from)));
      edges.push_back(minus(b_.world(of_l[i].to), b_.world(of_l[i].from)));
    }
    for (int left_out = 0; left_out < 4; ++left_out) {
      const BallVec& first = edges[(left_out + 1) % 4];
      if (dot(first, cross(edges[(left_out + 2) % 4], edges[(left_out + 3) % 4])).sign() != 0) {
        return true;
      }
    }
    return false;
  }

  // Whether the region is between the planes that support L - K, along the two edges, on both
  // sides.
  bool within(const Object& x, int from, int to, const Object& y, int from2, int to2) const {
    const Vec normal = cross(edge(x, from, to), edge(y, from2, to2));
    double k_lo = DBL_MAX, k_hi = -DBL_MAX, l_lo = DBL_MAX, l_hi = -DBL_MAX, margin = 0;
    for (const int v : k_.vertices) {
      const double height = dot(normal, a_.points[v]);
      k_lo = std::min(k_lo, height);
      k_hi = std::max(k_hi, height);
    }
    for (const int v : l_.vertices) {
      const double height = dot(normal, b_.points[v]);
      l_lo = std::min(l_lo, height);
      l_hi = std::max(l_hi, height);
    }
    // The rounding of the normal itself: three coordinates' errors times the edges' and times the
    // distances.
    const Vec u = edge(x, from, to), v = edge(y, from2, to2);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const double of_normal = error_[j] * (std::abs(v[k]) + std::abs(u[k]) + error_[k]) +
                               error_[k] * (std::abs(v[j]) + std::abs(u[j]) + error_[j]) +
                               8 * kUnit * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
      const double reach = a_.bound[i] + b_.bound[i] + region_.bound[i];
      margin += 2 * of_normal * reach + (std::abs(normal[i]) + of_normal) * error_[i];
    }
    margin = margin * (1 + 1e-10) + DBL_MIN;
    bool certain = true;
    for (const Vec& corner : region_.corners) {
      const double height = dot(normal, corner);
      certain = certain && height < l_hi - k_lo - margin && height > l_lo - k_hi + margin;
    }
    return certain || within_exactly(x, from, to, y, from2, to2);
  }

  bool within_exactly(const Object& x, int from, int to, const Object& y, int from2,
                      int to2) const {
    const BallVec normal =
        cross(minus(x.world(to), x.world(from)), minus(y.world(to2), y.world(from2)));
    const auto range = [&](const Object& object, const Piece& piece, Ball& lo, Ball& hi) {
      for (std::size_t i = 0; i < piece.vertices.size(); ++i) {
        const Ball height = dot(normal, object.world(piece.vertices[i]));
        lo = i == 0 ? height : min(lo, height);
        hi = i == 0 ? height : max(hi, height);
      }
    };
    Ball k_lo, k_hi, l_lo, l_hi;
    range(a_, k_, k_lo, k_hi);
    range(b_, l_, l_lo, l_hi);
    const Frame& frame = scene_.frame;
    BallVec slope;
    for (int i = 0; i < frame.rank; ++i) slope[i] = dot(normal, frame.columns[i]);
    const Ball constant = dot(normal, frame.mean);
    const Ball lo = l_lo - k_hi, hi = l_hi - k_lo;
    for (std::size_t i = 0; i < region_.corners.size(); ++i) {
      const auto [corner, times] = region_.exact_corner(i);
      const Ball value = dot(slope, corner) + constant * times;
      if (!(value <= hi * times) || !(lo * times <= value)) return false;
    }
    return true;
  }

  const Scene& scene_;
  const Region& region_;
  const Object &a_, &b_;
  const Piece &k_, &l_;
  Vec error_;
};

}  // namespace

std::string check_pair(const Scene& scene, const Region& region, const Piece& k, const Piece& l) {
  return Containment(scene, region, k, l).check(k.faces, l.faces);
}

}  // namespace verify
