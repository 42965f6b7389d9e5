// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Values that a report may not have, as JSON: null.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/nominal_answer.h"
#include "fcl_prob/bounds.h"

namespace fcl_prob::cli {

template <typename Value>
nlohmann::ordered_json orNull(const std::optional<Value>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

/// [x, y, z]
nlohmann::ordered_json orNull(const std::optional<Eigen::Vector3d>& value);

/// [lower, upper]
nlohmann::ordered_json orNull(const std::optional<Bounds>& value);

/// {"collides": ..., "distance": ...}
nlohmann::ordered_json jsonOf(const NominalAnswer& answer);

}  // namespace fcl_prob::cli
