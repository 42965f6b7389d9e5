// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scene files. Those of two primitives are answered too, within narrow limits.
#include "fcl_prob/scene_io.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <random>

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

using Json = nlohmann::json;
using Random = std::minstd_rand;

template <typename Values>
auto oneOf(const Values& values, Random& random) {
  return values[random() % std::size(values)];
}

Json changed(const Json& value, Random& random) {
  constexpr std::array<double, 16> kNumbers = {0.0,   1.0,    -1.0,   0.5,   2.0,  1e-3,
                                               1e3,   1e-12,  1e12,   1e-60, 1e60, 1e-300,
                                               1e300, 1e-320, -1e150, 0.3};
  if (value.is_string()) {
    std::vector<std::string> words = methodNames();
    words.insert(words.end(), {"fcl", "solid", ""});
    return oneOf(words, random);
  }
  if (!value.is_number()) return random() % 2 == 0;
  if (random() % 2 == 0) return oneOf(kNumbers, random);
  return value.get<double>() * (0.25 * static_cast<double>(random() % 9));
}

/// What to change where the bytes are no JSON, as most are that a fuzzer has come by.
Json anyScene(Random& random) {
  static const std::array<Json, 8> shapes = {
      Json{{"box", {1, 2, 3}}},
      Json{{"sphere", 0.5}},
      Json{{"ellipsoid", {1, 2, 3}}},
      Json{{"capsule", {{"radius", 0.5}, {"length", 1}}}},
      Json{{"cone", {{"radius", 0.5}, {"length", 1}}}},
      Json{{"cylinder", {{"radius", 0.5}, {"length", 1}}}},
      Json{{"halfspace", {{"normal", {0, 0, 1}}, {"offset", 0}}}},
      Json{{"plane", {{"normal", {0, 0, 1}}, {"offset", 0}}}}};
  Json scene = {{"a", oneOf(shapes, random)},
                {"b", oneOf(shapes, random)},
                {"displacement", {{"sigma", {1, 1, 1}}, {"mean", {0, 0, 0}}}},
                {"request", {{"method", "auto"}, {"contact", "fcl"}, {"threshold", 0.5}}}};
  scene["a"]["pose"] = {1, 0.5, 0.2, 1, 0.1, 0.2, 0.3};
  return scene;
}

/// Changes a value somewhere, so that what was a scene mostly still is one.
void change(Json& document, Random& random) {
  const Json values = document.flatten();
  auto position = values.begin();
  std::advance(position, random() % values.size());
  document[Json::json_pointer(position.key())] = changed(*position, random);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t max_size, unsigned seed) {
  Random random(seed);
  if (random() % 4 != 0) {
    Json document = Json::parse(data, data + size, nullptr, false);
    if (!document.is_object() || document.empty()) document = anyScene(random);
    for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) change(document, random);
    const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() <= max_size) return text.copy(reinterpret_cast<char*>(data), text.size());
  }
  return LLVMFuzzerMutate(data, size, max_size);
}

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
