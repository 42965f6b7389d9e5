// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The answer where nothing can touch, whatever the poses.
#pragma once

#include <string>

#include "fcl_prob/probability_request.h"
#include "fcl_prob/probability_result.h"

namespace fcl_prob::detail {

/// P = 0, with all that the request asks for. \param why  for ProbabilityResult::plan
ProbabilityResult withoutContact(const ProbabilityRequest& request, const std::string& why);

}  // namespace fcl_prob::detail
