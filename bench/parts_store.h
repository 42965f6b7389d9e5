// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Convex parts of meshes that several scenes and several runs share.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "fcl_prob/convex_parts.h"

namespace fcl_prob::cli {

/// Each mesh is decomposed once. With a folder its parts are also kept in a file, which is named by
/// a hash of the mesh and the request: their cover is proven whenever they are read, so that a file
/// that was changed is of no use, and no harm. Parts that were read are by a rounding larger than
/// those that were found.
class PartsStore {
 public:
  /// \param folder  made if it is not there; empty: nothing is kept
  explicit PartsStore(std::string folder = {}) : folder_(std::move(folder)) {}

  const ConvexParts& of(const std::shared_ptr<const fcl::CollisionGeometryd>& mesh,
                        const DecompositionRequest& request);

  std::size_t found() const { return found_; }  ///< meshes that were decomposed
  double foundMs() const { return found_ms_; }  ///< milliseconds that it took
  std::size_t read() const { return known_.size() - found_; }

 private:
  std::map<std::shared_ptr<const fcl::CollisionGeometryd>, ConvexParts> known_;
  std::string folder_;
  std::size_t found_ = 0;
  double found_ms_ = 0.0;
};

}  // namespace fcl_prob::cli
