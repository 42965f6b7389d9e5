// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "pieces/mesh_patches.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

#include "fcl_prob/exceptions.h"
#include "gaussian/directed_edges.h"
#include "geometry/surface_caps.h"
#include "pieces/mesh_reach.h"

namespace fcl_prob::detail {
namespace {

// Triangles of a patch. Beside an arm of 2,000 triangles 16 and 64 took the same time, 16 being
// found sooner.
constexpr std::size_t kMostOfPatch = 16;

// A patch is convex if none of its corners is farther beyond one of its planes, as a share of the
// size of the mesh.
constexpr double kConvexPatch = 1e-12;

// Of K nothing is known within this share of it, at the most.
constexpr double kDeepest = 1e-7;

class MeshPatchSearch {
 public:
  MeshPatchSearch(const TriangleMesh& mesh, const MeshView& view)
      : mesh_(mesh), welded_(weldVertices(view)), surrounding_(view, mesh.vertices, {0, 0, 0}) {
    for (const Eigen::Vector3d& v : mesh.vertices) size_ = std::max(size_, v.norm());
    for (int t = 0; t < count(); ++t) {
      normals_.emplace_back((corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)));
      areas_.push_back(normals_.back().norm());
      if (areas_.back() > 0.0) normals_.back() /= areas_.back();
    }
    findNeighbours();
  }

  /// Large triangles first: around them patches are largest.
  std::vector<MeshPatch> run() {
    std::vector<int> order(mesh_.triangles.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](int x, int y) {
      return areas_[x] != areas_[y] ? areas_[x] > areas_[y] : x < y;
    });
    held_.assign(mesh_.triangles.size(), false);
    std::vector<MeshPatch> patches;
    for (const int t : order) {
      if (held_[t] || !(areas_[t] > 0.0)) continue;
      MeshPatch patch = largestOf(around(t));
      for (const int each : patch.triangles) held_[each] = true;
      if (!patch.triangles.empty()) patches.push_back(std::move(patch));
    }
    return patches;
  }

  const ClosedMesh& solid() const { return surrounding_.solid(); }

 private:
  int count() const { return static_cast<int>(mesh_.triangles.size()); }
  int vertex(int t, int k) const { return welded_[mesh_.triangles[t][k]]; }
  const Eigen::Vector3d& corner(int t, int k) const { return mesh_.vertices[vertex(t, k)]; }

  // Of triangles with three different corners, as the mesh is closed.
  void findNeighbours() {
    std::vector<DirectedEdge> edges;
    for (int t = 0; t < count(); ++t) {
      if (!(areas_[t] > 0.0) && hasEqualCorners(t)) continue;
      for (int k = 0; k < 3; ++k) edges.push_back({vertex(t, k), vertex(t, (k + 1) % 3), t});
    }
    neighbours_.resize(mesh_.triangles.size());
    for (const EdgeMatch& match : pairEdges(std::move(edges)).matches) {
      neighbours_[match.forward.polygon].push_back(match.backward.polygon);
      neighbours_[match.backward.polygon].push_back(match.forward.polygon);
    }
  }

  bool hasEqualCorners(int t) const {
    return vertex(t, 0) == vertex(t, 1) || vertex(t, 1) == vertex(t, 2) ||
           vertex(t, 2) == vertex(t, 0);
  }

  bool isBehind(int t, int plane) const {
    const Eigen::Vector3d& n = normals_[plane];
    const double level = n.dot(corner(plane, 0)) + kConvexPatch * size_;
    return n.dot(corner(t, 0)) <= level && n.dot(corner(t, 1)) <= level &&
           n.dot(corner(t, 2)) <= level;
  }

