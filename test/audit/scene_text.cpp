// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <sstream>

#include "scene.h"

namespace fcl_prob_audit {
namespace {

const Eigen::IOFormat kRow(17, Eigen::DontAlignCols, ", ", "; ");

void write(std::ostream& out, const char* name, const Member& member) {
  const Shape& s = member.shape;
  out << name << " " << nameOf(s.kind) << " sizes (" << s.sizes.transpose().format(kRow) << ")";
  if (s.isUnbounded()) {
    out << " normal (" << s.normal.transpose().format(kRow) << ") offset " << s.offset;
  }
  if (!s.isOccupied() || s.cost_density != 1.0) {
    out << " cost " << s.cost_density << " occupied from " << s.threshold_occupied << " free to "
        << s.threshold_free;
  }
  out << "\n  pose " << member.pose.matrix().topRows<3>().format(kRow) << "\n";
  if (s.kind == Kind::octree) {
    out << "  resolution " << s.resolution;
    for (const Voxel& v : s.voxels) {
      out << (v.occupied ? " +" : " -") << v.index[0] << "," << v.index[1] << "," << v.index[2];
    }
    out << "\n";
  }
  if (s.kind != Kind::mesh && s.kind != Kind::convex && s.kind != Kind::triangle) return;
  for (const Vector3d& v : s.mesh.vertices) out << "  v " << v.transpose().format(kRow) << "\n";
  for (const auto& t : s.mesh.triangles) {
    out << "  t " << t[0] << " " << t[1] << " " << t[2] << "\n";
  }
}

void write(std::ostream& out, const Displacement& d) {
  out << "displacement sigma (" << d.sigma.transpose().format(kRow) << ") axes w,x,y,z ("
      << d.axes.w() << ", " << d.axes.vec().transpose().format(kRow) << ") mean ("
      << d.mean.transpose().format(kRow) << ")" << (d.by_matrix ? " by matrix" : "");
  if (d.rotated) out << " rotated by " << d.rotated->format(kRow);
  out << "\n";
}

void writeRequest(std::ostream& out, const Scene& scene) {
  const fcl_prob::ProbabilityRequest& r = scene.request;
  out << "method " << toString(r.method)
      << (r.contact == fcl_prob::ContactMeaning::solid ? " solid" : " fcl") << " tolerances "
      << r.relative_tolerance << " " << r.absolute_tolerance << " cells " << r.max_cells
      << " memory " << r.max_memory << " samples " << r.samples << " seed " << r.seed
      << " confidence " << r.confidence << " threads " << r.threads
      << (r.gradient ? " gradient" : "");
  if (r.threshold) out << " threshold " << *r.threshold;
  if (r.time_limit) out << " time limit " << *r.time_limit;
  if (scene.cancel_after) out << " cancelled after " << *scene.cancel_after;
  out << "\n";
}

}  // namespace

std::string nameOf(Kind kind) {
  static const char* const kNames[] = {"box",       "sphere",   "ellipsoid", "capsule",
                                       "cone",      "cylinder", "convex",    "triangle",
                                       "halfspace", "plane",    "mesh",      "octree"};
  return kNames[static_cast<int>(kind)];
}

std::string nameOf(ManagerKind kind) {
  static const char* const kNames[] = {
      "Naive",         "SSaP", "SaP", "IntervalTree", "DynamicAABBTree", "DynamicAABBTree_Array",
      "SpatialHashing"};
  return kNames[static_cast<int>(kind)];
}

std::string textOf(const Scene& scene) {
  std::ostringstream out;
  out.precision(17);
  out << "family " << scene.family << ", seed " << scene.seed << ", index " << scene.index << "\n";
  for (const Member& member : scene.a) write(out, "A", member);
  for (const Member& member : scene.b) write(out, "B", member);
  for (const Displacement& displacement : scene.displacements) write(out, displacement);
  if (!scene.weights.empty()) {
    out << "weights";
    for (const double weight : scene.weights) out << " " << weight;
    out << "\n";
  }
  if (scene.truncation) out << "truncated at " << *scene.truncation << " deviations\n";
  if (scene.question == Question::group) out << "a group\n";
  if (scene.question == Question::batch) out << "a batch of one pose\n";
  if (scene.question == Question::manager) {
    out << "manager " << nameOf(scene.manager.kind) << (scene.manager.within ? " within" : "")
        << " culling " << scene.manager.culling_probability << " registered twice:";
    for (const int i : scene.manager.registered_twice) out << " " << i;
    out << "\n";
  }
  writeRequest(out, scene);
  return out.str();
}

}  // namespace fcl_prob_audit
