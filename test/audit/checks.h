// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Everything that is checked of a scene.
#pragma once

#include "scene.h"
#include "tally.h"

namespace fcl_prob_audit {

struct CheckOptions {
  /// All relations instead of a few by chance.
  bool everything = false;
  /// Of the relations only what may find this violation again.
  std::string only;
  /// Path of fcl_prob_verify, by which certificates of scenes are checked; empty for none.
  std::string verifier;
  std::uint64_t verify_every = 10;  ///< scenes of a family
};

/// Asks the scene's question, and what follows from it. Deterministic.
std::vector<Violation> check(const Scene& scene, Tally& tally, const CheckOptions& options = {});

// What `check` does for questions of more than one pair.
void checkManager(const Scene& scene, Tally& tally, std::vector<Violation>& found);
void checkBatch(const Scene& scene, Tally& tally, std::vector<Violation>& found);

}  // namespace fcl_prob_audit
