// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What a mesh file claims against what it holds, before the importer trusts the claims.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace fcl_prob::detail {

/// Each check throws FileError or InvalidGeometry, beginning with `path`, when the file is
/// truncated, claims more than it holds or has an index out of range: things that assimp repairs in
/// silence, allocates for without limit, or crashes on. They return the number of triangles (a
/// polygon of n corners counts n - 2) that a complete import must have.
std::size_t checkStl(const std::string& path, std::string_view content);
std::size_t checkObj(const std::string& path, std::string_view content);
std::size_t checkPly(const std::string& path, std::string_view content);
std::size_t checkOff(const std::string& path, std::string_view content);
std::size_t checkGltf(const std::string& path, std::string_view content);

/// Checks by the extension of `path`. Nothing is returned for a format (COLLADA) whose parser does
/// the checking. \throws FileError also if the extension is not one of those supported.
std::optional<std::size_t> checkMeshFile(const std::string& path, std::string_view content);

}  // namespace fcl_prob::detail
