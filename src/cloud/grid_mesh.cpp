// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cloud/grid_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

constexpr std::uint8_t kRight = 1;
constexpr std::uint8_t kBelow = 2;

constexpr double kNever = std::numeric_limits<double>::infinity();

struct Pixel {
  int u;
  int v;
};

/// A right isosceles triangle: the hypotenuse from a to b, the right angle at c.
struct GridTriangle {
  Pixel a;
  Pixel b;
  Pixel c;

  Pixel middle() const { return {(a.u + b.u) / 2, (a.v + b.v) / 2}; }
  bool isSmallest() const { return std::abs(a.u - c.u) + std::abs(a.v - c.v) <= 1; }
  GridTriangle first() const { return {c, a, middle()}; }
  GridTriangle second() const { return {b, c, middle()}; }
};

class GridMesher {
 public:
  GridMesher(const DepthGrid& grid, double most, bool across_jumps)
      : grid_(grid), most_(most), across_jumps_(across_jumps) {
    while (side_ + 1 < std::max(grid.width, grid.height)) {
      side_ *= 2;
      levels_ += 2;
    }
    errors_.assign(static_cast<std::size_t>(side_ + 1) * static_cast<std::size_t>(side_ + 1), 0.0F);
    lookAtPixels();
  }

  GridMesh run() {
    // Parents after their children: both sides of an edge agree on whether it is divided.
    for (int level = levels_; level-- > 0;) {
      visitLevel([this](const GridTriangle& t) { measure(t); }, level);
    }
    vertex_of_.assign(grid_.size(), -1);
    for (const GridTriangle& root : roots()) emit(root);
    return std::move(result_);
  }

 private:
  std::array<GridTriangle, 2> roots() const {
    return {{{{0, 0}, {side_, side_}, {side_, 0}}, {{side_, side_}, {0, 0}, {0, side_}}}};
  }

  // The triangles are two binary trees; those beyond the image are left out.
  template <typename Visit>
  void visitLevel(const Visit& visit, int level) const {
    for (const GridTriangle& root : roots()) visitBelow(root, visit, level);
  }

  template <typename Visit>
  void visitBelow(const GridTriangle& t, const Visit& visit, int levels) const {
    if (!reachesImage(t)) return;
    if (levels == 0) return visit(t);
    visitBelow(t.first(), visit, levels - 1);
    visitBelow(t.second(), visit, levels - 1);
  }

  void measure(const GridTriangle& t) {
    float& error = errorAt(t.middle());
    if (error == std::numeric_limits<float>::infinity()) return;
    if (!t.first().isSmallest()) {
      error = std::max({error, errorAt(t.first().middle()), errorAt(t.second().middle())});
    }
    if (error <= most_) error = std::max(error, static_cast<float>(errorOf(t)));
  }

  float& errorAt(Pixel p) {
    return errors_[static_cast<std::size_t>(p.v) * static_cast<std::size_t>(side_ + 1) +
                   static_cast<std::size_t>(p.u)];
  }

  bool has(Pixel p) const { return grid_.has(p.u, p.v); }

  bool joined(Pixel p, Pixel q) const {
    return across_jumps_ || grid_.connected(grid_.at(p.u, p.v), grid_.at(q.u, q.v));
  }

  // What every level of triangles asks again.
  void lookAtPixels() {
    points_.resize(grid_.size());
    cut_.assign(grid_.size(), 0);
    for (int v = 0; v < grid_.height; ++v) {
      for (int u = 0; u < grid_.width; ++u) {
        const int pixel = grid_.at(u, v);
        if (!grid_.has(u, v)) continue;
        points_[pixel] = grid_.rays[pixel] / grid_.inverse[pixel];
        if (has({u + 1, v}) && !joined({u, v}, {u + 1, v})) cut_[pixel] |= kRight;
        if (has({u, v + 1}) && !joined({u, v}, {u, v + 1})) cut_[pixel] |= kBelow;
      }
    }
  }

