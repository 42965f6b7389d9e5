// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Numbers in messages: the shortest text that reads back as the same double.
#pragma once

#include <Eigen/Core>
#include <string>

namespace fcl_prob::detail {

std::string numberText(double value);

/// "(x, y, z)"
std::string numberText(const Eigen::Vector3d& value);

}  // namespace fcl_prob::detail
