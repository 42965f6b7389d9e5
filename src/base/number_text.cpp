// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/number_text.h"

#include <array>
#include <charconv>

namespace fcl_prob::detail {

std::string numberText(double value) {
  std::array<char, 32> buffer{};
  const std::to_chars_result end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), end.ptr);
}

std::string numberText(const Eigen::Vector3d& value) {
  return "(" + numberText(value.x()) + ", " + numberText(value.y()) + ", " + numberText(value.z()) +
         ")";
}

}  // namespace fcl_prob::detail
