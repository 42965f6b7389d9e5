// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The two kinds of glTF files: what is written around a document and its binary data.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace fcl_prob::cli {

enum class GltfForm {
  binary,  ///< .glb: a container of the document and its data
  text     ///< .gltf: the document, with its data in base64
};

/// By the ending of a file's name; nothing for any other ending.
std::optional<GltfForm> gltfFormOf(const std::string& path);

/// One file without references to others.
/// \param document  without buffers
/// \param binary  its only buffer, of a multiple of four bytes
std::string gltfFile(nlohmann::ordered_json document, const std::string& binary, GltfForm form);

}  // namespace fcl_prob::cli
