// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What is looked at before a URDF or SRDF reaches an XML parser.
#pragma once

#include <urdf_world/types.h>

#include <boost/property_tree/ptree_fwd.hpp>
#include <cstddef>
#include <string>

namespace fcl_prob::detail {

/// Of a URDF or SRDF.
inline constexpr std::size_t kMostXmlBytes = std::size_t{16} << 20;

/// The model that a file describes. \throws FileError, also where urdfdom would go on without what
/// it cannot read: a collision element that is left out could collide
urdf::ModelInterfaceSharedPtr parseUrdf(const std::string& path);

/// \throws FileError for a document type (entities could grow without end) or elements that are
///         nested too deeply for a parser that recurses
void checkXmlText(const std::string& text, const std::string& path);

/// The elements of a text that passes checkXmlText() and has one element robot.
/// \param what  URDF or SRDF, for messages
/// \throws FileError
boost::property_tree::ptree parseXml(const std::string& text, const std::string& path,
                                     const std::string& what);

}  // namespace fcl_prob::detail