  // By rings, as long as all of it is on its hull (Ehmann and Lin 2001).
  std::vector<int> around(int seed) const {
    std::vector<int> patch{seed};
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const int next : neighbours_[patch[i]]) {
        if (patch.size() == kMostOfPatch) return patch;
        if (held_[next] || !(areas_[next] > 0.0)) continue;
        if (std::find(patch.begin(), patch.end(), next) != patch.end()) continue;
        const auto fits = [&](int t) { return isBehind(t, next) && isBehind(next, t); };
        if (std::all_of(patch.begin(), patch.end(), fits)) patch.push_back(next);
      }
    }
    return patch;
  }

  // Of the first of the triangles: all of them, or as many as halving the difference finds to have
  // a hull within the mesh. Empty if there are not even two.
  MeshPatch largestOf(const std::vector<int>& triangles) const {
    MeshPatch best;
    std::size_t most = triangles.size() + 1;
    std::size_t tried = triangles.size();
    while (tried > std::max<std::size_t>(1, best.triangles.size())) {
      MeshPatch patch = patchOf({triangles.begin(), triangles.begin() + tried});
      if (patch.triangles.empty()) {
        most = tried;
      } else {
        best = std::move(patch);
      }
      tried = (std::max<std::size_t>(1, best.triangles.size()) + most) / 2;
    }
    return best;
  }

  MeshPatch patchOf(std::vector<int> triangles) const {
    MeshPatch patch;
    for (const int t : triangles) {
      for (int k = 0; k < 3; ++k) patch.vertices.push_back(vertex(t, k));
    }
    std::sort(patch.vertices.begin(), patch.vertices.end());
    patch.vertices.erase(std::unique(patch.vertices.begin(), patch.vertices.end()),
                         patch.vertices.end());
    std::vector<Eigen::Vector3d> points;
    for (const int v : patch.vertices) points.push_back(mesh_.vertices[v]);
    const auto fan = convexFanAround(points);
    if (!fan) return {};
    patch.fan = *fan;
    if (!surrounding_.surrounds(patch.fan, {})) return {};
    for (std::size_t f = 0; f < fan->normals.size(); ++f) {
      if (!(patch.fan.depths[f] < kDeepest * patch.fan.offsets[f])) return {};
    }
    patch.fan.vertices = {};
    patch.triangles = std::move(triangles);
    return patch;
  }

  const TriangleMesh& mesh_;
  std::vector<int> welded_;
  SurroundingMesh surrounding_;
  double size_ = 0.0;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<double> areas_;  // doubled
  std::vector<std::vector<int>> neighbours_;
  std::vector<bool> held_;
};

/// Halves of what has middles, down to what has a piece.
class PatchTreeBuilder {
 public:
  PatchTreeBuilder(const TriangleMesh& mesh, MeshPatches& into) : mesh_(mesh), into_(into) {}

  void run() {
    const auto triangles = static_cast<int>(mesh_.triangles.size());
    std::vector<bool> held(mesh_.triangles.size(), false);
    std::vector<Item> items;
    for (std::size_t i = 0; i < into_.patches.size(); ++i) {
      for (const int t : into_.patches[i].triangles) held[t] = true;
      items.push_back({middleOf(into_.patches[i].triangles), triangles + static_cast<int>(i)});
    }
    for (int t = 0; t < triangles; ++t) {
      if (!held[t]) items.push_back({middleOf({t}), t});
    }
    into_.nodes.reserve(2 * mesh_.triangles.size());
    add(items.data(), items.data() + items.size());
  }

 private:
  struct Item {
    Eigen::Vector3d middle;
    int piece;
  };

  Eigen::Vector3d middleOf(const std::vector<int>& triangles) const {
    Eigen::AlignedBox3d box;
    for (const int t : triangles) {
      for (int k = 0; k < 3; ++k) box.extend(mesh_.vertices[mesh_.triangles[t][k]]);
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
    const int patch = first->piece - static_cast<int>(mesh_.triangles.size());
    if (patch < 0) return index;
    std::vector<Item> below;
    for (const int t : into_.patches[patch].triangles) below.push_back({middleOf({t}), t});
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
  MeshPatches& into_;
};

std::unique_ptr<const MeshPatches> patchesIn(const TriangleMesh& mesh) try {
  MeshPatchSearch search(mesh, viewOf(mesh));
  std::vector<MeshPatch> patches = search.run();
  if (patches.empty()) return nullptr;
  auto made = std::make_unique<MeshPatches>(MeshPatches{std::move(patches), {}, search.solid()});
  PatchTreeBuilder(mesh, *made).run();
  return made;
} catch (const OpenMesh&) {
  return nullptr;
}

}  // namespace

std::size_t MeshPatches::memory() const {
  std::size_t bytes = nodes.capacity() * sizeof(Node) + solid.memory();
  for (const MeshPatch& patch : patches) {
    bytes += sizeof(MeshPatch) +
             (patch.triangles.capacity() + patch.vertices.capacity()) * sizeof(int) +
             patch.fan.normals.size() * (sizeof(Eigen::Vector3d) + 2 * sizeof(double)) +
             patch.fan.arcs.size() * 2 * sizeof(int);
  }
  return bytes;
}

const MeshPatches* PatchesOfMesh::of(const std::function<TriangleMesh()>& mesh) const {
  std::call_once(once_, [&] { made_ = patchesIn(mesh()); });
  return made_.get();
}

}  // namespace fcl_prob::detail
