// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/mesh_names.h"

#include <charconv>
#include <filesystem>
#include <optional>

#include "fcl_prob/exceptions.h"

namespace fcl_prob::detail {
namespace {

namespace fs = std::filesystem;

/// What "%41" stands for; what is no such code is left as it is, as files with a '%' in their names
/// were written before anybody looked at codes.
std::string decoded(const std::string& text, const std::string& where) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = 0;
    const char* const digits = text.data() + i + 1;
    const bool has_code = text[i] == '%' && i + 2 < text.size() &&
                          std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
    if (has_code && (code < 0x20 || code == 0x7f)) {
      throw FileError(where + ": " + text + ": a control character");
    }
    result += has_code ? static_cast<char>(code) : text[i];
    if (has_code) i += 2;
  }
  return result;
}

/// The folder of a package by name.
std::optional<fs::path> folderOf(const std::string& package, const std::string& urdf,
                                 const std::map<std::string, std::string>& packages) {
  const auto known = packages.find(package);
  if (known != packages.end()) return known->second;
  fs::path folder = fs::absolute(urdf).lexically_normal().parent_path();
  for (; folder.has_relative_path(); folder = folder.parent_path()) {
    if (folder.filename() == package) return folder;
  }
  return std::nullopt;
}

}  // namespace

std::string meshFile(const std::string& name, const std::string& urdf,
                     const std::map<std::string, std::string>& packages, const std::string& where) {
  const fs::path beside = fs::path(urdf).parent_path();
  const std::size_t colon = name.find("://");
  if (colon == std::string::npos) return (beside / name).lexically_normal().string();
  const std::string scheme = name.substr(0, colon);
  const std::string rest = decoded(name.substr(colon + 3), where);
  if (scheme == "file") {
    const std::string host = "localhost/";
    const std::string path = rest.rfind(host, 0) == 0 ? rest.substr(host.size() - 1) : rest;
    return (beside / path).lexically_normal().string();
  }
  if (scheme != "package" && scheme != "model") {
    throw FileError(where + ": " + name + ": " + scheme +
                    ":// is not read here, only file://, package:// and model://");
  }
  const std::size_t end = rest.find('/');
  const std::string package = rest.substr(0, end);
  const auto folder = folderOf(package, urdf, packages);
  if (!folder || end == std::string::npos) {
    throw FileError(where + ": " + name + ": no folder is known for the " +
                    (scheme == "model" ? "model " : "package ") + package);
  }
  return (*folder / rest.substr(end + 1)).lexically_normal().string();
}

}  // namespace fcl_prob::detail
