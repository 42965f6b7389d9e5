// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "placed_set.h"

#include <boost/pending/disjoint_sets.hpp>
#include <map>

namespace fcl_prob_audit {

std::vector<int> partRepresentatives(const TriangleMesh& mesh) {
  const std::size_t count = mesh.vertices.size();
  boost::disjoint_sets_with_storage<> sets(count);
  std::map<std::array<double, 3>, std::size_t> known;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d& v = mesh.vertices[i];
    sets.union_set(i, known.try_emplace({v[0] + 0.0, v[1] + 0.0, v[2] + 0.0}, i).first->second);
  }
  for (const fcl::Triangle& t : mesh.triangles) {
    sets.union_set(t[0], t[1]);
    sets.union_set(t[0], t[2]);
  }
  std::map<std::size_t, int> representatives;
  for (const fcl::Triangle& t : mesh.triangles) {
    representatives.try_emplace(sets.find_set(t[0]), static_cast<int>(t[0]));
  }
  std::vector<int> result;
  for (const auto& [unused, vertex] : representatives) result.push_back(vertex);
  return result;
}

}  // namespace fcl_prob_audit
