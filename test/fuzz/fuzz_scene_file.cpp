// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scene files. Those of two primitives are answered too, within narrow limits.
#include "fcl_prob/scene_io.h"

#include <cstddef>

#include "fcl_prob/exceptions.h"
#include "fuzz_tally.h"
#include "memory_file.h"
#include "query_invariants.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

std::optional<PairScene> pairOf(const Scene& scene) {
  const auto* a = std::get_if<PrimitiveShape>(&scene.a.shape);
  const auto* b = std::get_if<PrimitiveShape>(&scene.b.shape);
  if (a == nullptr || b == nullptr) return std::nullopt;
  return PairScene{*a, scene.a.pose, *b, scene.b.pose, scene.displacement, scene.request};
}

std::optional<Scene> sceneOf(const std::string& path) {
  try {
    Scene scene = loadScene(path);
    validateRequest(scene.request);
    return scene;
  } catch (const FileError&) {
  } catch (const InvalidRequest&) {
  }
  return std::nullopt;
}

/// Sampling is fcl::collide's, which may search without end: the certified methods are ours.
void limitWork(ProbabilityRequest& request) {
  using Method = ProbabilityMethod;
  if (request.method == Method::monte_carlo || request.method == Method::rare_event) {
    request.method = Method::interval;
  }
  request.max_cells = 32;
  request.time_limit.reset();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("scene files");
  static const MemoryFile file(".json");
  tally.count("inputs");
  file.write(data, size);
  const std::optional<Scene> scene = sceneOf(file.path());
  if (!scene) return 0;
  tally.count("read");
  std::optional<PairScene> pair = pairOf(*scene);
  if (!pair) return 0;
  limitWork(pair->request);
  const std::optional<ProbabilityResult> result = answerOf(*pair);
  if (!result) return 0;
  requireSound(*result);
  tally.count("answered");
  return 0;
}
