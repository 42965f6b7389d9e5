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

// How often each edge is in the triangles: in all, and one way less the other way.
struct EdgeCount {
  int all = 0, net = 0;
};
std::map<std::pair<int, int>, EdgeCount> count_edges(const std::vector<Vec>& vertices,
                                                     const std::vector<Triangle>& triangles) {
  const std::vector<int> point = point_numbers(vertices);
  std::map<std::pair<int, int>, EdgeCount> edges;
  for (const Triangle& t : triangles) {
    const int p[] = {point[t[0]], point[t[1]], point[t[2]]};
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const int from = p[k], to = p[(k + 1) % 3];
      EdgeCount& count = edges[std::minmax(from, to)];
      ++count.all;
      count.net += from < to ? 1 : -1;
    }
  }
  return edges;
}

bool every_edge_even(const std::vector<Vec>& vertices, const std::vector<Triangle>& triangles) {
  for (const auto& edge : count_edges(vertices, triangles)) {
    if (edge.second.all % 2 != 0) return false;
  }
  return true;
}
// Winding numbers are then defined.
bool is_cycle(const std::vector<Vec>& vertices, const std::vector<Triangle>& triangles) {
  for (const auto& edge : count_edges(vertices, triangles)) {
    if (edge.second.net != 0) return false;
  }
  return true;
}

// The sign of det(b - a, c - a, d - a): by doubles where their rounding cannot change it, else
// exactly.
int orientation(const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
  const Vec u = minus(b, a), v = minus(c, a), w = minus(d, a);
  double size = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    size += (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j])) * std::abs(w[i]);
  }
  const double value = dot(cross(u, v), w);
  if (std::abs(value) > 32 * kUnit * size + 1e-290) return value > 0 ? 1 : -1;
  const BallVec o = balls(a);
  return dot(cross(minus(balls(b), o), minus(balls(c), o)), minus(balls(d), o)).sign();
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

// A closed surface of triangles that all support the vertices covers the boundary of the hull, if
// the hull has an inside: where it covers it at all it does so as often everywhere.
void Scene::check_convex(const Part& part) const {
  const Precision exact(2048);
  if (!is_cycle(part.vertices, part.triangles)) {
    throw Malformed(part.line, "triangles", "of a convex part are not closed");
  }
  std::array<BallVec, 3> r;
  for (int i = 0; i < 3; ++i) r[i] = balls(part.rotation[i]);
  const int mirrored = dot(r[0], cross(r[1], r[2])).sign();
  if (mirrored == 0) throw Malformed(part.line, "rotation", "is singular");
  bool has_inside = false;
  for (const Triangle& t : part.triangles) {
    for (const Vec& v : part.vertices) {
      const int side =
          mirrored * orientation(part.vertices[t[0]], part.vertices[t[1]], part.vertices[t[2]], v);
      if (side > 0) throw Malformed(part.line, "triangles", "a vertex is outside of a face");
      has_inside |= side < 0;
    }
  }
  if (!has_inside) throw Malformed(part.line, "vertices", "of a convex part are in a plane");
}

Scene::Scene(const Reader& reader)
    : frame(reader.header),
      solid_contact(reader.header.solid_contact),
      parts(reader.parts),
      cap_lines_(reader.caps) {
  const Vec origin = parts[0][0].translation;
  for (int x = 0; x < 2; ++x) {
    Object object(frame, x == 0, origin);
    for (const Part& part : parts[x]) {
      if (part.convex) check_convex(part);
      object.add_part(part);
      if (!solid_contact || !part.solid || part.convex) continue;
      if (!is_cycle(part.vertices, part.triangles)) {
        throw Malformed(part.line, "solid", "the triangles are not closed as they are oriented");
      }
      solids_[x].push_back({&part, Object(frame, x == 0, origin)});
      solids_[x].back().surface.add_part(part);
      solids_[x].back().surface.finish();
    }
    object.finish();
    objects.push_back(std::move(object));
    add_components(x);

    const Part& first = parts[x][0];
    Object only_caps(frame, x == 0, origin), with_caps(frame, x == 0, origin);
    if (parts[x].size() == 1 && !first.convex) {
      std::vector<Vec> vertices = first.vertices;
      std::vector<Triangle> triangles = first.triangles;
      only_caps.add_part(first, false);
      with_caps.add_part(first);
      if (cap_lines_[x].size() > 1) throw Malformed(cap_lines_[x][1].line, "caps", "come twice");
      for (const Caps& lines : cap_lines_[x]) {
        vertices.insert(vertices.end(), lines.vertices.begin(), lines.vertices.end());
        triangles.insert(triangles.end(), lines.triangles.begin(), lines.triangles.end());
        only_caps.add_caps(first, lines);
        with_caps.add_caps(first, lines);
      }
      is_closed[x] = every_edge_even(vertices, triangles);
      if (!is_closed[x] && !cap_lines_[x].empty()) {
        throw Malformed(cap_lines_[x][0].line, "caps", "do not close the part");
      }
    }
    only_caps.finish();
    with_caps.finish();
    caps.push_back(std::move(only_caps));
    closed.push_back(std::move(with_caps));
  }
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

std::string Scene::touching(const Region& region, const Object& a, const Object& b) const {
  if (a.nodes.empty() || b.nodes.empty()) return "";
  // How far the region reaches along each slab's normal and those of its planes, rounded outwards.
  std::vector<Vec> normals(kSlabNormals.begin(), kSlabNormals.end());
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
  // Rounding to nearest keeps the order, so that a rounded difference beyond a bound proves the
  // exact one to be.
  const auto apart = [&](const Node& k, const Node& l) {
    for (int d = 0; d < kSlabs; ++d) {
      if (l.lo[d] - k.hi[d] > hi[d] || l.hi[d] - k.lo[d] < lo[d]) return true;
    }
    for (std::size_t d = kSlabs; d < normals.size(); ++d) {
      double least = 0, most = 0, size = 0;
      for (int i = 0; i < 3; ++i) {
        const double n = normals[d][i], low = l.lo[i] - k.hi[i], high = l.hi[i] - k.lo[i];
        least += n * (n > 0 ? low : high);
        most += n * (n > 0 ? high : low);
        size += std::abs(n) * std::max(std::abs(low), std::abs(high));
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
      if (separates(frame, region, a, a.pieces[k.piece], b, b.pieces[l.piece])) continue;
      return "piece " + std::to_string(k.piece) + " of A and piece " + std::to_string(l.piece) +
             " of B may touch";
    }
    const bool first = l.piece >= 0 || (k.piece < 0 && k.hi[0] - k.lo[0] + k.hi[1] - k.lo[1] >
                                                           l.hi[0] - l.lo[0] + l.hi[1] - l.lo[1]);
    if (first) {
      open.emplace_back(k.left, j);
      open.emplace_back(k.right, j);
    } else {
      open.emplace_back(i, l.left);
      open.emplace_back(i, l.right);
    }
  }
  return "";
}

Scene::Nesting Scene::nesting(const BallVec& y) const {
  Nesting result = Nesting::kNone;
  for (int x = 0; x < 2 && solid_contact; ++x) {
    for (const Solid& solid : solids_[1 - x]) {
      for (const int v : representatives_[x]) {
        const Crossings found = crossings(x, v, solid.surface, y);
        if (found.known && found.winding != 0) return Nesting::kSome;
        if (!found.known) result = Nesting::kUnknown;
      }
    }
  }
  return result;
}

}  // namespace verify
