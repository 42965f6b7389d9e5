// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The words that scene files, the command and Python have for values of the library.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "fcl_prob/pose_error.h"
#include "fcl_prob/probability_request.h"

namespace fcl_prob::detail {

template <class Value, std::size_t count>
using NamedValues = std::array<std::pair<Value, const char*>, count>;

inline constexpr NamedValues<PoseConvention, 4> kPoseConventions{
    {{PoseConvention::world_rotation_vector, "world"},
     {PoseConvention::body_rotation_vector, "body"},
     {PoseConvention::world_exponential, "world-exponential"},
     {PoseConvention::body_exponential, "body-exponential"}}};

inline constexpr NamedValues<ContactMeaning, 3> kContactMeanings{
    {{ContactMeaning::fcl, "fcl"},
     {ContactMeaning::solid, "solid"},
     {ContactMeaning::contained, "contained"}}};

template <class Value, std::size_t count>
std::optional<Value> valueOf(const NamedValues<Value, count>& known, const std::string& name) {
  for (const auto& [value, its_name] : known) {
    if (name == its_name) return value;
  }
  return std::nullopt;
}

/// Empty for what is none of them.
template <class Value, std::size_t count>
std::string nameOf(const NamedValues<Value, count>& known, Value wanted) {
  for (const auto& [value, name] : known) {
    if (value == wanted) return name;
  }
  return "";
}

}  // namespace fcl_prob::detail
