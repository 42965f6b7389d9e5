// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The files that the names of a URDF's meshes stand for.
#pragma once

#include <map>
#include <string>

namespace fcl_prob::detail {

/// The path of a mesh: `package://NAME/…` and `model://NAME/…` in the folder of that name, which
/// is one of `packages`, or else the folder of the URDF or one above it, or else, of a package,
/// where ROS finds it: <prefix>/share/NAME for AMENT_PREFIX_PATH, then <folder>/NAME or a folder of
/// that name for ROS_PACKAGE_PATH. `file://…`; all else is relative to the URDF's folder. In the
/// names that are URIs "%20" is a blank and so on.
/// \param folder  of the URDF; empty: there is none \param where  begins messages
/// \throws FileError for a folder that is not known, another scheme
std::string meshFile(const std::string& name, const std::string& folder,
                     const std::map<std::string, std::string>& packages, const std::string& where);

}  // namespace fcl_prob::detail