  // The farthest pixel of a triangle from it, or kNever.
  double errorOf(const GridTriangle& t) const {
    if (!has(t.a) || !has(t.b) || !has(t.c)) return kNever;
    const Eigen::Vector3d a = at(t.a), b = at(t.b), c = at(t.c);
    const double det = (t.a.u - t.c.u) * (t.b.v - t.c.v) - (t.b.u - t.c.u) * (t.a.v - t.c.v);
    const auto [lo_u, hi_u] = std::minmax({t.a.u, t.b.u, t.c.u});
    const auto [lo_v, hi_v] = std::minmax({t.a.v, t.b.v, t.c.v});
    double farthest = 0.0;
    for (int v = lo_v; v <= hi_v; ++v) {
      for (int u = lo_u; u <= hi_u; ++u) {
        const double x = ((u - t.c.u) * (t.b.v - t.c.v) - (t.b.u - t.c.u) * (v - t.c.v)) / det;
        const double y = ((t.a.u - t.c.u) * (v - t.c.v) - (u - t.c.u) * (t.a.v - t.c.v)) / det;
        if (x < -1e-9 || y < -1e-9 || x + y > 1.0 + 1e-9) continue;
        if (!grid_.has(u, v)) return kNever;
        const std::uint8_t cut = cut_[grid_.at(u, v)];
        if ((u < hi_u && (cut & kRight)) || (v < hi_v && (cut & kBelow))) return kNever;
        const Eigen::Vector3d on = x * a + y * b + (1.0 - x - y) * c;
        farthest = std::max(farthest, (at({u, v}) - on).norm());
        if (farthest > most_) return kNever;
      }
    }
    return farthest;
  }

  const Eigen::Vector3d& at(Pixel p) const { return points_[grid_.at(p.u, p.v)]; }

  void emit(const GridTriangle& t) {
    if (!t.isSmallest() && (errorAt(t.middle()) > most_ || !isInside(t))) {
      if (!reachesImage(t)) return;
      emit(t.first());
      emit(t.second());
      return;
    }
    if (t.isSmallest()) {
      if (!has(t.a) || !has(t.b) || !has(t.c)) return;
      if (!joined(t.a, t.c) || !joined(t.b, t.c) || !joined(t.a, t.b)) return;
    } else {
      result_.deviation = std::max(result_.deviation, static_cast<double>(errorAt(t.middle())));
    }
    result_.mesh.triangles.emplace_back(vertex(t.a), vertex(t.b), vertex(t.c));
  }

  bool isInside(const GridTriangle& t) const { return has(t.a) && has(t.b) && has(t.c); }

  bool reachesImage(const GridTriangle& t) const {
    return std::min({t.a.u, t.b.u, t.c.u}) < grid_.width &&
           std::min({t.a.v, t.b.v, t.c.v}) < grid_.height;
  }

  std::size_t vertex(Pixel p) {
    const int pixel = grid_.at(p.u, p.v);
    if (vertex_of_[pixel] < 0) {
      vertex_of_[pixel] = static_cast<int>(result_.pixels.size());
      result_.pixels.push_back(pixel);
      result_.mesh.vertices.push_back(grid_.point(pixel));
    }
    return static_cast<std::size_t>(vertex_of_[pixel]);
  }

  const DepthGrid& grid_;
  double most_;
  bool across_jumps_;
  int side_ = 1;
  int levels_ = 0;                       ///< of triangles with children
  std::vector<Eigen::Vector3d> points_;  // sensor frame
  std::vector<std::uint8_t> cut_;        // towards which neighbours a jump lies: kRight, kBelow
  std::vector<float> errors_;
  std::vector<int> vertex_of_;
  GridMesh result_;
};

}  // namespace

GridMesh meshOf(const DepthGrid& grid, double most, bool across_jumps) {
  return GridMesher(grid, most, across_jumps).run();
}

TriangleMesh shadowOf(const TriangleMesh& front, const Eigen::Vector3d& eye, double depth) {
  TriangleMesh result = front;
  const std::size_t count = front.vertices.size();
  for (const Eigen::Vector3d& vertex : front.vertices) {
    result.vertices.push_back(vertex + depth * (vertex - eye).normalized());
  }
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  for (const fcl::Triangle& t : front.triangles) {
    result.triangles.emplace_back(t[0] + count, t[2] + count, t[1] + count);
    for (int k = 0; k < 3; ++k) {
      const std::size_t from = t[k], to = t[(k + 1) % 3];
      ++edges[std::minmax(from, to)];
    }
  }
  for (const fcl::Triangle& t : front.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::size_t from = t[k], to = t[(k + 1) % 3];
      if (edges[std::minmax(from, to)] != 1) continue;
      result.triangles.emplace_back(to, from, from + count);
      result.triangles.emplace_back(to, from + count, to + count);
    }
  }
  return result;
}

}  // namespace fcl_prob::detail
