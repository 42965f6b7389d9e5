// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Many scenes, on all cores.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "checks.h"
#include "families.h"

namespace fcl_prob_audit {

struct AuditPlan {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< index of the first scene
  std::optional<std::uint64_t> scenes;
  std::optional<double> seconds;  ///< whichever comes first
  std::string family;             ///< only that one
  CheckOptions options;
  unsigned threads = 1;
  bool verbose = false;
};

/// A scene that fails, and its first violation of a kind.
struct Failure {
  Scene scene;
  Violation violation;
};

struct AuditReport {
  Tally tally;
  /// Of every family and check the first few failing scenes by their index.
  std::vector<Failure> failures;
  std::uint64_t scenes = 0;
  double seconds = 0.0;
};

AuditReport runAudit(const AuditPlan& plan);

/// The smallest scene with the same violation.
Failure smallest(const Failure& failure, CheckOptions options);

std::string textOf(const AuditReport& report);

/// Whether more estimates are beyond 5 standard errors than chance allows (about 6e-7 of them).
bool hasHeavyTails(const Tally& tally);

}  // namespace fcl_prob_audit
