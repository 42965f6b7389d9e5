// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "geometry/directed_edges.h"

#include <tuple>

#include "base/edge_order.h"

namespace fcl_prob::detail {
namespace {

// An object, not a function, which sorting would call through a pointer.
constexpr auto kRankOf = [](const DirectedEdge& edge) { return edgeRank(edge.from, edge.to); };

std::string describe(const DirectedEdge& edge, std::size_t count) {
  std::string what = count == 2   ? "is walked twice in the same direction"
                     : count == 1 ? "belongs to one face only"
                                  : "belongs to " + std::to_string(count) + " faces";
  return "the edge between vertices " + std::to_string(edge.from) + " and " +
         std::to_string(edge.to) + " (face " + std::to_string(edge.polygon) + ") " + what;
}

}  // namespace

EdgePairing pairEdges(std::vector<DirectedEdge> edges) {
  sortEdges(edges, kRankOf, [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.from, a.polygon) < std::tie(b.from, b.polygon);
  });
  EdgePairing result;
  result.matches.reserve(edges.size() / 2);
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && kRankOf(edges[first]) == kRankOf(edges[last])) ++last;
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
