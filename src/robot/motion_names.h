// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The words that scene files, the command and Python have for values of a motion.
#pragma once

#include "fcl_prob/robot_query.h"
#include "gaussian/named_values.h"

namespace fcl_prob::detail {

inline constexpr NamedValues<ErrorsOverTime, 3> kErrorsOverTime{
    {{ErrorsOverTime::persistent, "persistent"},
     {ErrorsOverTime::independent, "independent"},
     {ErrorsOverTime::any_dependence, "any-dependence"}}};

inline constexpr NamedValues<BetweenWaypoints, 2> kBetweenWaypoints{
    {{BetweenWaypoints::ignored, "ignored"}, {BetweenWaypoints::swept, "swept"}}};

}  // namespace fcl_prob::detail
