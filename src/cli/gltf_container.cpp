// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/gltf_container.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

namespace fcl_prob::cli {
namespace {

// Constants of the glTF 2.0 specification.
constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;
constexpr const char* kDataUri = "data:application/octet-stream;base64,";

void appendNumber(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string containerOf(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string result;
  for (const std::uint32_t number :
       {kMagic, std::uint32_t{2},
        static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()),
        static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
    appendNumber(result, number);
  }
  result += json;
  appendNumber(result, static_cast<std::uint32_t>(binary.size()));
  appendNumber(result, kBinaryChunk);
  return result + binary;
}

/// As RFC 4648 has it: three bytes are four characters, and a rest is filled up with '='.
std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byteAt = [&](std::size_t at) -> std::uint32_t {
      return at < bytes.size() ? static_cast<unsigned char>(bytes[at]) : 0U;
    };
    const std::uint32_t three = byteAt(i) << 16U | byteAt(i + 1) << 8U | byteAt(i + 2);
    text += kDigits[three >> 18U];
    text += kDigits[three >> 12U & 63U];
    text += i + 1 < bytes.size() ? kDigits[three >> 6U & 63U] : '=';
    text += i + 2 < bytes.size() ? kDigits[three & 63U] : '=';
  }
  return text;
}

}  // namespace

std::optional<GltfForm> gltfFormOf(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".glb") return GltfForm::binary;
  if (ending == ".gltf") return GltfForm::text;
  return std::nullopt;
}

std::string gltfFile(nlohmann::ordered_json document, const std::string& binary, GltfForm form) {
  nlohmann::ordered_json buffer{{"byteLength", binary.size()}};
  if (form == GltfForm::text) buffer["uri"] = kDataUri + base64(binary);
  document["buffers"] = nlohmann::ordered_json::array({std::move(buffer)});
  if (form == GltfForm::text) return document.dump() + "\n";
  return containerOf(document.dump(), binary);
}

}  // namespace fcl_prob::cli
