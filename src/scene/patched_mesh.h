// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh by its polygons and patches, in the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "scene/mesh_patches.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// A patch K in the whitened frame: as a ConvexFan, of which the corners of K are the vertices.
struct WhitenedPatch {
  std::vector<Eigen::Vector3d> normals;          ///< unit
  const std::vector<std::pair<int, int>>& arcs;  ///< of the normals
  double loss;  ///< K is known but for so much along any normal; infinite: not well enough
};

/// Which polygons and patches are used.
struct PatchUse {
  bool taken = true;  ///< false: none
  /// Polygons that move planes by no more than so many standard deviations.
  double most_loss = 1e-4;
};

/// Pieces are the triangles of a mesh, by their indices, and behind them the polygons and patches
/// of all its parts. What touches a patch touches the solid that its part encloses. A polygon is
/// the hull of its corners, put into a plane across its normal.
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
  int pieceCount() const { return triangleCount() + static_cast<int>(places_.size()); }
  bool isTriangle(int piece) const { return piece < triangleCount(); }
  bool isPatch(int piece) const { return !isTriangle(piece) && placeOf(piece).patch; }

  /// Of all patches, or of all polygons: their number, and that of their triangles.
  struct Held {
    std::size_t pieces;
    std::size_t triangles;
  };
  Held heldByPatches() const;
  Held heldByPolygons() const;

  /// Calls `function(vertex)` for all corners of a piece.
  template <typename Function>
  void visitCorners(int piece, const Function& function) const {
    if (isTriangle(piece)) {
      const Eigen::Vector3i& t = mesh_.tree->triangles[piece];
      for (int k = 0; k < 3; ++k) function(t[k]);
      return;
    }
    const Place& place = placeOf(piece);
    const int first = parts_[place.part].first_vertex;
    for (const int v : place.patch ? place.patch->vertices : place.polygon->corners) {
      function(first + v);
    }
  }

  /// Calls `function(piece)` for all triangles of a polygon, or all pieces of a patch.
  template <typename Function>
  void visitPieces(int piece, const Function& function) const {
    const Place& place = placeOf(piece);
    const PlacedPatches& part = parts_[place.part];
    for (const int each : place.patch ? place.patch->pieces : place.polygon->triangles) {
      function(part.pieceOf(each));
    }
  }

  /// The hull of a piece's corners holds its triangles but for so much; of a polygon, they are also
  /// nowhere farther from it.
  double offOf(int piece) const { return isTriangle(piece) ? 0.0 : placeOf(piece).off; }

  double mostLoss() const { return use_.most_loss; }

  /// Of a polygon, unit.
  const Eigen::Vector3d& normalOf(int polygon) const { return placeOf(polygon).normal; }

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
           places_.capacity() * sizeof(Place) + memory_of_patches_;
  }

  /// Bounds for a mesh of so many triangles.
  static std::size_t mostPieces(std::size_t triangles) { return 2 * triangles; }
  static std::size_t mostNodes(std::size_t triangles) { return 2 * triangles; }

 private:
  /// One of the two.
  struct Place {
    const MeshPatch* patch;
    const FlatPolygon* polygon;
    std::size_t part;
    double off = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  };

  struct PlacedPatches {
    const MeshPatches* patches;  ///< null: none
    bool is_solid;
    int root;
    int first_vertex;
    int first_triangle;
    int triangles;            ///< of the part
    int first_place;          ///< a piece: its first polygon or patch
    Eigen::Matrix3d linear;   ///< from the part's frame to the whitened one
    Eigen::Matrix3d inverse;  ///< the other way

    /// By its index in the part.
    int pieceOf(int index) const {
      return index < triangles ? first_triangle + index : first_place + index - triangles;
    }
  };

  const Place& placeOf(int piece) const { return places_[piece - triangleCount()]; }
  void addPart(const PieceTree::Part& part, const PlacedPart& placed,
               const Eigen::Matrix3d& matrix);
  void addPlaces(const MeshPatches& patches);
  double offOf(const FlatPolygon& polygon, const PlacedPatches& part,
               const Eigen::Vector3d& n) const;
  void countMemory();
  int copyNodes(int node);
  void fitBoxes(int root);

  const WhitenedTree& mesh_;
  const PatchUse use_;
  std::vector<PlacedPatches> parts_;
  std::vector<Place> places_;
  std::vector<int> roots_;
  std::vector<Node> nodes_;
  std::vector<NodeBox> boxes_;
  std::size_t memory_of_patches_ = 0;
};

}  // namespace fcl_prob::detail
