// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Mesh files that this library reads itself, and checks of those that it leaves to assimp.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob::detail {

/// STL, OBJ, PLY and OFF, number by number: a decimal fraction is the nearest double (whatever type
/// a PLY header gives it), a binary float is what it is. Nothing that bears a surface is passed
/// over or repaired: each throws FileError or InvalidGeometry, beginning with `path` and, if it can
/// be told, the line, for what is truncated, claims more or less than the file holds, is not a
/// number, has an index out of range or is a surface that is not supported. What else is passed
/// over is told in TriangleMesh::notes, if there is reason to. Vertices are not welded, and there
/// may be no triangle at all.
TriangleMesh readStl(const std::string& path, std::string_view content);
TriangleMesh readObj(const std::string& path, std::string_view content);
TriangleMesh readPly(const std::string& path, std::string_view content);
TriangleMesh readOff(const std::string& path, std::string_view content);

/// What glTF claims against what it holds: things that assimp repairs in silence, allocates for
/// without limit, or crashes on. \returns the number of triangles that a complete import must have
/// \throws FileError that begins with `path`
std::size_t checkGltf(const std::string& path, std::string_view content);

enum class MeshFormat { stl, obj, ply, off, gltf, collada };

/// By the extension of `path`. \throws FileError if it is not one of those supported
MeshFormat meshFormatOf(const std::string& path);

/// One of the formats above; nothing for those that are left to assimp.
std::optional<TriangleMesh> readMesh(const std::string& path, std::string_view content);

}  // namespace fcl_prob::detail
