// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "lines/fan_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/constants.h"
#include "lines/node_spans.h"

namespace fcl_prob::detail {
namespace {

// Planes that the search for a contact begins with, if they tell most.
constexpr std::size_t kRememberedFaces = 6;

// Planes exchanged for one triangle: more than that is the doing of rounding.
constexpr int kMostExchanges = 64;

// After so many exchanges of planes for the lines of one triangle the search begins anew: each one
// rounds.
constexpr int kMostExchangesKept = 256;

// A plane has to change by that share, of the largest one, to be exchanged; where it is less than
// the second one, what is found is no longer kept, since it is rounded as much more.
constexpr double kLeastShare = 1e-12;
constexpr double kLeastShareKept = 1e-4;

// Nor is it exchanged if all of its change may be rounding: where a face is along T and the lines,
// nothing else is left of its plane. Of the terms that the change is a sum of.
constexpr double kRoundedShare = 16 * kEpsilon;
constexpr double kRoundedShareKept = 1e-6;

// Of the reach: what planes that are added up are rounded by.
constexpr double kRoundedPlane = 1e-13;

// Of the size of P or T: what is outside by no more is taken to be on the boundary.
constexpr double kOutside = 1e-11;

}  // namespace

FanLine::FanLine(const WhitenedFan& fan) : fan_(fan), touched_(Eigen::Vector3d::Zero()) {
  const auto count = static_cast<std::size_t>(fan.faceCount());
  int lowest = 0, highest = 0;
  faces_.reserve(count);
  for (int f = 0; f < fan.faceCount(); ++f) {
    faces_.emplace_back(fan.faceNormal(f) / fan.faceOffset(f));
    const double x = fan.faceNormal(f).x();
    if (x < fan.faceNormal(lowest).x()) lowest = f;
    if (x > fan.faceNormal(highest).x()) highest = f;
  }
  starts_[0].faces = {lowest};
  starts_[1].faces = {highest};
  packNeighbours();
}

// Blocks are filled up with the first face in them.
void FanLine::packNeighbours() {
  const auto count = faces_.size();
  std::vector<int> next(count + 1, 0);
  for (const auto& [f, g] : fan_.arcs()) {
    ++next[f + 1];
    ++next[g + 1];
  }
  constexpr int kRow = FacesInARow::kCount;
  for (std::size_t f = 0; f < count; ++f) {
    next[f + 1] = next[f] + (next[f + 1] + kRow - 1) / kRow * kRow;
  }
  blocks_begin_.resize(count + 1);
  for (std::size_t f = 0; f <= count; ++f) blocks_begin_[f] = next[f] / kRow;
  std::vector<int> neighbours(next.back(), -1);
  for (const auto& [f, g] : fan_.arcs()) {
    neighbours[next[f]++] = g;
    neighbours[next[g]++] = f;
  }
  blocks_.resize(neighbours.size() / kRow);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    for (int i = 0; i < kRow; ++i) {
      const int g = neighbours[kRow * b + i];
      blocks_[b].faces[i] = g < 0 ? blocks_[b].faces[0] : g;
      blocks_[b].d.row(i) = faces_[blocks_[b].faces[i]];
    }
  }
}

// The d are the corners of the polar polytope, and neighbours share an edge of that: from any of
// them one climbs to the one that is farthest in a direction.
int FanLine::highestFace(const Eigen::Vector3d& point, double sign) {
  int& highest = highest_[sign > 0 ? 0 : 1];
  double height = faces_[highest].dot(point);
  for (bool climbs = true; climbs;) {
    climbs = false;
    const int from = highest;
    for (int b = blocks_begin_[from]; b < blocks_begin_[from + 1]; ++b) {
      const FacesInARow& block = blocks_[b];
      const Eigen::Array4d heights =
          block.d.col(0) * point.x() + block.d.col(1) * point.y() + block.d.col(2) * point.z();
      if (!(heights > height).any()) continue;
      Eigen::Index best;
      height = heights.maxCoeff(&best);
      highest = block.faces[best];
      climbs = true;
    }
  }
  return highest;
}

