// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The library's exceptions as Python's.
#pragma once

namespace fcl_prob::python {

/// From now on each class of fcl_prob/exceptions.h becomes the one of its name in
/// fcl_prob._errors.
void translateExceptions();

}  // namespace fcl_prob::python
