// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <octomap/octomap.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "fcl_prob/exceptions.h"
#include "fcl_prob/octomap_io.h"
#include "io/file_content.h"
#include "io/octomap_check.h"
#include "io/text_reader.h"

namespace fcl_prob {
namespace detail {
namespace {

constexpr std::size_t kLargestFile = std::size_t{1} << 30;
constexpr int kDeepest = 16;
constexpr double kMostUnknownCells = 2e6;

/// Walks over the nodes of a tree as OctoMap writes them, depth first.
class OctomapWalk {
 public:
  OctomapWalk(const std::string& path, std::string_view body) : path_(path), body_(body) {}

  void run(bool binary) {
    binary ? inner(0) : full(0);
    if (at_ != body_.size()) fail("bytes behind its end");
  }

 private:
  // Two bits for each child: 3 is an inner node, which follows.
  void inner(int depth) {
    const unsigned bits = byte() | byte() << 8U;
    for (unsigned child = 0; child < 8; ++child) {
      if ((bits >> 2U * child & 3U) != 3U) continue;
      if (depth + 1 >= kDeepest) fail("a tree of more than 16 levels");
      inner(depth + 1);
    }
  }

  // A float, and one bit for each child that follows.
  void full(int depth) {
    float value;
    if (body_.size() - at_ < sizeof value) fail("the data end within the tree");
    std::memcpy(&value, body_.data() + at_, sizeof value);
    at_ += sizeof value;
    if (!std::isfinite(value)) fail("an occupancy that is not finite");
    const unsigned bits = byte();
    if (bits != 0 && depth >= kDeepest) fail("a tree of more than 16 levels");
    for (unsigned child = 0; child < 8; ++child) {
      if ((bits >> child & 1U) != 0) full(depth + 1);
    }
  }

  unsigned byte() {
    if (at_ >= body_.size()) fail("the data end within the tree");
    return static_cast<unsigned char>(body_[at_++]);
  }

  [[noreturn]] void fail(const std::string& fault) const { throw FileError(path_ + ": " + fault); }

  const std::string& path_;
  std::string_view body_;
  std::size_t at_ = 0;
};

void addUnknown(const std::string& path, octomap::OcTree& map) {
  double lo[3], hi[3];
  map.getMetricMin(lo[0], lo[1], lo[2]);
  map.getMetricMax(hi[0], hi[1], hi[2]);
  double cells = 1.0;
  for (int k = 0; k < 3; ++k) cells *= (hi[k] - lo[k]) / map.getResolution();
  if (!(cells <= kMostUnknownCells)) {
    throw FileError(path +
                    ": a box of more than two million cells around the map: too many to take "
                    "the unknown ones for occupied");
  }
  octomap::point3d_list centers;
  const auto point = [](const double* p) {
    return octomap::point3d(static_cast<float>(p[0]), static_cast<float>(p[1]),
                            static_cast<float>(p[2]));
  };
  map.getUnknownLeafCenters(centers, point(lo), point(hi));
  for (const octomap::point3d& center : centers) {
    map.setNodeValue(center, map.getClampingThresMaxLog(), true);
  }
  map.updateInnerOccupancy();
  map.prune();
}

}  // namespace

bool checkOctomap(const std::string& path, std::string_view content) {
  LineReader reader(content);
  const auto fail = [&](const std::string& fault) -> void {
    throw FileError(path + ": line " + std::to_string(reader.lineNumber()) + ": " + fault);
  };
  const auto first = reader.next();
  const bool binary = first && first->substr(0, 28) == "# Octomap OcTree binary file";
  if (!binary && !(first && first->substr(0, 21) == "# Octomap OcTree file")) {
    fail("not an OctoMap file of an OcTree");
  }
  bool has_resolution = false, is_octree = false;
  for (auto line = reader.next();; line = reader.next()) {
    if (!line) fail("the header has no data");
    const std::vector<std::string_view> words = splitWords(*line);
    if (words.empty() || words[0].front() == '#') continue;
    if (words[0] == "data") break;
    if (words.size() != 2) fail("not an OctoMap header line");
    if (words[0] == "id") is_octree = words[1] == "OcTree";
    if (words[0] == "size" && !parseInteger(words[1])) fail("size " + inQuotes(words[1]));
    if (words[0] == "res") {
      const std::optional<double> resolution = parseNumber(words[1]);
      has_resolution = resolution && *resolution >= 1e-6 && *resolution <= 1e6;
    }
  }
  if (!is_octree) fail("id is not OcTree");
  if (!has_resolution) fail("no resolution from 1e-6 to 1e6 m");
  const std::string_view body = content.substr(reader.position());
  if (body.empty()) fail("the map is empty");
  OctomapWalk(path, body).run(binary);
  return binary;
}

}  // namespace detail

std::shared_ptr<fcl::OcTreed> loadOctomap(const std::string& path, UnknownCells unknown) {
  const std::string content = detail::fileContent(path, detail::kLargestFile);
  const bool binary = detail::checkOctomap(path, content);
  std::istringstream stream(content);
  std::shared_ptr<octomap::OcTree> map;
  if (binary) {
    map = std::make_shared<octomap::OcTree>(1.0);
    if (!map->readBinary(stream)) throw FileError(path + ": OctoMap cannot read it");
  } else {
    const std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(stream));
    auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
    if (tree == nullptr) throw FileError(path + ": OctoMap cannot read it");
    map = std::make_shared<octomap::OcTree>(*tree);
  }
  if (map->size() == 0) throw FileError(path + ": the map is empty");
  if (unknown == UnknownCells::occupied) detail::addUnknown(path, *map);
  return std::make_shared<fcl::OcTreed>(map);
}

Band bandOf(const fcl::OcTreed& map) {
  // A leaf at the deepest level is as wide as the map's resolution.
  fcl::AABBd box = map.getRootBV();
  const double resolution = (box.max_[0] - box.min_[0]) / 65536.0;
  return {resolution, std::sqrt(3.0) * resolution};
}

}  // namespace fcl_prob
