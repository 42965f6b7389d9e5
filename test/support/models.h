// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Where the test models are that the project does not ship.
#pragma once

#include <optional>
#include <string>

namespace fcl_prob_test {

/// The folder of models for tests: $FCL_PROB_MODELS, or ../shared/models beside the checkout;
/// nothing when neither exists. A test without its models prints SKIPPED and returns.
std::optional<std::string> modelsFolder();

/// The full path of a model below modelsFolder(); prints "SKIPPED: ..." and returns nothing without
/// it.
std::optional<std::string> modelOrSkip(const std::string& relative_path);

}  // namespace fcl_prob_test
