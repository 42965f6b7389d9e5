// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A mesh by its polygons, in the whitened frame of one query.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/mesh_polygons.h"
#include "scene/whitened_tree.h"

namespace fcl_prob::detail {

/// Pieces are the triangles of a mesh, by their indices, and behind them the polygons of all its
/// parts. A polygon is the hull of its corners, put into a plane across its normal.
class WhitenedPolygons {
 public:
  using Node = MeshPolygons::Node;

  /// How far polygons may move planes where nothing else is asked for, standard deviations.
  static constexpr double kMostLoss = 1e-4;

  /// \param object     that `mesh` is of
  /// \param matrix     that of the whitening
  /// \param most_loss  polygons that move planes by more are not used
  ///
  /// Keeps a reference to the mesh.
  WhitenedPolygons(const WhitenedTree& mesh, const PartitionObject& object,
                   const Eigen::Matrix3d& matrix, double most_loss = kMostLoss);

  int triangleCount() const { return static_cast<int>(mesh_.tree->triangles.size()); }
  int pieceCount() const { return triangleCount() + static_cast<int>(places_.size()); }
  bool isTriangle(int piece) const { return piece < triangleCount(); }

  /// The number of all polygons, and of their triangles.
  struct Held {
    std::size_t polygons = 0;
    std::size_t triangles = 0;
  };
  Held held() const;

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
    for (const int v : place.polygon->corners) function(first + v);
  }

  /// Calls `function(triangle)` for all triangles of a polygon.
  template <typename Function>
  void visitTriangles(int polygon, const Function& function) const {
    const Place& place = placeOf(polygon);
    const int first = parts_[place.part].first_triangle;
    for (const int each : place.polygon->triangles) function(first + each);
  }

  /// The hull of a piece's corners holds its triangles but for so much; of a polygon, they are also
  /// nowhere farther from it.
  double offOf(int piece) const { return isTriangle(piece) ? 0.0 : placeOf(piece).off; }

  double mostLoss() const { return most_loss_; }

  /// Of a polygon, unit.
  const Eigen::Vector3d& normalOf(int polygon) const { return placeOf(polygon).normal; }

  /// Those of the trees of all parts: roots, and nodes by index, children behind their parents. See
  /// MeshPolygons::Node; not every part need have polygons.
  const std::vector<int>& roots() const { return roots_; }
  const std::vector<Node>& nodes() const { return nodes_; }
  const NodeBox& box(int node) const { return boxes_[node]; }

  /// With that of the polygons, which other queries may use, too.
  std::size_t memory() const {
    return nodes_.capacity() * (sizeof(Node) + sizeof(NodeBox)) +
           places_.capacity() * sizeof(Place) + memory_of_polygons_;
  }

  /// Bounds for a mesh of so many triangles.
  static std::size_t mostPieces(std::size_t triangles) { return 2 * triangles; }
  static std::size_t mostNodes(std::size_t triangles) { return 2 * triangles; }

 private:
  struct Place {
    const FlatPolygon* polygon;
    std::size_t part;
    double off;
    Eigen::Vector3d normal;
  };

  struct PlacedPolygons {
    const MeshPolygons* polygons;  ///< null: none
    int first_vertex;
    int first_triangle;
    int triangles;           ///< of the part
    int first_place;         ///< a piece: its first polygon
    Eigen::Matrix3d linear;  ///< from the part's frame to the whitened one

    /// By its index in the part.
    int pieceOf(int index) const {
      return index < triangles ? first_triangle + index : first_place + index - triangles;
    }
  };

  const Place& placeOf(int piece) const { return places_[piece - triangleCount()]; }
  void addPart(const PieceTree::Part& part, const PlacedPart& placed,
               const Eigen::Matrix3d& matrix);
  void addPlaces(const MeshPolygons& polygons);
  double offOf(const FlatPolygon& polygon, const PlacedPolygons& part,
               const Eigen::Vector3d& n) const;
  void countMemory();
  int copyNodes(int node);
  void fitBoxes(int root);

  const WhitenedTree& mesh_;
  const double most_loss_;
  std::vector<PlacedPolygons> parts_;
  std::vector<Place> places_;
  std::vector<int> roots_;
  std::vector<Node> nodes_;
  std::vector<NodeBox> boxes_;
  std::size_t memory_of_polygons_ = 0;
};

}  // namespace fcl_prob::detail
