// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The scenes of the audit: (seed, index, family) gives the same scene always.
#pragma once

#include "families.h"
#include "scene.h"

namespace fcl_prob_audit {

/// A scene of that family. Objects are placed such that they touch at a whitened displacement of a
/// chosen length, whatever their shapes and the displacement's rank are: so P is spread over
/// decades.
Scene generate(std::uint64_t seed, std::uint64_t index, const Family& family);

/// Scenes are dealt to the families in turn.
Scene generate(std::uint64_t seed, std::uint64_t index);

}  // namespace fcl_prob_audit
