// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/mesh_formats.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>

namespace fcl_prob::detail {

MeshFormat meshFormatOf(const std::string& path) {
  const std::string extension =
      boost::algorithm::to_lower_copy(std::filesystem::path(path).extension().string());
  if (extension == ".stl") return MeshFormat::stl;
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".off") return MeshFormat::off;
  if (extension == ".gltf" || extension == ".glb") return MeshFormat::gltf;
  if (extension == ".dae") return MeshFormat::collada;
  throw FileError(path + ": unknown kind of mesh file '" + extension +
                  "'; known are .stl .obj .ply .off .dae .gltf .glb");
}

std::optional<TriangleMesh> readMesh(const std::string& path, std::string_view content) {
  const MeshFormat format = meshFormatOf(path);
  if (content.empty()) throw FileError(path + ": the file is empty");
  if (format == MeshFormat::stl) return readStl(path, content);
  if (format == MeshFormat::obj) return readObj(path, content);
  if (format == MeshFormat::ply) return readPly(path, content);
  if (format == MeshFormat::off) return readOff(path, content);
  return std::nullopt;
}

}  // namespace fcl_prob::detail
