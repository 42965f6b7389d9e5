// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The files that the names of a URDF's meshes stand for.
#pragma once

#include <map>
#include <string>

namespace fcl_prob::detail {

/// The path of a mesh: `package://NAME/…` and `model://NAME/…` in the folder of that name, which
/// is one of `packages` or else the folder of the URDF or one above it; `file://…`; all else is
/// relative to the URDF's folder. In the names that are URIs "%20" is a blank and so on.
/// \param where  begins messages. \throws FileError for a folder that is not known, another scheme
std::string meshFile(const std::string& name, const std::string& urdf,
                     const std::map<std::string, std::string>& packages, const std::string& where);

}  // namespace fcl_prob::detail
