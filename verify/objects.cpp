// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "objects.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace verify {

thread_local slong Ball::bits = ARF_PREC_EXACT;

namespace {

BallVec scaled(const BallVec& v, const Ball& by) { return {v[0] * by, v[1] * by, v[2] * by}; }

// Rows made orthonormal one after the other; entries beyond the rank are zero.
std::vector<BallVec> gram_schmidt(std::vector<BallVec> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      rows[i] = minus(rows[i], scaled(rows[j], dot(rows[i], rows[j])));
    }
    const Ball length = sqrt(dot(rows[i], rows[i]));
    if (length.sign() <= 0) throw Malformed(1, "whitening rows depend on each other");
    rows[i] = scaled(rows[i], Ball(1) / length);
  }
  return rows;
}

// Which entry is largest.
std::size_t largest(const BallVec& v) {
  return std::max_element(v.begin(), v.end(),
                          [](const Ball& a, const Ball& b) { return abs(a) < abs(b); }) -
         v.begin();
}

// Fills up the columns of the displacement to a basis, along axes, by what is about as long as the
// first one, or as the objects where there is none.
void complete(std::array<BallVec, 3>& columns, int rank, double size) {
  if (rank == 0) columns[0][0] = Ball(size);
  rank = std::max(rank, 1);
  const std::size_t first = largest(columns[0]);
  const Ball length = columns[0][first];
  if (rank == 1) columns[1][(first + 1) % 3] = columns[2][(first + 2) % 3] = length;
  if (rank == 2) columns[2][largest(cross(columns[0], columns[1]))] = length;
}

}  // namespace

Frame::Frame(const Header& header, double size)
    : rank(header.rank),
      bits(header.whitening.empty() ? ARF_PREC_EXACT : 320),
      mean(balls(header.mean)) {
  Ball::bits = bits;
  std::array<BallVec, 3> scaled_axes;
  for (int j = 0; j < rank; ++j) {
    scaled_axes[j] = scaled(balls(header.axes[j]), Ball(header.deviations[j]));
  }
  columns = scaled_axes;
  if (!header.whitening.empty()) {
    std::vector<BallVec> rows(rank);
    for (int i = 0; i < rank; ++i) {
      for (int j = 0; j < rank; ++j) rows[i][j] = dot(balls(header.whitening[i]), scaled_axes[j]);
    }
    rows = gram_schmidt(rows);
    // ξ_j = Σ_i R_ij y_i, so that the column of y_i is Σ_j R_ij times the one of ξ_j.
    for (int i = 0; i < rank; ++i) {
      columns[i] = BallVec();
      for (int j = 0; j < rank; ++j) {
        columns[i] = plus(columns[i], scaled(scaled_axes[j], rows[i][j]));
      }
    }
  }
  complete(columns, rank, size);
  for (int i = 0; i < 3; ++i) cofactors[i] = cross(columns[(i + 1) % 3], columns[(i + 2) % 3]);
  determinant = dot(columns[0], cofactors[0]);
  if (determinant.sign() == 0 || !determinant.is_finite()) {
    throw Malformed(1, "axes depend on each other, or a deviation is zero");
  }
  const Precision enough(192);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inverse[i][j] = (cofactors[i][j] / determinant).nearest();
    reach[i] = (sqrt(dot(cofactors[i], cofactors[i])) / abs(determinant)).outward(1);
  }
}

Vec Frame::normal_in_world(const Vec& n) const {
  Vec result{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result[j] += n[i] * inverse[i][j];
  }
  return result;
}

Vec Piece::farthest_swept(const Vec& normal) const {
  Vec point = turned_back(normal);
  const double size = length(point);
  for (double& x : point) x = size > 0 ? radius * (1 - 8 * kUnit) * x / size : 0;
  const BallVec exact = balls(point);
  const bool is_within = dot(exact, exact) <= Ball(radius) * Ball(radius);
  return is_within ? point : Vec{};
}

double Piece::size_of_rotation() const {
  if (radius == 0) return 0;
  const auto& [x, y, z] = *rotation;
  return std::hypot(length(x), length(y), length(z)) * (1 + 16 * kUnit);
}

