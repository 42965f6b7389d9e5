// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries of two small geometries: every answer is sound, and agrees with the one in the other
// order, by another method, of a second call, and with displaced collision checks.
#include <cstddef>
#include <cstdlib>
#include <iostream>

#include "fcl_prob/exceptions.h"
#include "fuzz_tally.h"
#include "query_invariants.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

std::optional<PairScene> decoded(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  try {
    return fcl_prob_fuzz::sceneFrom(input);
  } catch (const InvalidGeometry&) {
    return std::nullopt;
  }
}

/// The same question, asked of the partition for another number of cells.
PairScene byPartition(PairScene scene) {
  scene.request.method = ProbabilityMethod::interval;
  scene.request.max_cells = 60 - scene.request.max_cells;
  scene.request.gradient = false;
  return scene;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("queries");
  tally.count("inputs");
  std::optional<PairScene> scene = decoded(data, size);
  if (!scene) return 0;
  tally.count("asked");
  if (std::getenv("FCL_PROB_FUZZ_SHOW") != nullptr) std::cerr << textOf(*scene);
  const std::optional<ProbabilityResult> result = answerOf(*scene);
  if (!result) return 0;
  tally.count("answered");
  requireSound(*result);
  const std::uint64_t hash = hashOf(data, size);
  if (hash % 2 == 0) {
    if (const auto other = answerOf(byPartition(*scene))) {
      requireSound(*other);
      requireCompatible(*result, *other, "another method");
    }
  } else if (const auto other = answerOf(swapped(*scene))) {
    requireSound(*other);
    requireCompatible(*result, *other, "the other order");
  }
  if (hash % 16 < 2) {
    scene->request.threads = 2;
    requireSame(*result, answerOf(*scene).value());
    tally.count("repeated");
  }
  if (hash % 4 == 0 && requireSamplesAgree(*scene, *result, hash)) tally.count("sampled");
  return 0;
}
