// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/edge_order.h"

#include <limits>
#include <tuple>

#include "catch.h"
#include "random_bodies.h"

using namespace fcl_prob::detail;
using namespace fcl_prob_test;

namespace {

struct Edge {
  int from;
  int to;
  int face;
};

auto valuesOf(const Edge& edge) { return std::tuple(edge.from, edge.to, edge.face); }

std::uint64_t rankOf(const Edge& edge) { return edgeRank(edge.from, edge.to); }

bool isBefore(const Edge& a, const Edge& b) {
  return std::tie(a.from, a.face) < std::tie(b.from, b.face);
}

bool isLower(const Edge& a, const Edge& b) {
  const auto [low_a, high_a] = std::minmax(a.from, a.to);
  const auto [low_b, high_b] = std::minmax(b.from, b.to);
  return std::tuple(low_a, high_a, a.from, a.face) < std::tuple(low_b, high_b, b.from, b.face);
}

}  // namespace

TEST_CASE("edges come by their lower vertex, their higher one, and what else is asked for") {
  RandomBodies random(41);
  for (const int vertices : {1, 5, 3000, std::numeric_limits<int>::max()}) {
    for (const int count : {0, 1, 20, 2000, 30'000}) {
      std::vector<Edge> edges;
      for (int i = 0; i < count; ++i) {
        edges.push_back({random.integer(0, vertices - 1), random.integer(0, vertices - 1),
                         random.integer(0, 3)});
      }
      std::vector<Edge> truth = edges;
      std::sort(truth.begin(), truth.end(), isLower);
      sortEdges(edges, rankOf, isBefore);
      const bool same =
          std::equal(edges.begin(), edges.end(), truth.begin(), truth.end(),
                     [](const Edge& a, const Edge& b) { return valuesOf(a) == valuesOf(b); });
      CHECK(same);
    }
  }
}