BallVec Frame::to_world(const BallVec& v) const {
  BallVec result;
  for (int i = 0; i < 3; ++i) result = plus(result, scaled(columns[i], v[i]));
  return result;
}

void Object::add_vertex(const Part& part, const Vec& vertex) {
  BallVec world = balls(part.translation);
  const Precision all(ARF_PREC_EXACT);
  for (int i = 0; i < 3; ++i) world[i] = world[i] + dot(balls(part.rotation[i]), balls(vertex));
  if (object_ == 1) world = minus(world, frame_->mean);
  exact.push_back(world);
  const Precision enough(192);
  const BallVec from = minus(world, balls(origin_));
  Vec point;
  for (int i = 0; i < 3; ++i) {
    const Ball y = dot(frame_->cofactors[i], from) / frame_->determinant;
    point[i] = y.nearest();
    if (!std::isfinite(point[i])) throw Malformed(part.line, "vertices are too far away");
    const double size = std::abs(point[i]);
    bound[i] = std::max(bound[i], size);
    error[i] = std::max(error[i], (size * kUnit + y.radius() + DBL_MIN) * (1 + 1e-10));
  }
  points.push_back(point);
}

void Object::add_part(const Part& part, bool with_pieces) {
  const int first = static_cast<int>(points.size());
  for (const Vec& vertex : part.vertices) add_vertex(part, vertex);
  if (!with_pieces) return;
  if (!part.convex) {
    for (const Triangle& t : part.triangles) {
      const Triangle moved{first + t[0], first + t[1], first + t[2]};
      pieces.push_back({{moved.begin(), moved.end()}});
    }
    return;
  }
  Piece piece{std::vector<int>(part.vertices.size()), part.radius, &part.rotation};
  std::iota(piece.vertices.begin(), piece.vertices.end(), first);
  pieces.push_back(std::move(piece));
}

void Object::add_caps(const Part& part, const Caps& caps) {
  for (const Vec& vertex : caps.vertices) add_vertex(part, vertex);
  for (const Triangle& t : caps.triangles) pieces.push_back({{t.begin(), t.end()}});
}

Object Object::single(int vertex) const {
  Object result(*frame_, object_, origin_);
  result.exact = {exact[vertex]};
  result.points = {points[vertex]};
  result.error = error;
  result.bound = bound;
  result.pieces = {{{0}}};
  result.finish();
  return result;
}

void Object::finish() {
  if (pieces.empty()) return;
  std::vector<int> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  nodes.reserve(2 * pieces.size());
  build(order.data(), order.data() + order.size());
}

// A node of some pieces, halved along the axis along which their first vertices spread most.
int Object::build(int* first, int* last) {
  const int here = static_cast<int>(nodes.size());
  nodes.emplace_back();
  Node node{{DBL_MAX, DBL_MAX, DBL_MAX}, {-DBL_MAX, -DBL_MAX, -DBL_MAX}};
  Vec lo = node.lo, hi = node.hi;  // of first vertices
  for (const int* piece = first; piece != last; ++piece) {
    for (int i = 0; i < 3; ++i) {
      const double place = points[pieces[*piece].vertices[0]][i];
      lo[i] = std::min(lo[i], place);
      hi[i] = std::max(hi[i], place);
      const double around =
          pieces[*piece].radius * pieces[*piece].size_of_rotation() * frame_->reach[i];
      for (const int v : pieces[*piece].vertices) {
        const double lowest = points[v][i] - around, highest = points[v][i] + around;
        const double margin = 2 * error[i] + 8 * kUnit * (std::abs(points[v][i]) + around);
        node.lo[i] = std::min(node.lo[i], lowest - margin);
        node.hi[i] = std::max(node.hi[i], highest + margin);
      }
    }
  }
  if (last - first == 1) {
    node.piece = *first;
  } else {
    const Vec spread = minus(hi, lo);
    const auto axis = std::max_element(spread.begin(), spread.end()) - spread.begin();
    int* middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](int a, int b) {
      return points[pieces[a].vertices[0]][axis] < points[pieces[b].vertices[0]][axis];
    });
    node.left = build(first, middle);
    node.right = build(middle, last);
  }
  nodes[here] = node;
  return here;
}

}  // namespace verify