// The one that alone tells most: the largest of its least sign·s over T.
int FanLine::startFor(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign) const {
  int best = -1;
  double most = -kInfinity;
  for (const int face : starts_[sign > 0 ? 0 : 1].faces) {
    const Eigen::Vector3d& d = faces_[face];
    const double extent =
        std::max({d.dot(corners.col(0)), d.dot(corners.col(1)), d.dot(corners.col(2))});
    const double least = (1.0 + extent - d.y() * u[0] - d.z() * u[1]) / (sign * d.x());
    if (!(least > most)) continue;
    most = least;
    best = face;
  }
  return best;
}

void FanLine::remember(int face, double sign) {
  if (!(sign * fan_.faceNormal(face).x() < -kLeastSlope)) return;
  Starts& starts = starts_[sign > 0 ? 0 : 1];
  if (std::find(starts.faces.begin(), starts.faces.end(), face) != starts.faces.end()) return;
  if (starts.faces.size() <= kRememberedFaces) {
    starts.faces.push_back(face);
    return;
  }
  starts.faces[starts.oldest] = face;
  starts.oldest = starts.oldest % kRememberedFaces + 1;
}

// Takes in the half-space g·z <= bound, which the place is outside of, for that of the three
// without which t stays as small as can be (dual simplex: the first row of the inverse has the
// multipliers, turned over). False: no place is within all four. \param terms  what each of g is
// a sum of, at least
bool FanLine::Vertex::exchange(const Eigen::RowVector3d& g, const Eigen::RowVector3d& terms,
                               double bound, int plane) {
  const Eigen::RowVector3d share = g * inverse;
  const Eigen::RowVector3d of_terms = terms * inverse.cwiseAbs();
  const double largest = share.cwiseAbs().maxCoeff();
  int leaving = -1;
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (!(share[i] > std::max(kLeastShare * largest, kRoundedShare * of_terms[i]))) continue;
    const double ratio = std::max(-inverse(0, i), 0.0) / share[i];
    if (ratio < least) {
      least = ratio;
      leaving = i;
    }
  }
  if (leaving < 0) return false;
  const Eigen::Vector3d column = inverse.col(leaving) / share[leaving];
  for (int i = 0; i < 3; ++i) {
    if (i != leaving) inverse.col(i) -= share[i] * column;
  }
  inverse.col(leaving) = column;
  h[leaving] = bound;
  planes[leaving] = plane;
  const bool is_kept =
      share[leaving] > std::max(kLeastShareKept * largest, kRoundedShareKept * of_terms[leaving]);
  exchanges = is_kept ? exchanges + 1 : kMostExchangesKept;
  return true;
}

// One face alone has the least t at a corner of T, where it is bounded by two edges of T besides.
bool FanLine::begin(const Eigen::Matrix3d& corners, const Eigen::Vector2d& u, double sign,
                    Vertex& vertex) const {
  const int start = startFor(corners, u, sign);
  if (start < 0) return false;
  const Eigen::Vector3d& n = faces_[start];
  const double slope = sign * n.x();
  if (!(slope < 0.0)) return false;
  (n.transpose() * corners).maxCoeff(&vertex.corner);
  const Sides sides(corners, vertex.corner);
  vertex.inverse << 1.0 / slope, -n.dot(sides.p) / slope, -n.dot(sides.q) / slope,  //
      0.0, -1.0, 0.0,                                                               //
      0.0, 0.0, -1.0;
  vertex.planes = {start, kFirstEdge, kFirstEdge + 1};
  vertex.exchanges = 0;
  return true;
}

