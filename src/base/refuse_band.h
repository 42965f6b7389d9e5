// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#pragma once

#include <string>

#include "fcl_prob/probability_request.h"

namespace fcl_prob::detail {

/// \param by  what has no answer for bands around the shapes
/// \throws InvalidRequest if the request has one
void refuseBand(const ProbabilityRequest& request, const std::string& by);

}  // namespace fcl_prob::detail
