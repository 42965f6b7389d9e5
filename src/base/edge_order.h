// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Sorting the edges of a mesh.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <boost/sort/spreadsort/integer_sort.hpp>

namespace fcl_prob::detail {

/// One number for the edge between two vertices, numbered from 0: by the lower one, then by the
/// higher one.
inline std::uint64_t edgeRank(int one, int other) {
  const auto [low, high] = std::minmax(one, other);
  return static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint32_t>(high);
}

/// Sorts edges by rank and those of the same rank by `less`, in a time that hardly grows faster
/// than their number. \param rank  of an edge, its edgeRank()
template <typename Edge, typename Rank, typename Less>
void sortEdges(std::vector<Edge>& edges, const Rank& rank, const Less& less) {
  const auto shifted = [&rank](const Edge& edge, unsigned by) { return rank(edge) >> by; };
  const auto isLower = [&rank](const Edge& a, const Edge& b) { return rank(a) < rank(b); };
  boost::sort::spreadsort::integer_sort(edges.begin(), edges.end(), shifted, isLower);
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(),
                                   [&](const Edge& edge) { return rank(edge) != rank(*first); });
    if (last - first > 1) std::sort(first, last, less);
    first = last;
  }
}

}  // namespace fcl_prob::detail
