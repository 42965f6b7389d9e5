// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/number_text.h"

#include <iomanip>
#include <sstream>

namespace fcl_prob::cli {

std::string numberText(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string intervalText(const Bounds& bounds) {
  return "[" + numberText(bounds.lower, 6) + ", " + numberText(bounds.upper, 6) + "]";
}

}  // namespace fcl_prob::cli
