// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Point clouds and occupancy maps: the first byte says which kind, the rest is the file.
#include <boost/algorithm/string/predicate.hpp>
#include <cstddef>
#include <cstdint>

#include "cloud/cloud_files.h"
#include "fcl_prob/exceptions.h"
#include "fuzz_tally.h"
#include "io/octomap_check.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

void readWhole(const std::string& name, std::string_view content) {
  CloudLimits limits;
  limits.points = std::size_t{1} << 16;
  if (boost::ends_with(name, ".bt")) {
    detail::checkOctomap(name, content);
    return;
  }
  const PointCloud cloud = detail::readCloud(name, content, limits);
  require(cloud.points.size() == cloud.width * cloud.height, "points that are no image");
  require(cloud.points.size() <= limits.points, "more points than allowed");
  // No point takes less than a byte and no byte gives more than 264.
  require(cloud.points.size() <= 264 * content.size(), "points out of nothing");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("cloud files");
  if (size < 1) return 0;
  tally.count("inputs");
  constexpr const char* kNames[] = {"fuzz.pcd", "fuzz.ply", "fuzz.bt"};
  const std::string name = kNames[data[0] % 3];
  const std::string_view content(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    readWhole(name, content);
    tally.count("read");
  } catch (const Exception& error) {
    require(boost::starts_with(error.what(), name), "a message without the file's name");
  }
  return 0;
}
