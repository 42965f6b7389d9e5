// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The same question asked in another way: scenes with the same P, or with one that cannot be less.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene.h"

namespace fcl_prob_audit {

/// A scene that follows from another one, without any rounding.
struct Relation {
  std::string name;
  /// Nothing where it cannot be done exactly.
  std::function<std::optional<Scene>(const Scene&, std::uint64_t choice)> derive;
  /// Of P of the derived scene.
  enum class Holds { equal, at_most, at_least } holds = Holds::equal;
  /// The gradient of the derived scene is this times that of the original; not set: not compared.
  std::function<Matrix3d(std::uint64_t choice)> gradient;
};

const std::vector<Relation>& relations();

}  // namespace fcl_prob_audit
