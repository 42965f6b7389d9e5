// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A scene as a file for `fcl_prob check --scene` (docs/scene_format.md).
#pragma once

#include <string>

#include "scene.h"

namespace fcl_prob_audit {

/// Writes FOLDER/NAME.json and its meshes as OFF with 17 digits, and FOLDER/NAME.txt with
/// everything. \returns what reproduces the scene: a command, or, where the format has no words for
/// it (groups, mixtures, octrees, ...), the seed, index and family
std::string writeScene(const Scene& scene, const std::string& folder, const std::string& name,
                       const std::string& what);

}  // namespace fcl_prob_audit
