// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Certificates of scenes, checked by a program that shares nothing with the library.
#pragma once

#include <string>
#include <vector>

#include "scene.h"
#include "tally.h"

namespace fcl_prob_audit {

/// Writes the certificate of a pair or group of meshes, polytopes, spheres, capsules
/// and octrees, and has `verifier`
/// (fcl_prob_verify) check it; scenes that no certificate can be written of are passed over.
void checkByVerifier(const Scene& scene, const std::string& verifier, Tally& tally,
                     std::vector<Violation>& found);

}  // namespace fcl_prob_audit
