// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is told, with an answer, of the files that meshes were read from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/gaussian_displacement.h"

namespace fcl_prob::detail {

/// Adds those notes that are not there yet: of a file that is read several times.
void addNotes(const std::vector<std::string>& more, std::vector<std::string>& notes);

/// Infinite where nothing moves.
double leastDeviation(const GaussianDisplacement& displacement);

/// That a mesh is read in single precision; nothing where what that rounds is small beside the
/// least deviation, and what it changes of P beside the tolerance.
/// \param subject           begins the note: "the file of A is"
/// \param coordinate_error  as TriangleMesh::coordinate_error
std::optional<std::string> precisionNote(const std::string& subject, double coordinate_error,
                                         double least_deviation, double tolerance);

}  // namespace fcl_prob::detail
