// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace verify {
namespace {

// Numbers vertices so that those at one point have one number.
std::vector<int> point_numbers(const std::vector<Vec>& vertices) {
  std::map<Vec, int> numbers;
  std::vector<int> result;
  for (Vec v : vertices) {
    for (double& x : v) x += 0.0;  // no -0
    result.push_back(numbers.try_emplace(v, static_cast<int>(numbers.size())).first->second);
  }
  return result;
}

// Whether every edge is in an even number of triangles; `oriented`: as often one way as the other,
// so that winding numbers are defined.
bool is_closed(const std::vector<Vec>& vertices, const std::vector<Triangle>& triangles,
               bool oriented) {
  const std::vector<int> point = point_numbers(vertices);
  std::map<std::pair<int, int>, int> edges;
  for (const Triangle& t : triangles) {
    const int p[] = {point[t[0]], point[t[1]], point[t[2]]};
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const int from = p[k], to = p[(k + 1) % 3];
      edges[std::minmax(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    return oriented ? edge.second == 0 : edge.second % 2 == 0;
  });
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

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

// 1 or -1 for a triangle, as seen from where the ray along d starts, that it crosses, by its
// orientation; 0 for none; `unclear` if it may be on an edge, or its start on the triangle.
int crossing(const BallVec& d, const std::array<BallVec, 3>& t, bool& unclear) {
  int sign[3];
  for (int i = 0; i < 3; ++i) sign[i] = dot(d, cross(t[i], t[(i + 1) % 3])).sign();
  const auto [least, most] = std::minmax_element(sign, sign + 3);
  if (*least < 0 && *most > 0) return 0;
  const int side = dot(t[0], cross(t[1], t[2])).sign();
  unclear = unclear || side == 0 || std::count(sign, sign + 3, 0) > 0;
  return side == sign[0] ? side : 0;
}

// The largest coordinate of what parts are made of.
double size_of(const std::array<std::vector<Part>, 2>& parts) {
  double size = 0;
  for (const std::vector<Part>& object : parts) {
    for (const Part& part : object) {
      size = std::max(size, part.radius);
      for (const Vec& v : part.vertices) {
        for (const double x : v) size = std::max(size, std::abs(x));
      }
    }
  }
  return size > 0 ? size : 1;
}

}  // namespace

Scene::Scene(const Reader& reader)
    : frame(reader.header, size_of(reader.parts)),
      solid_contact(reader.header.solid_contact),
      parts(reader.parts) {
  for (const int x : {0, 1}) {
    add_object(x, reader.caps[x]);
    add_components(x);
  }
}

void Scene::add_object(int x, const std::vector<Caps>& cap_lines) {
  const Object none(frame, x, parts[0][0].translation);
  Object all = none, only_caps = none, with_caps = none;
  for (const Part& part : parts[x]) {
    all.add_part(part);
    if (!solid_contact || !part.solid || part.convex) continue;
    if (!verify::is_closed(part.vertices, part.triangles, true)) {
      throw Malformed(part.line, "the triangles are not closed as they are oriented");
    }
    solids_[x].push_back(none);
    solids_[x].back().add_part(part);
    solids_[x].back().finish();
  }
  const Part& first = parts[x][0];
  if (parts[x].size() == 1 && !first.convex) {
    std::vector<Vec> vertices = first.vertices;
    std::vector<Triangle> triangles = first.triangles;
    only_caps.add_part(first, false);
    with_caps.add_part(first);
    if (cap_lines.size() > 1) throw Malformed(cap_lines[1].line, "caps come twice");
    for (const Caps& lines : cap_lines) {
      vertices.insert(vertices.end(), lines.vertices.begin(), lines.vertices.end());
      triangles.insert(triangles.end(), lines.triangles.begin(), lines.triangles.end());
      only_caps.add_caps(first, lines);
      with_caps.add_caps(first, lines);
    }
    is_closed[x] = verify::is_closed(vertices, triangles, false);
    if (!is_closed[x] && !cap_lines.empty()) {
      throw Malformed(cap_lines[0].line, "caps do not close the part");
    }
  }
  for (Object* object : {&all, &only_caps, &with_caps}) object->finish();
  objects.push_back(std::move(all));
  caps.push_back(std::move(only_caps));
  closed.push_back(std::move(with_caps));
}

void Scene::add_components(int x) {
  int first = 0;
  for (const Part& part : parts[x]) {
    const std::vector<int> point = point_numbers(part.vertices);
    std::vector<int> parent(point.size());
    std::iota(parent.begin(), parent.end(), 0);
    std::vector<bool> in_piece(point.size(), part.convex);
    if (part.convex) std::fill(parent.begin(), parent.end(), 0);
    for (const Triangle& t : part.triangles) {
      for (const int v : t) {
        in_piece[v] = true;
        parent[root(parent, point[v])] = root(parent, point[t[0]]);
      }
    }
    std::map<int, bool> seen;
    for (std::size_t v = 0; v < point.size(); ++v) {
      const int name = root(parent, point[v]);
      component[x].push_back(in_piece[v] ? first + name : -1);
      if (in_piece[v] && seen.try_emplace(name, true).second) {
        representatives_[x].push_back(first + static_cast<int>(v));
      }
    }
    first += static_cast<int>(point.size());
  }
}

void Scene::check_apart(const Region& region, const Object& a, const Object& b) const {
  if (a.nodes.empty() || b.nodes.empty()) return;
  // How far the region reaches along the axes and the normals of its planes, rounded outwards.
  std::vector<Vec> normals{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  normals.insert(normals.end(), region.normals.begin(), region.normals.end());
  std::vector<double> lo(normals.size(), DBL_MAX), hi(normals.size(), -DBL_MAX);
  for (std::size_t d = 0; d < normals.size(); ++d) {
    double margin = DBL_MIN;
    for (int i = 0; i < 3; ++i) margin += 16 * kUnit * std::abs(normals[d][i]) * region.bound[i];
    for (const Vec& corner : region.corners) {
      lo[d] = std::min(lo[d], dot(normals[d], corner) - margin);
      hi[d] = std::max(hi[d], dot(normals[d], corner) + margin);
    }
  }
  const auto apart = [&](const Node& k, const Node& l) {
    const Vec low = minus(l.lo, k.hi), high = minus(l.hi, k.lo);
    // Rounding to nearest keeps the order.
    for (int i = 0; i < 3; ++i) {
      if (low[i] > hi[i] || high[i] < lo[i]) return true;
    }
    for (std::size_t d = 3; d < normals.size(); ++d) {
      double least = 0, most = 0, size = 0;
      for (int i = 0; i < 3; ++i) {
        const double n = normals[d][i];
        least += n * (n > 0 ? low[i] : high[i]);
        most += n * (n > 0 ? high[i] : low[i]);
        size += std::abs(n) * std::max(std::abs(low[i]), std::abs(high[i]));
      }
      const double margin = 16 * kUnit * size + DBL_MIN;
      if (least - margin > hi[d] || most + margin < lo[d]) return true;
    }
    return false;
  };
  std::vector<std::pair<int, int>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const Node &k = a.nodes[i], &l = b.nodes[j];
    if (apart(k, l)) continue;
    if (k.piece >= 0 && l.piece >= 0) {
      require(
          separates(frame, region, a, a.pieces[k.piece], b, b.pieces[l.piece]),
          "pieces " + std::to_string(k.piece) + " and " + std::to_string(l.piece) + " may touch");
      continue;
    }
    const Vec k_size = minus(k.hi, k.lo), l_size = minus(l.hi, l.lo), sum{1, 1, 1};
    if (l.piece >= 0 || (k.piece < 0 && dot(k_size, sum) > dot(l_size, sum))) {
      open.emplace_back(k.left, j);
      open.emplace_back(k.right, j);
    } else {
      open.emplace_back(i, l.left);
      open.emplace_back(i, l.right);
    }
  }
}

Scene::Crossings Scene::crossings(int x, int vertex, const Object& surface,
                                  const BallVec& y) const {
  // A moves by y; as seen from A, B moves by -y.
  const BallVec moved = frame.to_world(y), &at = objects[x].exact[vertex];
  const BallVec exact_eye = x == 0 ? plus(at, moved) : minus(at, moved);
  Vec eye, error;
  for (int i = 0; i < 3; ++i) {
    const double step = y[i].nearest();
    eye[i] = objects[x].points[vertex][i] + (x == 0 ? step : -step);
    error[i] = objects[x].error[i] + 4 * kUnit * (objects[x].bound[i] + std::abs(step)) + DBL_MIN;
  }
  // No direction that a modeller would draw an edge along.
  const Vec directions[] = {{1, 0.131278, 0.0731297},
                            {-0.0912771, 1, 0.21879},
                            {0.157361, -0.29871, 1},
                            {0.61723, 0.4117, -1.0931},
                            {-1.1393, 0.7731, 0.31777}};
  for (int attempt = 0; attempt < 10; ++attempt) {
    const Precision enough(attempt < 5 ? 128 : 2400);
    const Vec& d = directions[attempt % 5];
    const BallVec exact_d = frame.to_world(balls(d));
    Crossings result;
    bool unclear = false;
    std::vector<int> open(surface.nodes.empty() ? 0 : 1, 0);
    while (!open.empty() && !unclear) {
      const Node& node = surface.nodes[open.back()];
      open.pop_back();
      if (misses(minus(minus(node.lo, eye), error), plus(minus(node.hi, eye), error), d)) continue;
      if (node.piece < 0) {
        open.push_back(node.left);
        open.push_back(node.right);
        continue;
      }
      std::array<BallVec, 3> seen;
      for (int i = 0; i < 3; ++i) {
        seen[i] = minus(surface.exact[surface.pieces[node.piece].vertices[i]], exact_eye);
      }
      const int found = crossing(exact_d, seen, unclear);
      result.odd ^= found != 0;
      result.winding += found;
    }
    result.known = !unclear;
    if (result.known) return result;
  }
  return {};
}

Scene::Nesting Scene::nesting(const BallVec& y) const {
  Nesting result = Nesting::kNone;
  for (int x = 0; x < 2 && solid_contact; ++x) {
    for (const Object& solid : solids_[1 - x]) {
      for (const int v : representatives_[x]) {
        const Crossings found = crossings(x, v, solid, y);
        if (found.known && found.winding != 0) return Nesting::kSome;
        if (!found.known) result = Nesting::kUnknown;
      }
    }
  }
  return result;
}

}  // namespace verify
