// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The formats of point clouds, from memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fcl_prob/point_cloud.h"

namespace fcl_prob::detail {

/// Each throws FileError that begins with `path`: where the file is not of the format, ends early,
/// or claims more than it holds or than the limits allow.
PointCloud readPcd(const std::string& path, std::string_view content, const CloudLimits& limits);
PointCloud readPly(const std::string& path, std::string_view content, const CloudLimits& limits);

/// Either, by the extension of `path`; with a finite point. \throws also InvalidGeometry
PointCloud readCloud(const std::string& path, std::string_view content, const CloudLimits& limits);

/// LZF (Lehmann's liblzf) as PCD files have it. Nothing if the data are broken or do not give
/// exactly `size` bytes. No more than 264 times the input can come of it, which is checked first.
std::optional<std::string> decompressLzf(std::string_view data, std::size_t size);

}  // namespace fcl_prob::detail
