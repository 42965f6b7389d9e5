// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "robot/mesh_names.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

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

/// What a variable of the environment lists.
std::vector<fs::path> foldersOf(const char* variable) {
  const char* value = std::getenv(variable);
  std::istringstream listed(value == nullptr ? "" : value);
  std::vector<fs::path> folders;
  for (std::string one; std::getline(listed, one, ':');) {
    if (!one.empty()) folders.push_back((fs::path(one) / "").parent_path());
  }
  return folders;
}

/// Where a package or model may be that is not among those given, in order: where the URDF is, and
/// where ROS finds packages, what is installed before what is built from its sources.
std::vector<fs::path> placesOf(const std::string& name, bool is_package, const std::string& urdf) {
  std::vector<fs::path> places;
  fs::path above = urdf.empty() ? "" : (fs::absolute(urdf) / "x").lexically_normal().parent_path();
  for (; above.has_relative_path(); above = above.parent_path()) {
    if (above.filename() == name) places.push_back(above);
  }
  // Those of the environment themselves, and what is above them, are no packages.
  if (!is_package || name.find_first_not_of('.') == std::string::npos) return places;
  for (const fs::path& prefix : foldersOf("AMENT_PREFIX_PATH")) {
    places.push_back(prefix / "share" / name);
  }
  for (const fs::path& folder : foldersOf("ROS_PACKAGE_PATH")) {
    places.push_back(folder / name);
    if (folder.filename() == name) places.push_back(folder);
  }
  return places;
}

}  // namespace

std::string meshFile(const std::string& name, const std::string& folder,
                     const std::map<std::string, std::string>& packages, const std::string& where) {
  const auto fail = [&](const std::string& fault) {
    throw FileError(where + ": " + name + ": " + fault);
  };
  const auto beside = [&](const fs::path& path) {
    if (folder.empty() && path.is_relative()) {
      fail("is relative to the folder of the URDF, and none is given with the text");
    }
    return (folder / path).lexically_normal().string();
  };
  const std::size_t colon = name.find("://");
  if (colon == std::string::npos) return beside(name);
  const std::string scheme = name.substr(0, colon);
  const std::string rest = decoded(name.substr(colon + 3), where);
  if (scheme == "file") {
    const std::string host = "localhost/";
    return beside(rest.rfind(host, 0) == 0 ? rest.substr(host.size() - 1) : rest);
  }
  if (scheme != "package" && scheme != "model") {
    fail(scheme + ":// is not read here, only file://, package:// and model://");
  }
  const std::size_t end = rest.find('/');
  const std::string package = rest.substr(0, end);
  if (end == std::string::npos) fail("no file of the " + scheme + " " + package);
  const auto given = packages.find(package);
  const bool is_package = scheme == "package";
  const auto places = given != packages.end() ? std::vector<fs::path>{given->second}
                                              : placesOf(package, is_package, folder);
  std::string looked;
  for (const fs::path& place : places) {
    std::error_code error;
    if (fs::is_directory(place, error)) {
      return (place / rest.substr(end + 1)).lexically_normal().string();
    }
    looked += (looked.empty() ? ": there is no " : ", no ") + place.string();
  }
  throw FileError(where + ": " + name + ": no folder is known for the " + scheme + " " + package +
                  ", among those given, around the URDF" +
                  (is_package ? ", in AMENT_PREFIX_PATH or ROS_PACKAGE_PATH" : "") + looked);
}

}  // namespace fcl_prob::detail
