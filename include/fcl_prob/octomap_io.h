// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Occupancy maps from files. In the library fcl_prob::io.
#pragma once

#include <memory>
#include <string>

#include <fcl/geometry/octree/octree.h>

#include "fcl_prob/band.h"

namespace fcl_prob {

/// What is made of cells that a map says nothing about, within the box around those that it knows.
enum class UnknownCells { free, occupied };

/// Reads a .bt or .ot file of OctoMap. What the file claims is held against its bytes first.
/// \throws FileError; the message begins with `path`
std::shared_ptr<fcl::OcTreed> loadOctomap(const std::string& path,
                                          UnknownCells unknown = UnknownCells::free);

/// A map's resolution r as a band: a cell is occupied where something is in it or was taken to be,
/// so that outwards r is allowed for; what is in it may be anywhere in it: √3 r inwards.
Band bandOf(const fcl::OcTreed& map);

}  // namespace fcl_prob
