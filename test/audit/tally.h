// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What an audit has looked at, and what it found.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "scene.h"

namespace fcl_prob_audit {

/// Something that must hold and does not.
struct Violation {
  std::string check;   ///< what was checked, as short as a name
  std::string detail;  ///< the numbers
};

struct FamilyTally {
  std::size_t scenes = 0, answered = 0, refused = 0;
  std::size_t exact_truths = 0, sampled_truths = 0;
  std::size_t claims = 0, claim_points = 0;  ///< of cells, and displacements tried in them
  std::size_t undecided = 0;                 ///< of these, by the oracle
  std::size_t non_trivial = 0;               ///< with bounds around a P in (1e-3, 0.999)
  std::size_t late = 0;                      ///< beyond their time limit by more than 0.2 s
  double seconds = 0.0;
  double slowest = 0.0;
};

struct Tally {
  std::map<std::string, FamilyTally> families;
  std::map<std::string, std::size_t> checks;      ///< how often each was made
  std::map<std::string, std::size_t> violations;  ///< by family and check
  std::map<std::string, std::size_t> refusals;    ///< by family and type of exception
  std::map<int, std::size_t> ranks;
  std::map<std::string, std::size_t> kinds;
  std::map<int, std::size_t> decades;  ///< of the upper bound
  std::size_t solids = 0;
  std::size_t estimates = 0;         ///< compared with what is known better
  std::size_t estimates_beyond = 0;  ///< of them, by more than 5 standard errors

  void add(const Tally& other);
};

}  // namespace fcl_prob_audit
