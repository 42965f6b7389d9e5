// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// fcl_prob export to .gltf: the same as to .glb, as one text.
#include <cstdint>
#include <filesystem>

#include "catch.h"
#include "cli/gltf_container.h"
#include "command.h"
#include "fcl_prob/mesh_io.h"
#include "glb_reader.h"

using namespace fcl_prob;
using namespace fcl_prob_test;

namespace {

/// By RFC 4648, and nothing that it does not allow.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  REQUIRE(text.size() % 4 == 0);
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  const std::string data = text.substr(0, text.find_last_not_of('=') + 1);
  REQUIRE(data.find_first_not_of(digits) == std::string::npos);
  for (const char c : data) {
    bits = (bits << 6U | static_cast<std::uint32_t>(digits.find(c))) & 0xFFFFU;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xFFU);
  }
  CHECK((bytes.size() + 2) / 3 * 4 == text.size());
  return bytes;
}

/// The data of the only buffer, whose `uri` is taken out.
std::string takeBuffer(nlohmann::json& document) {
  REQUIRE(document.at("buffers").size() == 1);
  nlohmann::json& buffer = document["buffers"][0];
  const std::string uri = buffer.at("uri");
  const std::string start = "data:application/octet-stream;base64,";
  REQUIRE(uri.compare(0, start.size(), start) == 0);
  buffer.erase("uri");
  return decoded(uri.substr(start.size()));
}

void exportTo(const std::string& file, std::vector<std::string> options,
              const TemporaryFolder& folder) {
  options.insert(options.begin(), "export");
  options.insert(options.end(), {"--output", file});
  const CommandResult result = runCommand(options, folder);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
}

/// Both files of the same scene. \returns the document
nlohmann::json checkedBoth(const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  exportTo("scene.glb", options, folder);
  exportTo("scene.gltf", options, folder);
  const GlbFile binary(readWhole(folder.path("scene.glb")));
  nlohmann::json text = nlohmann::json::parse(readWhole(folder.path("scene.gltf")));
  CHECK(takeBuffer(text) == binary.binary());
  CHECK(text == binary.json);

  const TriangleMesh one = loadMesh(folder.path("scene.glb"));
  const TemporaryFolder alone;
  std::filesystem::rename(folder.path("scene.gltf"), alone.path("scene.gltf"));
  const TriangleMesh other = loadMesh(alone.path("scene.gltf"));
  CHECK(other.vertices == one.vertices);
  CHECK(other.triangles.size() == one.triangles.size());
  return text;
}

}  // namespace

TEST_CASE("a scene is exported to .gltf as it is to .glb", "[cli]") {
  const nlohmann::json document =
      checkedBoth({"--scene", dataFile("finger_mug.json"), "--samples", "500"});
  CHECK(document.at("meshes").size() == 5);
}

#ifdef FCL_PROB_HAS_ROBOT
TEST_CASE("a motion is exported to .gltf as it is to .glb, with its animation", "[cli]") {
  const nlohmann::json document =
      checkedBoth({"--scene", dataFile("arm_path.json"), "--poses", "3"});
  CHECK(document.at("animations").at(0).at("channels").size() > 10);
}
#endif

TEST_CASE("data of any length are written in base64", "[cli]") {
  std::string bytes;
  for (int i = 0; i < 600; ++i) {
    nlohmann::json text = nlohmann::json::parse(cli::gltfFile({}, bytes, cli::GltfForm::text));
    CHECK(text.at("buffers").at(0).at("byteLength") == bytes.size());
    CHECK(takeBuffer(text) == bytes);
    bytes += static_cast<char>(i * 37 % 256);
  }
}

TEST_CASE("export names the endings that it knows", "[cli]") {
  const TemporaryFolder folder;
  for (const char* scene : {
           "finger_mug.json",
#ifdef FCL_PROB_HAS_ROBOT
           "arm_path.json",
#endif
       }) {
    for (const char* file : {"x.stl", "x", ".gltf", "x.GLTF", "x.gltf.json", "glb"}) {
      CAPTURE(scene, file);
      const CommandResult result =
          runCommand({"export", "--scene", dataFile(scene), "--output", file}, folder);
      CHECK(result.refused());
      CHECK(result.err.find("--output: the file name must end in .glb or .gltf") !=
            std::string::npos);
    }
  }
}
