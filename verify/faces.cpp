// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "faces.h"

#include <algorithm>
#include <cmath>

namespace verify {
namespace {

Vec edge(const Object& object, int from, int to) {
  return minus(object.points[to], object.points[from]);
}

}  // namespace

// Regions beyond `reach_` are not contained, so that rounding is bounded for what is up to there.
Faces::Faces(const Frame& frame, const Object& a, const Piece& k, const Object& b, const Piece& l)
    : frame_(frame), a_(a), b_(b), k_(k), l_(l) {
  for (int i = 0; i < 3; ++i) {
    reach_[i] = (a.bound[i] + b.bound[i]) * (1 + 1e-9) + DBL_MIN;
    error_[i] = (2 * (a.error[i] + b.error[i]) + 32 * kUnit * reach_[i]) * (1 + 1e-9) + DBL_MIN;
  }
  const auto of_k = edges_of(a, k), of_l = edges_of(b, l);
  has_inside_ = has_inside(of_k, of_l);
  for (const Triangle& t : k.faces) add({&a, t[0], t[1], {}}, {&a, t[0], t[2], {}});
  for (const Triangle& t : l.faces) add({&b, t[0], t[1], {}}, {&b, t[0], t[2], {}});
  for (const FaceEdge& e : of_k) {
    for (const FaceEdge& f : of_l) {
      if (!is_no_face(e, f)) add(e, f);
    }
  }
}

std::vector<Faces::FaceEdge> Faces::edges_of(const Object& object, const Piece& piece) {
  std::map<std::pair<int, int>, std::pair<FaceEdge, int>> edges;
  for (const Triangle& face : piece.faces) {
    for (int i = 0; i < 3; ++i) {
      const int from = face[i], to = face[(i + 1) % 3], third = face[(i + 2) % 3];
      auto& [at, count] =
          edges.try_emplace(std::minmax(from, to), FaceEdge{&object, from, to, {-1, -1}}, 0)
              .first->second;
      if (count < 2) at.across[count] = third;
      ++count;
    }
  }
  std::vector<FaceEdge> result;
  for (auto& [ends, found] : edges) {
    if (found.second != 2) found.first.across[0] = found.first.across[1] = -1;
    result.push_back(found.first);
  }
  return result;
}

// The plane along both edges supports K or L only if both faces at its edge are on one side of it.
bool Faces::is_no_face(const FaceEdge& e, const FaceEdge& f) const {
  const Vec u = edge(a_, e.from, e.to), v = edge(b_, f.from, f.to);
  const auto crosses = [&](const FaceEdge& at) {
    if (at.across[0] < 0) return false;
    int signs = 1;
    for (const int third : at.across) {
      signs *= certain_sign(edge(*at.object, at.from, third), error_, u, v, error_);
    }
    return signs < 0;
  };
  return crosses(e) || crosses(f);
}

// Of triangles: whether of two edges of each three are in no plane. Other hulls have been checked.
bool Faces::has_inside(const std::vector<FaceEdge>& of_k, const std::vector<FaceEdge>& of_l) const {
  if (k_.vertices.size() > 3 || l_.vertices.size() > 3) return true;
  if (of_k.size() < 2 || of_l.size() < 2) return false;
  std::vector<BallVec> edges;
  for (int i = 0; i < 2; ++i) {
    edges.push_back(minus(a_.world(of_k[i].to), a_.world(of_k[i].from)));
    edges.push_back(minus(b_.world(of_l[i].to), b_.world(of_l[i].from)));
  }
  for (int out = 0; out < 4; ++out) {
    const BallVec normal = cross(edges[(out + 1) % 4], edges[(out + 2) % 4]);
    if (dot(normal, edges[(out + 3) % 4]).sign() != 0) return true;
  }
  return false;
}

void Faces::add(const FaceEdge& first, const FaceEdge& second) {
  const Vec u = edge(*first.object, first.from, first.to);
  const Vec v = edge(*second.object, second.from, second.to);
  Slab slab{cross(u, v), 0, 0, first, second};
  double k_lo = DBL_MAX, k_hi = -DBL_MAX, l_lo = DBL_MAX, l_hi = -DBL_MAX, margin = DBL_MIN;
  for (const int vertex : k_.vertices) {
    const double height = dot(slab.normal, a_.points[vertex]);
    k_lo = std::min(k_lo, height);
    k_hi = std::max(k_hi, height);
  }
  for (const int vertex : l_.vertices) {
    const double height = dot(slab.normal, b_.points[vertex]);
    l_lo = std::min(l_lo, height);
    l_hi = std::max(l_hi, height);
  }
  // The normal is off by its edges' errors, which counts as far as anything reaches; heights are by
  // those of the points.
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double of_normal = error_[j] * (std::abs(v[k]) + std::abs(u[k]) + error_[k]) +
                             error_[k] * (std::abs(v[j]) + std::abs(u[j]) + error_[j]) +
                             8 * kUnit * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
    margin += 4 * of_normal * reach_[i] + 2 * (std::abs(slab.normal[i]) + of_normal) * error_[i];
  }
  margin *= 1 + 1e-9;
  slab.lo = l_lo - k_hi + margin;
  slab.hi = l_hi - k_lo - margin;
  slabs_.push_back(slab);
}

bool Faces::contains_exactly(const Slab& slab, const Region& region) const {
  const auto exact = [](const FaceEdge& e) {
    return minus(e.object->world(e.to), e.object->world(e.from));
  };
  const Heights heights(frame_, a_, k_, b_, l_, cross(exact(slab.first), exact(slab.second)));
  for (std::size_t i = 0; i < region.corners.size(); ++i) {
    const Region::Corner corner = region.exact_corner(i);
    const Ball value = heights.at(corner);
    if (!(value <= heights.hi * corner.times && heights.lo * corner.times <= value)) return false;
  }
  return true;
}

std::string Faces::contain(const Region& region) const {
  if (!has_inside_) return "the two pieces touch in no displacements with an inside";
  for (const Vec& corner : region.corners) {
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(corner[i]) <= reach_[i])) return "the pieces do not reach so far";
    }
  }
  for (const Slab& slab : slabs_) {
    const auto inside = [&](const Vec& corner) {
      const double height = dot(slab.normal, corner);
      return slab.lo < height && height < slab.hi;
    };
    if (std::all_of(region.corners.begin(), region.corners.end(), inside)) continue;
    if (!contains_exactly(slab, region)) return "the pieces do not certainly touch in all of it";
  }
  return "";
}

std::shared_ptr<const Faces> FacesOfPairs::get(const Frame& frame, const Object& a, int k,
                                               const Object& b, int l) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = known_.find({k, l});
    if (found != known_.end()) return found->second;
  }
  auto faces = std::make_shared<const Faces>(frame, a, a.pieces[k], b, b.pieces[l]);
  const std::lock_guard<std::mutex> lock(mutex_);
  return known_.try_emplace({k, l}, std::move(faces)).first->second;
}

}  // namespace verify
