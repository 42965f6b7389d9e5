// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/json_values.h"

namespace fcl_prob::cli {

using Json = nlohmann::ordered_json;

Json orNull(const std::optional<Eigen::Vector3d>& value) {
  return value ? Json({value->x(), value->y(), value->z()}) : Json(nullptr);
}

Json orNull(const std::optional<Bounds>& value) {
  return value ? Json({value->lower, value->upper}) : Json(nullptr);
}

Json jsonOf(const NominalAnswer& answer) {
  return {{"collides", orNull(answer.collides)}, {"distance", orNull(answer.distance)}};
}

}  // namespace fcl_prob::cli
