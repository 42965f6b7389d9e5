// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/surface_caps.h"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <functional>
#include <numeric>

#include "base/edge_order.h"

namespace fcl_prob::detail {
namespace {

/// Starts with every index below the constructor's argument in a set of its own; `union_set` joins
/// two, `find_set` names the one that an index is in.
using DisjointSets = boost::disjoint_sets_with_storage<>;

using Edge = std::pair<int, int>;

/// The edges, as pairs of welded vertices in ascending order, that an odd number of triangles has.
std::vector<Edge> oddEdges(const MeshView& mesh, const std::vector<int>& welded) {
  std::vector<Edge> edges;
  edges.reserve(3 * static_cast<std::size_t>(mesh.triangle_count));
  for (int t = 0; t < mesh.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int i = welded[mesh.triangles[t][k]];
      const int j = welded[mesh.triangles[t][(k + 1) % 3]];
      if (i != j) edges.emplace_back(std::min(i, j), std::max(i, j));
    }
  }
  const auto rank = [](const Edge& edge) { return edgeRank(edge.first, edge.second); };
  sortEdges(edges, rank, std::less<Edge>());
  std::vector<Edge> odd;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last =
        std::find_if(first, edges.end(), [&](const Edge& edge) { return edge != *first; });
    if ((last - first) % 2 == 1) odd.push_back(*first);
    first = last;
  }
  return odd;
}

}  // namespace

std::vector<int> weldVertices(const MeshView& mesh) {
  std::vector<int> order(mesh.vertex_count);
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&mesh](int a, int b) {
    const auto& p = mesh.vertices[a];
    const auto& q = mesh.vertices[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::stable_sort(order.begin(), order.end(), less);
  std::vector<int> welded(mesh.vertex_count);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && mesh.vertices[order[i]] == mesh.vertices[order[i - 1]];
    welded[order[i]] = same ? welded[order[i - 1]] : order[i];
  }
  return welded;
}

SurfaceComponents componentsOf(const MeshView& mesh, const std::vector<int>& welded) {
  DisjointSets sets(mesh.vertex_count);
  for (int t = 0; t < mesh.triangle_count; ++t) {
    for (int k = 1; k < 3; ++k) {
      sets.union_set(welded[mesh.triangles[t][0]], welded[mesh.triangles[t][k]]);
    }
  }
  SurfaceComponents result;
  result.of_vertex.assign(mesh.vertex_count, -1);
  std::vector<int> label(mesh.vertex_count, -1);
  for (int t = 0; t < mesh.triangle_count; ++t) {
    for (int k = 0; k < 3; ++k) {
      const int vertex = static_cast<int>(mesh.triangles[t][k]);
      int& component = label[sets.find_set(welded[vertex])];
      if (component < 0) component = result.count++;
      result.of_vertex[vertex] = component;
    }
  }
  return result;
}

SurfaceCaps capsOf(const MeshView& mesh) {
  SurfaceCaps result;
  const std::vector<int> welded = weldVertices(mesh);
  result.components = componentsOf(mesh, welded);
  const std::vector<Edge> odd = oddEdges(mesh, welded);
  DisjointSets rims(mesh.vertex_count);
  for (const auto& [i, j] : odd) rims.union_set(i, j);
  std::vector<int> cap_of(mesh.vertex_count, -1);
  for (const auto& [i, j] : odd) {
    int& cap = cap_of[rims.find_set(i)];
    if (cap < 0) {
      cap = static_cast<int>(result.caps.size());
      result.caps.push_back({Eigen::Vector3d::Zero(), {}});
    }
    result.caps[cap].rim.emplace_back(i, j);
  }
  for (SurfaceCaps::Cap& cap : result.caps) {
    const double share = 0.5 / static_cast<double>(cap.rim.size());
    for (const auto& [i, j] : cap.rim) {
      cap.apex += share * mesh.vertices[i] + share * mesh.vertices[j];
    }
  }
  return result;
}

}  // namespace fcl_prob::detail
