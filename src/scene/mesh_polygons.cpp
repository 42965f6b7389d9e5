// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/mesh_polygons.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "base/left_out.h"
#include "geometry/surface_caps.h"
#include "scene/coplanar_triangles.h"

namespace fcl_prob::detail {
namespace {

/// Halves of what has middles, down to what has a piece.
class PolygonTreeBuilder {
 public:
  PolygonTreeBuilder(const TriangleMesh& mesh, MeshPolygons& into)
      : mesh_(mesh), first_polygon_(static_cast<int>(mesh.triangles.size())), into_(into) {}

  void run() {
    const int count = first_polygon_ + static_cast<int>(into_.polygons.size());
    std::vector<bool> held(static_cast<std::size_t>(count), false);
    for (const FlatPolygon& polygon : into_.polygons) {
      for (const int t : polygon.triangles) held[t] = true;
    }
    std::vector<Item> items;
    for (int piece = count; piece-- > 0;) {
      if (!held[piece]) items.push_back({middleOf(piece), piece});
    }
    into_.nodes.reserve(2 * mesh_.triangles.size());
    add(items.data(), items.data() + items.size());
  }

 private:
  struct Item {
    Eigen::Vector3d middle;
    int piece;
  };

  const std::vector<int>& trianglesOf(int polygon) const {
    return into_.polygons[polygon - first_polygon_].triangles;
  }

  void extend(Eigen::AlignedBox3d& box, int triangle) const {
    for (int k = 0; k < 3; ++k) box.extend(mesh_.vertices[mesh_.triangles[triangle][k]]);
  }

  Eigen::Vector3d middleOf(int piece) const {
    Eigen::AlignedBox3d box;
    if (piece < first_polygon_) {
      extend(box, piece);
    } else {
      for (const int t : trianglesOf(piece)) extend(box, t);
    }
    return box.center();
  }

  int add(Item* first, Item* last) {
    const auto index = static_cast<int>(into_.nodes.size());
    into_.nodes.emplace_back();
    if (last - first > 1) {
      addChildren(index, first, last);
      return index;
    }
    into_.nodes[index].piece = first->piece;
    if (first->piece < first_polygon_) return index;
    std::vector<Item> below;
    below.reserve(trianglesOf(first->piece).size());
    for (const int t : trianglesOf(first->piece)) below.push_back({middleOf(t), t});
    addChildren(index, below.data(), below.data() + below.size());
    return index;
  }

  void addChildren(int index, Item* first, Item* last) {
    Eigen::AlignedBox3d box;
    for (const Item* item = first; item != last; ++item) box.extend(item->middle);
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    Item* const middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [axis](const Item& x, const Item& y) {
      return std::pair(x.middle[axis], x.piece) < std::pair(y.middle[axis], y.piece);
    });
    const int left = add(first, middle);
    const int right = add(middle, last);
    into_.nodes[index].left = left;
    into_.nodes[index].right = right;
  }

  const TriangleMesh& mesh_;
  const int first_polygon_;
  MeshPolygons& into_;
};

std::unique_ptr<const MeshPolygons> polygonsIn(const TriangleMesh& mesh) {
  auto made = std::make_unique<MeshPolygons>();
  made->polygons = flatPolygonsIn(mesh, weldVertices(viewOf(mesh)));
  if (made->polygons.empty()) return nullptr;
  PolygonTreeBuilder(mesh, *made).run();
  return made;
}

}  // namespace

std::size_t MeshPolygons::memory() const {
  std::size_t bytes = nodes.capacity() * sizeof(Node);
  for (const FlatPolygon& polygon : polygons) {
    bytes += sizeof(FlatPolygon) +
             (polygon.triangles.capacity() + polygon.corners.capacity()) * sizeof(int);
  }
  return bytes;
}

const MeshPolygons* PolygonsOfMesh::of(const std::function<TriangleMesh()>& mesh) const {
  if (isLeftOut("polygons")) return nullptr;
  std::call_once(once_, [&] { made_ = polygonsIn(mesh()); });
  return made_.get();
}

}  // namespace fcl_prob::detail
