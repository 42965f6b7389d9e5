// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh by its patches, in the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "pieces/mesh_patches.h"
#include "pieces/whitened_tree.h"

namespace fcl_prob::detail {

/// A patch K in the whitened frame: as a ConvexFan, of which the corners of K are the vertices.
struct WhitenedPatch {
  std::vector<Eigen::Vector3d> normals;          ///< unit
  const std::vector<std::pair<int, int>>& arcs;  ///< of the normals
  double loss;  ///< K is known but for so much along any normal; infinite: not well enough
};

enum class PatchUse { taken, left_out };

/// Pieces are the triangles of a mesh, by their indices, and behind them the patches of all its
/// parts. What touches a patch touches the solid that its part encloses.
class PatchedMesh {
 public:
  using Node = MeshPatches::Node;

  /// \param object  that `mesh` is of
  /// \param matrix  that of the whitening
  ///
  /// Keeps references to the first two.
  PatchedMesh(const WhitenedTree& mesh, const PartitionObject& object,
              const Eigen::Matrix3d& matrix, PatchUse use);

  int triangleCount() const { return static_cast<int>(mesh_.tree->triangles.size()); }
  int pieceCount() const { return triangleCount() + patchCount(); }
  int patchCount() const { return static_cast<int>(patches_.size()); }
  bool isPatch(int piece) const { return piece >= triangleCount(); }

  /// The triangles of all patches, counted.
  std::size_t trianglesOfPatches() const;

  /// Calls `function(vertex)` for all corners of a piece.
  template <typename Function>
  void visitCorners(int piece, const Function& function) const {
    if (isPatch(piece)) {
      const auto& [patch, part] = placeOf(piece);
      for (const int v : patch->vertices) function(parts_[part].first_vertex + v);
    } else {
      const Eigen::Vector3i& t = mesh_.tree->triangles[piece];
      for (int k = 0; k < 3; ++k) function(t[k]);
    }
  }

  /// Calls `function(triangle)` for all triangles of a patch.
  template <typename Function>
  void visitTriangles(int patch, const Function& function) const {
    const auto& [of, part] = placeOf(patch);
    for (const int t : of->triangles) function(parts_[part].first_triangle + t);
  }

  WhitenedPatch whitened(int patch) const;

  /// Those of the trees of all parts: roots, and nodes by index, children behind their parents. See
  /// MeshPatches::Node; not every part need have patches.
  const std::vector<int>& roots() const { return roots_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const NodeBox& box(int node) const { return boxes_[node]; }

  std::size_t partCount() const { return parts_.size(); }
  std::size_t partOfPatch(int patch) const { return placeOf(patch).part; }

  /// Whether the part counts as solid: touching a patch of it is then touching it.
  bool isSolid(std::size_t part) const { return parts_[part].is_solid; }

  /// Whether the solid that a part with patches encloses certainly does not meet a box, in the
  /// coordinates of the mesh's vertices.
  bool isOutside(std::size_t part, const NodeBox& box) const;

  /// With that of the patches, which other queries may use, too.
  std::size_t memory() const {
    return nodes_.capacity() * (sizeof(Node) + sizeof(NodeBox)) +
           patches_.capacity() * sizeof(Place) + memory_of_patches_;
  }

  /// Bounds for a mesh of so many triangles.
  static std::size_t mostPieces(std::size_t triangles) { return triangles + triangles / 2; }
  static std::size_t mostNodes(std::size_t triangles) { return 2 * triangles; }

 private:
  struct Place {
    const MeshPatch* patch;
    std::size_t part;
  };

  struct PlacedPatches {
    const MeshPatches* patches;  ///< null: none
    bool is_solid;
    int root;
    int first_vertex;
    int first_triangle;
    Eigen::Matrix3d linear;   ///< from the part's frame to the whitened one
    Eigen::Matrix3d inverse;  ///< the other way
  };

  const Place& placeOf(int patch) const { return patches_[patch - triangleCount()]; }
  void addPart(const PieceTree::Part& part, const PlacedPart& placed,
               const Eigen::Matrix3d& matrix, PatchUse use);
  void countMemory();
  int copyNodes(int node);
  void fitBoxes(int root);

  const WhitenedTree& mesh_;
  std::vector<PlacedPatches> parts_;
  std::vector<Place> patches_;
  std::vector<int> roots_;
  std::vector<Node> nodes_;
  std::vector<NodeBox> boxes_;
  std::size_t memory_of_patches_ = 0;
};

}  // namespace fcl_prob::detail
