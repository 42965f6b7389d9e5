// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "sweep/query_line.h"

#include <boost/crc.hpp>
#include <iomanip>
#include <sstream>

#include "io/quantities.h"
#include "io/scene_parts.h"
#include "io/strict_json.h"

namespace fcl_prob::sweep {
namespace {

using detail::StrictObject;
using Json = nlohmann::json;

/// Runs `convert`, whose exceptions do not know the key.
template <typename Convert>
auto located(StrictObject& object, const std::string& key, const Convert& convert) {
  const detail::Numbers numbers = object.numbers(key);
  try {
    return convert(numbers);
  } catch (const FileError&) {
    throw;
  } catch (const Exception& error) {
    object.fail(key, error.what());
  }
}

/// The shape without its pose, as a text.
std::string shapeKey(Json shape) {
  if (shape.is_object()) shape.erase("pose");
  return shape.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void readShapes(StrictObject& object, const Json& document, const std::filesystem::path& folder,
                QueryLine& query) {
  if (object.has("scene")) {
    const std::string name = object.text("scene");
    if (name.empty()) object.fail("scene", "must not be empty");
    if (object.has("a") || object.has("b")) object.fail("scene", "stands beside a or b");
    query.scene_file = (folder / name).lexically_normal().string();
    return;
  }
  query.a = detail::readObject(object.object("a"), folder);
  query.b = detail::readObject(object.object("b"), folder);
  query.shapes_key = shapeKey(document.at("a")) + shapeKey(document.at("b"));
}

void readRandomness(StrictObject& object, QueryLine& query) {
  if (object.has("pose_error") && object.has("displacement")) {
    object.fail("pose_error", "stands beside displacement");
  }
  if (object.has("displacement")) {
    query.displacement = detail::readDisplacement(object.object("displacement"));
  } else if (object.has("pose_error")) {
    query.pose_error = detail::readPoseError(object.object("pose_error"));
  } else if (query.scene_file.empty()) {
    object.fail("displacement", "missing, and so is pose_error");
  }
  if (object.has("mean")) {
    if (query.displacement || query.pose_error) {
      object.fail("mean", "belongs into displacement or pose_error");
    }
    query.mean = located(object, "mean",
                         [](const auto& numbers) { return detail::vectorFrom(numbers, "it"); });
  }
}

}  // namespace

std::string checksumOf(const NumberedLine& line) {
  boost::crc_32_type crc;
  crc.process_bytes(line.text.data(), line.text.size());
  std::ostringstream text;
  text << std::hex << std::setw(8) << std::setfill('0') << crc.checksum();
  return text.str();
}

void readQueryLine(const NumberedLine& line, const std::filesystem::path& folder,
                   QueryLine& query) {
  const std::string where = "line " + std::to_string(line.number);
  if (line.too_long) throw FileError(where + ": too long");
  const Json document = detail::parseJson(line.text, where);
  StrictObject object(document, where);
  if (object.has("id")) {
    const Json& id = document.at("id");
    query.id = id.is_number() ? Json(object.count("id")) : Json(object.text("id"));
  }
  readShapes(object, document, folder, query);
  query.pose_a = detail::readPose(object, "pose_a");
  query.pose_b = detail::readPose(object, "pose_b");
  readRandomness(object, query);
  if (object.has("request")) {
    detail::readRequest(object.object("request"));
    query.request = document.at("request");
  }
  object.finish();
}

Scene sceneOf(const QueryLine& query, Scene base) {
  if (query.a) base.a = *query.a;
  if (query.b) base.b = *query.b;
  if (query.pose_a) base.a.pose = *query.pose_a;
  if (query.pose_b) base.b.pose = *query.pose_b;
  if (query.displacement) {
    base.displacement = *query.displacement;
    base.pose_error.reset();
  } else if (query.pose_error) {
    setPoseError(*query.pose_error, base);
  } else if (query.mean) {
    if (base.pose_error) throw FileError("mean: the scene has a pose_error");
    base.displacement = base.displacement.withMean(*query.mean);
  } else if (base.pose_error) {
    setPoseError(*base.pose_error, base);
  }
  if (!query.request.is_null()) {
    base.request = detail::readRequest(StrictObject(query.request, "request"), base.request);
  }
  if (base.a.possible || base.b.possible) {
    throw FileError("cloud: what was made of a cloud is for `fcl_prob check`, not for sweeps");
  }
  base.request.band_a = base.a.band;
  base.request.band_b = base.b.band;
  return base;
}

}  // namespace fcl_prob::sweep
