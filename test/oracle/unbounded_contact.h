// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Half-spaces and planes against anything.
#pragma once

#include "oracle.h"

namespace oracle {

/// Whether `part`, moved by `shift`, meets a half-space or plane.
Verdict meetsUnbounded(const Part& part, const Displacement& shift, double sign,
                       const UnboundedSet& set);

/// Two of them, that of A displaced. Normals within about 1.5e-8 of each other count as parallel,
/// as for FCL.
Verdict unboundedMeet(const UnboundedSet& a, const UnboundedSet& b,
                      const Displacement& displacement);

}  // namespace oracle