// With z = (sign·s, α, β) and T's points c + α p + β q: every face of P asks for
// n·((s, u) - c - α p - β q) <= offset, and T for α >= 0, β >= 0, α + β <= 1. What changes from
// line to line are the bounds alone: the vertex at which one line's search ended, where t is the
// least within three planes, is one from which t only grows for the next line, too.
std::optional<double> FanLine::first(int triangle, const Eigen::Vector2d& u, double sign,
                                     double limit) {
  const Eigen::Matrix3d corners = fan_.corners(triangle);
  Vertex& vertex = vertices_[sign > 0 ? 0 : 1][triangle];
  const bool is_known = vertex.planes[0] != kNoPlane && vertex.exchanges < kMostExchangesKept;
  if (!is_known && !begin(corners, u, sign, vertex)) return std::nullopt;
  const Sides sides(corners, vertex.corner);
  const auto& [c, p, q] = sides;
  const Eigen::Vector3d base = Eigen::Vector3d(0.0, u[0], u[1]) - c;
  for (int i = 0; i < 3; ++i) {
    const int plane = vertex.planes[i];
    vertex.h[i] = plane >= 0 ? 1.0 - faces_[plane].dot(base) : plane == kLastEdge ? 1.0 : 0.0;
    if (plane >= 0) highest_[sign > 0 ? 0 : 1] = plane;
  }
  for (int exchanges = 0; exchanges < kMostExchanges; ++exchanges) {
    const Eigen::Vector3d z = vertex.place();
    if (z[0] > limit) return std::nullopt;
    const double alpha = std::clamp(z[1], 0.0, 1.0);
    touched_ = base - alpha * p - std::clamp(z[2], 0.0, 1.0 - alpha) * q;
    const double edges[] = {-z[1], -z[2], z[1] + z[2] - 1.0};
    const auto edge = std::max_element(edges, edges + 3) - edges;
    Eigen::RowVector3d g, terms;
    double bound = edge == 2 ? 1.0 : 0.0;
    int plane = kFirstEdge + static_cast<int>(edge);
    if (edges[edge] > kOutside) {
      g << (edge == 0   ? Eigen::RowVector3d(0, -1, 0)
            : edge == 1 ? Eigen::RowVector3d(0, 0, -1)
                        : Eigen::RowVector3d(0, 1, 1));
      terms = g.cwiseAbs();
    } else {
      const Eigen::Vector3d y = base - z[1] * p - z[2] * q + Eigen::Vector3d(sign * z[0], 0, 0);
      plane = highestFace(y, sign);
      const Eigen::Vector3d& d = faces_[plane];
      if (!(d.dot(y) > 1.0 + kOutside)) return z[0];
      remember(plane, sign);
      g << sign * d.x(), -d.dot(p), -d.dot(q);
      terms << 1.0, p.cwiseAbs().sum(), q.cwiseAbs().sum();
      terms *= d.cwiseAbs().maxCoeff();
      bound = 1.0 - d.dot(base);
    }
    if (!vertex.exchange(g, terms, bound, plane)) return std::nullopt;
  }
  return vertex.place()[0];
}

// The multipliers of the last vertex, whichever they are as long as none is negative, add planes of
// P up to one of P ⊕ T: on P it is no farther than the sum of theirs, and T is looked at corner by
// corner.
std::optional<LinePlane> FanLine::planeBefore(int triangle) const {
  const auto known = vertices_[0].find(triangle);
  if (known == vertices_[0].end() || known->second.planes[0] == kNoPlane) return std::nullopt;
  const Vertex& vertex = known->second;
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  double of_body = 0.0, size = 0.0;
  for (int i = 0; i < 3; ++i) {
    const int face = vertex.planes[i];
    const double weight = face >= 0 ? -vertex.inverse(0, i) / fan_.faceOffset(face) : 0.0;
    if (!(weight > 0.0)) continue;
    n += weight * fan_.faceNormal(face);
    of_body += weight * fan_.faceOffset(face);
    size += weight;
  }
  if (!(n.x() < -kLeastSlope * size)) return std::nullopt;
  const double furthest =
      of_body + fan_.extent(triangle, n) + fan_.padding(n) + kRoundedPlane * size * fan_.reach();
  return LinePlane{furthest / n.x(), -n.tail<2>() / n.x()};
}

// From plane to plane, each of which the line leaves before the last one.
double FanLine::endBehindFirst() {
  int face = starts_[1].faces[0];
  for (int exchanges = 0; exchanges < kMostExchanges; ++exchanges) {
    const Eigen::Vector3d& d = faces_[face];
    const double end = (1.0 - d.dot(touched_)) / d.x();
    const Eigen::Vector3d y = touched_ + Eigen::Vector3d(end, 0, 0);
    const int outside = highestFace(y, -1.0);
    if (!(faces_[outside].x() > 0.0) || !(faces_[outside].dot(y) > 1.0 + kOutside)) return end;
    face = outside;
  }
  return -kInfinity;
}

}  // namespace fcl_prob::detail
