// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Matching the edges of polygons, to see whether they close a surface.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace fcl_prob::detail {

/// One side of a polygon, walked from one vertex to another.
struct DirectedEdge {
  int from;
  int to;
  int polygon;
};

/// Adds the sides of a polygon, walked in the order of its vertices.
template <typename Vertices>
void addSides(const Vertices& vertices, int polygon, std::vector<DirectedEdge>& edges) {
  for (auto from = vertices.begin(); from != vertices.end(); ++from) {
    const auto to = from + 1 == vertices.end() ? vertices.begin() : from + 1;
    edges.push_back({*from, *to, polygon});
  }
}

/// Two sides that lie on each other in opposite directions.
struct EdgeMatch {
  DirectedEdge forward;
  DirectedEdge backward;
};

/// The result of pairing all sides: either every edge is shared by exactly two polygons that walk
/// it in opposite directions, or `fault` says which one is not.
struct EdgePairing {
  std::vector<EdgeMatch> matches;
  std::optional<std::string> fault;
};

EdgePairing pairEdges(std::vector<DirectedEdge> edges);

}  // namespace fcl_prob::detail
