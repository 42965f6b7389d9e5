// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "convex/minkowski_sum.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "convex/perturbation.h"

namespace fcl_prob::detail {
namespace {

/// An edge that climbs by less than this fraction of its length may as well descend.
constexpr double kTie = 4e-15;

}  // namespace

void MinkowskiSum::Heights::Projections::clear() {
  x.clear();
  y.clear();
  z.clear();
}

void MinkowskiSum::Heights::Projections::add(const Eigen::Vector3d& vector) {
  x.push_back(vector.x());
  y.push_back(vector.y());
  z.push_back(vector.z());
}

void MinkowskiSum::Heights::Projections::project(const Eigen::Vector3d& direction) {
  const double dx = direction.x(), dy = direction.y(), dz = direction.z();
  along.resize(x.size());
  for (std::size_t i = 0; i < along.size(); ++i) along[i] = dx * x[i] + dy * y[i] + dz * z[i];
}

void MinkowskiSum::Heights::setTo(const ConvexMesh& mesh) {
  edges.clear();
  vertices.clear();
  squared_tie.clear();
  from.clear();
  to.clear();
  for (const Eigen::Vector3d& vertex : mesh.vertices) vertices.add(vertex);
  for (const ConvexMesh::Edge& edge : mesh.edges) {
    const Eigen::Vector3d vector = mesh.vertices[edge.to] - mesh.vertices[edge.from];
    edges.add(vector);
    squared_tie.push_back(kTie * kTie * vector.squaredNorm());
    from.push_back(edge.from);
    to.push_back(edge.to);
  }
}

bool MinkowskiSum::Heights::haveTie() const {
  int ties = 0;
  for (std::size_t e = 0; e < squared_tie.size(); ++e) {
    ties += edges.along[e] * edges.along[e] <= squared_tie[e];
  }
  return ties > 0;
}

void MinkowskiSum::Heights::writeSigns(std::int8_t* signs) const {
  const double* const climb = edges.along.data();
  const std::size_t count = edges.along.size();
  for (std::size_t e = 0; e < count; ++e) {
    signs[e] = static_cast<std::int8_t>(2 * (climb[e] > 0.0) - 1);
  }
}

bool MinkowskiSum::Heights::climbsFrom(int vertex, const std::int8_t* signs) const {
  int climbing = 0;
  for (std::size_t e = 0; e < from.size(); ++e) {
    climbing += signs[e] > 0 ? from[e] == vertex : to[e] == vertex;
  }
  return climbing > 0;
}

// The farthest vertex, corrected by the signs of the edges where rounding hides differences of
// height.
int MinkowskiSum::Heights::highestVertex(const Eigen::Vector3d& direction,
                                         const std::int8_t* signs) {
  vertices.project(direction);
  const auto farthest = std::max_element(vertices.along.begin(), vertices.along.end());
  int highest = static_cast<int>(farthest - vertices.along.begin());
  for (std::size_t pass = 0; pass < from.size() && climbsFrom(highest, signs); ++pass) {
    for (std::size_t e = 0; e < from.size(); ++e) {
      if ((signs[e] > 0 ? from[e] : to[e]) == highest) highest = signs[e] > 0 ? to[e] : from[e];
    }
  }
  return highest;
}

std::optional<double> MinkowskiSum::Heights::compute(const ConvexMesh& faces_of,
                                                     const ConvexMesh& vertices_of,
                                                     const Eigen::Vector3d& turn,
                                                     const Interruption& interruption) {
  setTo(vertices_of);
  const std::size_t edge_count = vertices_of.edges.size();
  sign_of_edge.resize(faces_of.faces.size() * edge_count);
  highest.resize(faces_of.faces.size());
  double defect = 0.0;
  for (std::size_t f = 0; f < faces_of.faces.size(); ++f) {
    if (isDue(interruption)) return std::nullopt;
    const Eigen::Vector3d& n = faces_of.faces[f].normal;
    const Eigen::Vector3d direction = n + turn.cross(n);
    std::int8_t* signs = sign_of_edge.data() + f * edge_count;
    edges.project(direction);
    if (haveTie()) return std::nullopt;
    writeSigns(signs);
    highest[f] = highestVertex(direction, signs);
    if (turn.isZero(0.0)) continue;
    edges.project(n);
    for (std::size_t e = 0; e < edge_count; ++e) {
      const double climb = edges.along[e];
      if ((climb > 0.0) != (signs[e] > 0)) defect = std::max(defect, std::abs(climb));
    }
  }
  return defect;
}

std::optional<double> MinkowskiSum::compute(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum,
                                            const Interruption& interruption) {
  p_ = &p;
  q_ = &q;
  const std::size_t pairs = p.vertices.size() * q.vertices.size();
  if (vertex_index_.size() < pairs) {
    vertex_index_.resize(pairs);
    vertex_stamp_.resize(pairs, 0);
  }
  for (int attempt = 0; attempt < kPerturbationAttempts; ++attempt) {
    if (const auto defect = computePerturbed(p, q, attempt, sum, interruption)) return defect;
  }
  return std::nullopt;
}

std::optional<double> MinkowskiSum::computePerturbed(const ConvexMesh& p, const ConvexMesh& q,
                                                     int attempt, FaceSet& sum,
                                                     const Interruption& interruption) {
  sum.clear();
  if (++stamp_ == 0) {  // wrapped around: old stamps would look new
    std::fill(vertex_stamp_.begin(), vertex_stamp_.end(), 0u);
    stamp_ = 1;
  }
  const Eigen::Vector3d turn = perturbation(0, attempt);
  const auto defect_of_q = heights_of_q_.compute(p, q, -turn, interruption);
  if (!defect_of_q) return std::nullopt;
  const auto defect_of_p = heights_of_p_.compute(q, p, turn, interruption);
  if (!defect_of_p) return std::nullopt;
  // A chain of edges may be in the wrong order as a whole, so the defects of all of them count.
  const double defect = *defect_of_q * static_cast<double>(q.edges.size()) +
                        *defect_of_p * static_cast<double>(p.edges.size());
  addTranslatedFaces(p, q, sum);
  if (!addParallelograms(p, q, sum, interruption)) return std::nullopt;
  if (sum.faceCount() == 0) addVertices(p, q, sum);
  if (!sum.closed()) return std::nullopt;
  // Both the sum with Q turned and the surface, whose vertices are not moved, are within one
  // perturbation of the boundary.
  double size = 0.0;
  for (const Eigen::Vector3d& v : q.vertices) size = std::max(size, v.norm());
  return std::min(defect, 2.0 * kLargestPerturbation * size);
}

void MinkowskiSum::addTranslatedFaces(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum) {
  for (std::size_t f = 0; f < p.faces.size(); ++f) {
    sum.beginFace();
    for (int c = 0; c < p.faces[f].count; ++c) {
      sum.addCorner(vertex(p.corners[p.faces[f].first + c], heights_of_q_.highest[f], sum));
    }
  }
  for (std::size_t f = 0; f < q.faces.size(); ++f) {
    sum.beginFace();
    for (int c = 0; c < q.faces[f].count; ++c) {
      sum.addCorner(vertex(heights_of_p_.highest[f], q.corners[q.faces[f].first + c], sum));
    }
  }
}

// The parallelogram of the edges e_P, e_Q is a facet with outward normal m = e_P × e_Q if m is in
// the normal cones of both. For e_P with its left face of normal n that means m·(n × e_P) <= 0,
// which is
// -|e_P|² e_Q·n: so e_Q climbs along the left face's normal and descends along the right one's; for
// e_Q the other way round. With all four signs reversed it is a facet of normal -m.
bool MinkowskiSum::addParallelograms(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum,
                                     const Interruption& interruption) {
  const std::size_t edges_p = p.edges.size();
  const std::size_t edges_q = q.edges.size();
  for (std::size_t e = 0; e < edges_p; ++e) {
    if (isDue(interruption)) return false;
    const ConvexMesh::Edge& edge_p = p.edges[e];
    // A point has no edges, so the table of signs may be empty.
    const std::int8_t* signs = heights_of_q_.sign_of_edge.data();
    const std::int8_t* left = edge_p.left < 0 ? nullptr : signs + edge_p.left * edges_q;
    const std::int8_t* right = edge_p.left < 0 ? nullptr : signs + edge_p.right * edges_q;
    for (std::size_t k = 0; k < edges_q; ++k) {
      if (left && left[k] == right[k]) continue;
      const ConvexMesh::Edge& edge_q = q.edges[k];
      bool along = !left || left[k] > 0;
      bool against = !left || left[k] < 0;
      if (edge_q.left >= 0) {
        const std::int8_t on_left = heights_of_p_.sign_of_edge[edge_q.left * edges_p + e];
        const std::int8_t on_right = heights_of_p_.sign_of_edge[edge_q.right * edges_p + e];
        if (on_left == on_right) continue;
        along = along && on_left < 0;
        against = against && on_left > 0;
      }
      if (along) addParallelogram(edge_p, edge_q, true, sum);
      if (against) addParallelogram(edge_p, edge_q, false, sum);
    }
  }
  return true;
}

void MinkowskiSum::addParallelogram(const ConvexMesh::Edge& edge_p, const ConvexMesh::Edge& edge_q,
                                    bool along, FaceSet& sum) {
  const int start = vertex(edge_p.from, edge_q.from, sum);
  const int plus_p = vertex(edge_p.to, edge_q.from, sum);
  const int plus_both = vertex(edge_p.to, edge_q.to, sum);
  const int plus_q = vertex(edge_p.from, edge_q.to, sum);
  if (along) {
    sum.addFace({start, plus_p, plus_both, plus_q});
  } else {
    sum.addFace({start, plus_q, plus_both, plus_p});
  }
}

void MinkowskiSum::addVertices(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum) {
  for (std::size_t i = 0; i < p.vertices.size(); ++i) {
    for (std::size_t j = 0; j < q.vertices.size(); ++j) {
      vertex(static_cast<int>(i), static_cast<int>(j), sum);
    }
  }
}

int MinkowskiSum::vertex(int i, int j, FaceSet& sum) {
  const std::size_t key = static_cast<std::size_t>(i) * q_->vertices.size() + j;
  if (vertex_stamp_[key] != stamp_) {
    vertex_stamp_[key] = stamp_;
    vertex_index_[key] = sum.addVertex(p_->vertices[i] + q_->vertices[j]);
  }
  return vertex_index_[key];
}

std::vector<std::array<int, 2>> MinkowskiSum::vertexPairs(const FaceSet& sum) const {
  std::vector<std::array<int, 2>> pairs(sum.vertices().size());
  const std::size_t of_q = q_->vertices.size();
  for (std::size_t key = 0; key < p_->vertices.size() * of_q; ++key) {
    if (vertex_stamp_[key] != stamp_) continue;
    pairs[static_cast<std::size_t>(vertex_index_[key])] = {static_cast<int>(key / of_q),
                                                           static_cast<int>(key % of_q)};
  }
  return pairs;
}

}  // namespace fcl_prob::detail
