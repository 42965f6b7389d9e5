// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "gaussian/directed_edges.h"

#include <algorithm>
#include <tuple>

namespace fcl_prob::detail {
namespace {

std::tuple<int, int, int, int> sortKey(const DirectedEdge& edge) {
  const auto [low, high] = std::minmax(edge.from, edge.to);
  return {low, high, edge.from, edge.polygon};
}

bool sameUndirected(const DirectedEdge& a, const DirectedEdge& b) {
  return std::minmax(a.from, a.to) == std::minmax(b.from, b.to);
}

std::string describe(const DirectedEdge& edge, std::size_t count) {
  std::string what = count == 2   ? "is walked twice in the same direction"
                     : count == 1 ? "belongs to one face only"
                                  : "belongs to " + std::to_string(count) + " faces";
  return "the edge between vertices " + std::to_string(edge.from) + " and " +
         std::to_string(edge.to) + " (face " + std::to_string(edge.polygon) + ") " + what;
}

}  // namespace

EdgePairing pairEdges(std::vector<DirectedEdge> edges) {
  std::sort(edges.begin(), edges.end(),
            [](const DirectedEdge& a, const DirectedEdge& b) { return sortKey(a) < sortKey(b); });
  EdgePairing result;
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && sameUndirected(edges[first], edges[last])) ++last;
    if (last - first != 2 || edges[first].from == edges[first + 1].from) {
      result.fault = describe(edges[first], last - first);
      return result;
    }
    result.matches.push_back({edges[first], edges[first + 1]});
    first = last;
  }
  return result;
}

}  // namespace fcl_prob::detail
