// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/file_checks.h"

#include <boost/algorithm/string/case_conv.hpp>
#include <filesystem>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {

std::optional<std::size_t> checkMeshFile(const std::string& path, std::string_view content) {
  const std::string extension =
      boost::algorithm::to_lower_copy(std::filesystem::path(path).extension().string());
  const bool known = extension == ".stl" || extension == ".obj" || extension == ".ply" ||
                     extension == ".off" || extension == ".dae" || extension == ".gltf" ||
                     extension == ".glb";
  if (!known) {
    throw FileError(path + ": unknown kind of mesh file '" + extension +
                    "'; known are .stl .obj .ply .off .dae .gltf .glb");
  }
  if (content.empty()) throw FileError(path + ": the file is empty");
  if (extension == ".stl") return checkStl(path, content);
  if (extension == ".obj") return checkObj(path, content);
  if (extension == ".ply") return checkPly(path, content);
  if (extension == ".off") return checkOff(path, content);
  if (extension == ".dae") return std::nullopt;
  return checkGltf(path, content);
}

}  // namespace fcl_prob::detail
