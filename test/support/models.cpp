// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "models.h"

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace fcl_prob_test {

std::optional<std::string> modelsFolder() {
  if (const char* folder = std::getenv("FCL_PROB_MODELS")) return std::string(folder);
  const std::filesystem::path beside =
      std::filesystem::path(FCL_PROB_SOURCE_DIR) / ".." / "shared" / "models";
  if (std::filesystem::is_directory(beside)) return beside.lexically_normal().string();
  return std::nullopt;
}

std::optional<std::string> modelOrSkip(const std::string& relative_path) {
  const std::optional<std::string> folder = modelsFolder();
  if (folder) {
    const std::filesystem::path path = std::filesystem::path(*folder) / relative_path;
    if (std::filesystem::exists(path)) return path.string();
  }
  std::cout << "SKIPPED: test model " << relative_path << " not found; set FCL_PROB_MODELS\n";
  return std::nullopt;
}

}  // namespace fcl_prob_test
