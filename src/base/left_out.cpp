// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/left_out.h"

#include <algorithm>

namespace fcl_prob::detail {

std::vector<std::string>& leftOut() {
  static std::vector<std::string> names;
  return names;
}

bool isLeftOut(const char* name) {
  const std::vector<std::string>& names = leftOut();
  return !names.empty() && std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace fcl_prob::detail
