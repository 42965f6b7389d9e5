// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "base/ladder.h"

#include <algorithm>

namespace fcl_prob::detail {

std::vector<std::string>& rungsLeftOut() {
  static std::vector<std::string> names;
  return names;
}

bool isLeftOut(const char* rung) {
  const std::vector<std::string>& names = rungsLeftOut();
  return !names.empty() && std::find(names.begin(), names.end(), rung) != names.end();
}

}  // namespace fcl_prob::detail
