// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Meshes from files. In the library fcl_prob::io, the only part that needs assimp.
#pragma once

#include <cstddef>
#include <string>

#include "fcl_prob/triangle_mesh.h"

namespace fcl_prob {

struct MeshOptions {
  /// Centre the bounding box at the origin and make its longest side 1 m, before `scale`.
  bool normalize = false;
  /// Factor on every coordinate, > 0: 0.001 for a file in millimetres.
  double scale = 1.0;
};

/// What one import may use. Exceeding any of them is a FileError.
struct ImportLimits {
  std::size_t file_bytes = std::size_t{1} << 30;
  /// Address space and processor time of the child process of loadMeshIsolated().
  std::size_t memory_bytes = std::size_t{4} << 30;
  unsigned seconds = 120;
};

/// Reads all triangles of a STL, OBJ, PLY, OFF, DAE, glTF or GLB file (known by its extension).
///
/// The transforms of the file's nodes are applied, among them a unit that the format itself
/// declares (COLLADA's `unit`); otherwise the numbers are taken as metres, and the axes are the
/// file's. Polygons are triangulated, points and lines ignored, bitwise equal vertices welded.
///
/// STL, OBJ, PLY and OFF are read here, and decimal fractions become the nearest doubles. COLLADA
/// and glTF are imported by assimp in single precision: TriangleMesh::coordinate_error says what it
/// rounds. A mesh that its precision cannot hold to 1e-3 of its size, as it is too far from its
/// origin, is refused.
///
/// A truncated or malformed file is refused, not repaired, and so is one that holds a surface of a
/// kind that is not supported (a free-form one of OBJ, an element of PLY that is neither faces nor
/// triangle strips, a polygon that crosses itself). TriangleMesh::notes says what else was passed
/// over. What assimp imports is checked before and afterwards; even so assimp can crash on
/// malformed files: use loadMeshIsolated() for files that are not trusted. Imports by assimp take
/// turns. \throws FileError (missing, unreadable, malformed), InvalidGeometry (no triangles,
/// coordinates
///         that are not finite or beyond 1e150, indices out of range), InvalidRequest (a scale that
///         is not finite and > 0); the message names the file, the fault, and the line (or byte)
///         where there is one.
TriangleMesh loadMesh(const std::string& path, const MeshOptions& options = {},
                      const ImportLimits& limits = {});

/// The same in a forked child process (POSIX): a crash, an endless loop or a memory hog of the
/// importer becomes a FileError. Where other threads run, the C library has to let a forked child
/// allocate memory (glibc does; AddressSanitizer does not always, and the child then waits until
/// its time is over): load meshes before threads are started.
TriangleMesh loadMeshIsolated(const std::string& path, const MeshOptions& options = {},
                              const ImportLimits& limits = {});

}  // namespace fcl_prob
