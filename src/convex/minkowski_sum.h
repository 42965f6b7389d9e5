// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The Minkowski sum of two convex polytopes by merging their faces.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/interruption.h"
#include "convex/convex_mesh.h"
#include "convex/face_set.h"

namespace fcl_prob::detail {

/// Computes P ⊕ Q. Every face of the sum is a face of one polytope added to a vertex of the other,
/// or the parallelogram of an edge of each whose arcs cross on the Gauss sphere; both are found
/// from the heights of all vertices of one along all face normals of the other. Time O(n_P n_Q)
/// with a small constant, memory that is kept between calls. Triangles give the 11 pairs of planes
/// of their separating-axis test: two face normals and nine cross products of edges.
///
/// Ties are decided as if Q were rotated a little (see perturbation()); coplanar facets are left
/// unmerged.
class MinkowskiSum {
 public:
  /// Writes the facets of the sum. Returns how far the sum may reach out of them because of ties
  /// (beyond rounding; nearly always 0), or nothing if rounding spoilt the surface or the
  /// interruption is due (`sum` is then unusable): it is checked to be closed, and a closed surface
  /// of facets of the sum is its whole boundary.
  std::optional<double> compute(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum,
                                const Interruption& interruption = {});

  /// Of the sum computed last: the vertices of P and Q that each of its vertices is the sum of.
  std::vector<std::array<int, 2>> vertexPairs(const FaceSet& sum) const;

 private:
  /// How the vertices of one polytope lie along the face normals of the other.
  struct Heights {
    /// Vectors coordinate by coordinate and their products with a direction: plain arrays, so that
    /// the loops over them become vector instructions.
    struct Projections {
      std::vector<double> x, y, z;
      std::vector<double> along;

      void clear();
      void add(const Eigen::Vector3d& vector);
      void project(const Eigen::Vector3d& direction);
    };

    Projections edges;  // as vectors
    Projections vertices;
    std::vector<double> squared_tie;        // what is a tie for each edge
    std::vector<int> from, to;              // of each edge
    std::vector<std::int8_t> sign_of_edge;  // face-major: +1 if the edge climbs
    std::vector<int> highest;               // vertex, per face

    /// Normals are turned by turn × normal. Returns by how much the turn has made a wrong order;
    /// nothing if there is a tie or an interruption.
    std::optional<double> compute(const ConvexMesh& faces_of, const ConvexMesh& vertices_of,
                                  const Eigen::Vector3d& turn, const Interruption& interruption);

    void setTo(const ConvexMesh& mesh);

    /// Whether an edge is as good as level in the direction that the edges are projected on.
    bool haveTie() const;
    void writeSigns(std::int8_t* signs) const;

    /// The vertex from which no edge climbs.
    int highestVertex(const Eigen::Vector3d& direction, const std::int8_t* signs);
    bool climbsFrom(int vertex, const std::int8_t* signs) const;
  };

  std::optional<double> computePerturbed(const ConvexMesh& p, const ConvexMesh& q, int attempt,
                                         FaceSet& sum, const Interruption& interruption);
  void addTranslatedFaces(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum);
  /// \return false if the interruption is due
  bool addParallelograms(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum,
                         const Interruption& interruption);
  void addParallelogram(const ConvexMesh::Edge& edge_p, const ConvexMesh::Edge& edge_q, bool along,
                        FaceSet& sum);
  void addVertices(const ConvexMesh& p, const ConvexMesh& q, FaceSet& sum);
  int vertex(int i, int j, FaceSet& sum);

  const ConvexMesh* p_ = nullptr;
  const ConvexMesh* q_ = nullptr;
  Heights heights_of_q_;                // along the normals of P
  Heights heights_of_p_;                // along the normals of Q
  std::vector<int> vertex_index_;       // of the sum, for a pair of vertices
  std::vector<unsigned> vertex_stamp_;  // vertex_index_ is valid where this is stamp_
  unsigned stamp_ = 0;
};

}  // namespace fcl_prob::detail
