// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// FCL's primitives by name.
#pragma once

#include <string>
#include <vector>

#include "fcl_prob/scene_io.h"
#include "io/strict_json.h"

namespace fcl_prob::detail {

/// The keys that name a primitive in a scene file: "box", "sphere", ...
const std::vector<std::string>& primitiveNames();

/// Reads the primitive at the key `name` of `object`. \throws FileError
PrimitiveShape readPrimitive(StrictObject& object, const std::string& name);

}  // namespace fcl_prob::detail
