// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/geometry.h"

#include <map>

#include "cli/tree_pair.h"

namespace fcl_prob::cli {
namespace {

template <class BV>
Geometry build(const TriangleMesh& mesh) {
  return buildModel<BV>(mesh);
}

using Builder = Geometry (*)(const TriangleMesh&);

const std::map<std::string, Builder>& builders() {
  static const std::map<std::string, Builder> all{
      {"obb", build<fcl::OBBd>},         {"aabb", build<fcl::AABBd>},
      {"rss", build<fcl::RSSd>},         {"obbrss", build<fcl::OBBRSSd>},
      {"kios", build<fcl::kIOSd>},       {"kdop16", build<fcl::KDOPd<16>>},
      {"kdop18", build<fcl::KDOPd<18>>}, {"kdop24", build<fcl::KDOPd<24>>}};
  return all;
}

}  // namespace

const std::vector<std::string>& boundingVolumeNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& [name, builder] : builders()) result.push_back(name);
    const std::vector<std::string>& own = ownVolumeNames();
    result.insert(result.end(), own.begin(), own.end());
    return result;
  }();
  return names;
}

Geometry buildTree(const TriangleMesh& mesh, const std::string& bounding_volume) {
  const auto position = builders().find(bounding_volume);
  if (position == builders().end()) {
    throw InvalidRequest("unknown bounding volume '" + bounding_volume + "'");
  }
  return position->second(mesh);
}

LoadedObject loadObject(const SceneObject& object) {
  LoadedObject result;
  result.pose = object.pose;
  if (const auto* mesh = std::get_if<MeshFile>(&object.shape)) {
    result.shape = mesh->read();
  } else {
    result.shape = std::get<PrimitiveShape>(object.shape);
  }
  if (object.possible) {
    result.possible = object.possible->read();
    result.possible_is_solid = object.possible_is_solid;
  }
  return result;
}

Geometry buildGeometry(const LoadedObject& object, const std::string& bounding_volume) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&object.shape)) {
    return buildTree(*mesh, bounding_volume);
  }
  return std::get<PrimitiveShape>(object.shape);
}

}  // namespace fcl_prob::cli
