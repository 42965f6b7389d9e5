// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Scenes that many queries ask about: read, loaded and prepared once.
#pragma once

#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/pose_probability.h"
#include "sweep/query_line.h"

namespace fcl_prob::sweep {

/// Values that are made once, by whoever needs them first; whatever goes wrong then is remembered,
/// too. May be used by several threads.
template <class Value>
class MadeOnce {
 public:
  using Pointer = std::shared_ptr<const Value>;

  /// \param make  a Pointer \throws what `make` throws, every time
  template <class Make>
  Pointer get(const std::string& key, const Make& make) {
    const std::shared_ptr<Entry> entry = entryOf(key);
    std::call_once(entry->once, [&] {
      try {
        entry->value = make();
      } catch (...) {
        entry->failure = std::current_exception();
      }
    });
    if (entry->failure) std::rethrow_exception(entry->failure);
    return entry->value;
  }

 private:
  struct Entry {
    std::once_flag once;
    Pointer value;
    std::exception_ptr failure;
  };

  /// So that shapes that are all different do not fill the memory.
  static constexpr std::size_t kMost = 4096;

  std::shared_ptr<Entry> entryOf(const std::string& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (entries_.size() >= kMost && entries_.count(key) == 0) entries_.clear();
    std::shared_ptr<Entry>& entry = entries_[key];
    if (!entry) entry = std::make_shared<Entry>();
    return entry;
  }

  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Entry>> entries_;
};

/// Two geometries, prepared for both kinds of errors when the first of it comes.
class PreparedPair {
 public:
  PreparedPair(std::shared_ptr<const fcl::CollisionGeometryd> a,
               std::shared_ptr<const fcl::CollisionGeometryd> b)
      : a_(std::move(a)), b_(std::move(b)), query_(a_, b_) {}

  ProbabilityResult answer(const Scene& scene, const ProbabilityRequest& request) const;

 private:
  std::shared_ptr<const fcl::CollisionGeometryd> a_;
  std::shared_ptr<const fcl::CollisionGeometryd> b_;
  PreparedQuery query_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<PreparedPoseQuery> pose_query_;
};

/// A scene and the pair of its geometries.
struct SceneWithPair {
  Scene scene;
  std::shared_ptr<const PreparedPair> pair;
};

/// All of them. May be used by several threads.
class PreparedScenes {
 public:
  /// The scene as the query wants it. \throws what loading and preparing throw
  SceneWithPair of(const QueryLine& query);

  /// Reads the meshes that the query needs, which then are there for of(). Whatever goes wrong is
  /// left to of().
  void loadMeshes(const QueryLine& query);

 private:
  using Geometry = std::shared_ptr<const fcl::CollisionGeometryd>;
  Geometry geometryOf(const SceneObject& object);
  void loadMesh(const SceneObject& object);
  std::shared_ptr<const Scene> sceneOfFile(const std::string& path);

  MadeOnce<fcl::CollisionGeometryd> meshes_;
  MadeOnce<Scene> scenes_;  // of files
  MadeOnce<PreparedPair> pairs_of_files_;
  MadeOnce<PreparedPair> pairs_;  // of shapes in the lines themselves
};

}  // namespace fcl_prob::sweep
