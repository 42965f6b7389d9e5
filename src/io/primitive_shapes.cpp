// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "io/primitive_shapes.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/geometry/shape/sphere.h>

#include <cmath>

namespace fcl_prob::detail {
namespace {

double positive(StrictObject& object, const std::string& key) {
  const double value = object.number(key);
  if (!(value > 0.0) || !std::isfinite(value)) object.fail(key, "must be a length > 0");
  return value;
}

Eigen::Vector3d positiveTriple(StrictObject& object, const std::string& key) {
  const std::vector<double> numbers = object.numbers(key);
  if (numbers.size() != 3) object.fail(key, "must be three lengths");
  const Eigen::Vector3d result(numbers[0], numbers[1], numbers[2]);
  if (!(result.minCoeff() > 0.0) || !result.allFinite()) object.fail(key, "must be lengths > 0");
  return result;
}

/// Radius and length of a Capsule, Cone or Cylinder along z.
template <typename Shape>
PrimitiveShape round(StrictObject& object, const std::string& key) {
  StrictObject shape = object.object(key);
  const double radius = positive(shape, "radius");
  const double length = positive(shape, "length");
  shape.finish();
  return std::make_shared<Shape>(radius, length);
}

/// Unit normal and offset of a Halfspace or Plane: normal·x = offset.
template <typename Shape>
PrimitiveShape flat(StrictObject& object, const std::string& key) {
  StrictObject shape = object.object(key);
  const std::vector<double> numbers = shape.numbers("normal");
  if (numbers.size() != 3) shape.fail("normal", "must be three numbers");
  const Eigen::Vector3d normal(numbers[0], numbers[1], numbers[2]);
  const double length = normal.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length)) shape.fail("normal", "must not be zero");
  const double offset = shape.number("offset");
  shape.finish();
  return std::make_shared<Shape>(Eigen::Vector3d(normal / length), offset);
}

}  // namespace

const std::vector<std::string>& primitiveNames() {
  static const std::vector<std::string> names{"box",  "sphere",   "ellipsoid", "capsule",
                                              "cone", "cylinder", "halfspace", "plane"};
  return names;
}

PrimitiveShape readPrimitive(StrictObject& object, const std::string& name) {
  if (name == "box") return std::make_shared<fcl::Boxd>(positiveTriple(object, name));
  if (name == "sphere") return std::make_shared<fcl::Sphered>(positive(object, name));
  if (name == "ellipsoid") return std::make_shared<fcl::Ellipsoidd>(positiveTriple(object, name));
  if (name == "capsule") return round<fcl::Capsuled>(object, name);
  if (name == "cone") return round<fcl::Coned>(object, name);
  if (name == "cylinder") return round<fcl::Cylinderd>(object, name);
  if (name == "halfspace") return flat<fcl::Halfspaced>(object, name);
  if (name == "plane") return flat<fcl::Planed>(object, name);
  object.fail(name, "unknown primitive");
}

}  // namespace fcl_prob::detail
