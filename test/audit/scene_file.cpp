// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "scene_file.h"

#include <fstream>
#include <sstream>

namespace fcl_prob_audit {
namespace {

std::ofstream opened(const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  return out;
}

bool isExpressible(const Member& member) {
  const Shape& shape = member.shape;
  return shape.kind != Kind::convex && shape.kind != Kind::triangle && shape.kind != Kind::octree &&
         shape.isOccupied();
}

bool isExpressible(const Scene& scene) {
  return scene.question == Question::pair && scene.weights.empty() && !scene.truncation &&
         !scene.cancel_after && scene.displacements.size() == 1 && scene.a.size() == 1 &&
         scene.b.size() == 1 && !scene.displacements[0].rotated &&
         !scene.displacements[0].by_matrix && isExpressible(scene.a[0]) &&
         isExpressible(scene.b[0]);
}

std::string list(const Vector3d& v) {
  std::ostringstream out;
  out.precision(17);
  out << "[" << v[0] << ", " << v[1] << ", " << v[2] << "]";
  return out.str();
}

void writeMesh(const TriangleMesh& mesh, const std::string& path) {
  std::ofstream out = opened(path);
  out << "OFF\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  for (const Vector3d& v : mesh.vertices) out << v[0] << " " << v[1] << " " << v[2] << "\n";
  for (const auto& t : mesh.triangles) out << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
}

std::string objectText(const Member& member, const std::string& folder, const std::string& file) {
  const Shape& s = member.shape;
  std::ostringstream out;
  out.precision(17);
  out << "{ ";
  switch (s.kind) {
    case Kind::box:
    case Kind::ellipsoid:
      out << "\"" << nameOf(s.kind) << "\": " << list(s.sizes);
      break;
    case Kind::sphere:
      out << "\"sphere\": " << s.sizes[0];
      break;
    case Kind::halfspace:
    case Kind::plane:
      out << "\"" << nameOf(s.kind) << "\": {\"normal\": " << list(s.normal)
          << ", \"offset\": " << s.offset << "}";
      break;
    case Kind::mesh:
      writeMesh(s.mesh, folder + "/" + file);
      out << "\"mesh\": \"" << file << "\"";
      break;
    default:
      out << "\"" << nameOf(s.kind) << "\": {\"radius\": " << s.sizes[0]
          << ", \"length\": " << s.sizes[1] << "}";
  }
  const Eigen::Quaterniond q(Matrix3d(member.pose.linear()));
  const Vector3d t = member.pose.translation();
  out << ", \"pose\": [" << t[0] << ", " << t[1] << ", " << t[2] << ", " << q.w() << ", " << q.x()
      << ", " << q.y() << ", " << q.z() << "] }";
  return out.str();
}

void writeJson(const Scene& scene, const std::string& folder, const std::string& name) {
  std::ofstream out = opened(folder + "/" + name + ".json");
  const Displacement& d = scene.displacements[0];
  const fcl_prob::ProbabilityRequest& r = scene.request;
  out << "{\n  \"description\": \"" << scene.family << ", seed " << scene.seed << ", index "
      << scene.index << "\",\n  \"a\": " << objectText(scene.a[0], folder, name + "_a.off")
      << ",\n  \"b\": " << objectText(scene.b[0], folder, name + "_b.off")
      << ",\n  \"displacement\": { \"sigma\": " << list(d.sigma) << ", \"sigma_axes\": ["
      << d.axes.w() << ", " << d.axes.x() << ", " << d.axes.y() << ", " << d.axes.z()
      << "], \"mean\": " << list(d.mean) << " },\n  \"request\": { \"method\": \""
      << toString(r.method) << "\", \"contact\": \""
      << (r.contact == fcl_prob::ContactMeaning::solid ? "solid" : "fcl")
      << "\", \"relative_tolerance\": " << r.relative_tolerance
      << ", \"absolute_tolerance\": " << r.absolute_tolerance;
  if (r.threshold) out << ", \"threshold\": " << *r.threshold;
  if (r.time_limit) out << ", \"time_limit\": " << *r.time_limit;
  out << ", \"samples\": " << r.samples << ", \"seed\": " << r.seed << " }\n}\n";
}

}  // namespace

std::string writeScene(const Scene& scene, const std::string& folder, const std::string& name,
                       const std::string& what) {
  opened(folder + "/" + name + ".txt") << what << "\n" << textOf(scene);
  if (isExpressible(scene)) {
    writeJson(scene, folder, name);
    return "fcl_prob check --scene " + folder + "/" + name + ".json" +
           (scene.request.gradient ? " --gradient" : "");
  }
  return "audit --seed " + std::to_string(scene.seed) + " --index " + std::to_string(scene.index) +
         " --family '" + scene.family + "'";
}

}  // namespace fcl_prob_audit
