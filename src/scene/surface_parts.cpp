// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene/surface_parts.h"

namespace fcl_prob::detail {

namespace {

NodeBox vertexBox(const WhitenedTree& whitened, int vertex) {
  const Eigen::Vector3d& v = whitened.vertices[vertex];
  return paddedBox(v, v, whitened.error);
}

class PartCollector {
 public:
  PartCollector(const PartitionObject& object, const WhitenedTree& whitened)
      : object_(object), whitened_(whitened) {}

  std::vector<SurfacePart> run() {
    for (std::size_t i = 0; i < object_.parts.size(); ++i) {
      const PieceTree::Part& part = object_.tree->parts[i];
      if (object_.parts[i].solid) {
        addSurfaces(i, part, object_.parts[i].solid->partOfVertex());
      } else {
        addPieces(i, part);
      }
    }
    return std::move(found_);
  }

 private:
  void addSurfaces(std::size_t i, const PieceTree::Part& part, const std::vector<int>& part_of) {
    std::vector<int> index(part_of.size(), -1);
    for (std::size_t v = 0; v < part_of.size(); ++v) {
      if (part_of[v] < 0) continue;
      const int vertex = PieceTree::vertexOf(part, v);
      const NodeBox box = vertexBox(whitened_, vertex);
      int& known = index[part_of[v]];
      if (known < 0) {
        known = static_cast<int>(found_.size());
        found_.push_back({i, object_.tree->vertices[vertex], box});
      } else {
        found_[known].box = boxOfBoth(found_[known].box, box);
      }
    }
  }

  // Triangles that bound no solid are parts by themselves, as convex pieces are.
  void addPieces(std::size_t i, const PieceTree::Part& part) {
    const PieceTree& tree = *object_.tree;
    if (part.vertices.begin < part.vertices.end) {
      for (const Eigen::Vector3i& t : tree.triangles) {
        if (t[0] < part.vertices.begin || t[0] >= part.vertices.end) continue;
        NodeBox box = vertexBox(whitened_, t[0]);
        for (int corner = 1; corner < 3; ++corner)
          box = boxOfBoth(box, vertexBox(whitened_, t[corner]));
        found_.push_back({i, tree.vertices[t[0]], box});
      }
    }
    for (int j = part.bodies.begin; j < part.bodies.end; ++j) {
      const PieceTree::Body& body = tree.bodies[j];
      const Eigen::Vector3d& point = tree.shapes[body.shape].body.points.front();
      found_.push_back({i, body.position + point, bodyBox(whitened_, j)});
    }
  }

  const PartitionObject& object_;
  const WhitenedTree& whitened_;
  std::vector<SurfacePart> found_;
};

}  // namespace

std::vector<SurfacePart> surfaceParts(const PartitionObject& object, const WhitenedTree& whitened) {
  return PartCollector(object, whitened).run();
}

}  // namespace fcl_prob::detail
