// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// glTF 2.0 (text or binary container): how many triangles its primitives claim.
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "fcl_prob/exceptions.h"
#include "io/mesh_formats.h"

namespace fcl_prob::detail {
namespace {

using Json = nlohmann::json;

constexpr std::uint32_t kBinaryMagic = 0x46546C67;     // "glTF"
constexpr std::uint32_t kJsonChunkType = 0x4E4F534A;   // "JSON"
constexpr std::size_t kBinaryGltfHeaderSize = 12 + 8;  // the file's and the first chunk's

std::uint32_t word(std::string_view content, std::size_t position) {
  std::uint32_t value = 0;
  std::memcpy(&value, content.data() + position, sizeof value);
  return value;
}

std::string_view jsonText(const std::string& path, std::string_view content) {
  if (content.size() < 4 || word(content, 0) != kBinaryMagic) return content;
  if (content.size() < kBinaryGltfHeaderSize || word(content, 8) > content.size()) {
    throw FileError(path + ": the binary glTF container is truncated");
  }
  const std::size_t length = word(content, 12);
  if (word(content, 16) != kJsonChunkType || length > content.size() - kBinaryGltfHeaderSize) {
    throw FileError(path + ": the binary glTF container does not begin with a whole JSON chunk");
  }
  return content.substr(kBinaryGltfHeaderSize, length);
}

std::size_t trianglesOf(const Json& primitive, const Json& accessors) {
  const int mode = primitive.value("mode", 4);
  if (mode < 4 || mode > 6) return 0;  // points and lines
  const std::size_t accessor = primitive.contains("indices")
                                   ? primitive.at("indices").get<std::size_t>()
                                   : primitive.at("attributes").at("POSITION").get<std::size_t>();
  const std::size_t corners = accessors.at(accessor).at("count").get<std::size_t>();
  if (mode == 4) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

}  // namespace

std::size_t checkGltf(const std::string& path, std::string_view content) {
  try {
    const Json document = Json::parse(jsonText(path, content));
    const Json no_accessors = Json::array();
    const Json& accessors =
        document.contains("accessors") ? document.at("accessors") : no_accessors;
    std::size_t triangles = 0;
    if (document.contains("meshes")) {
      for (const Json& mesh : document.at("meshes")) {
        for (const Json& primitive : mesh.at("primitives")) {
          triangles += trianglesOf(primitive, accessors);
        }
      }
    }
    return triangles;
  } catch (const Json::exception& error) {
    throw FileError(path + ": not a valid glTF document: " + error.what());
  }
}

}  // namespace fcl_prob::detail
