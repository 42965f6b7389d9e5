// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is looked at before a URDF or SRDF reaches an XML parser.
#pragma once

#include <urdf_world/types.h>

#include <cstddef>
#include <string>

namespace fcl_prob::detail {

/// Of a URDF or SRDF.
inline constexpr std::size_t kMostXmlBytes = std::size_t{16} << 20;

/// The model that a file describes. \throws FileError
urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& path);

/// \throws FileError for a document type (entities could grow without end) or elements that are
///         nested too deeply for a parser that recurses
void checkXmlText(const std::string& text, const std::string& path);

}  // namespace fcl_prob::detail
