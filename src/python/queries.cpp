// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <pybind11/stl.h>

#include <mutex>
#include <sstream>

#include "fcl_prob/collision_probability.h"
#include "fcl_prob/exceptions.h"
#include "fcl_prob/group.h"
#include "fcl_prob/mixture.h"
#include "fcl_prob/pose_probability.h"
#include "python/arrays.h"
#include "python/displacements.h"
#include "python/geometries.h"
#include "python/request.h"
#include "python/results.h"
#include "python/running.h"

namespace fcl_prob::python {
namespace {

/// A pair of geometries, prepared for every kind of displacement when the first of it comes.
class Pair {
 public:
  Pair(Geometry a, Geometry b) : a_(std::move(a)), b_(std::move(b)) {}

  /// Where nothing is prepared in advance, as C++ does it for a single call.
  void answerOnce(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
                  const Randomness& randomness, const ProbabilityRequest& request,
                  ProbabilityResult& result) const {
    if (const auto* gaussian = std::get_if<GaussianDisplacement>(&randomness)) {
      collisionProbability(a_.get(), pose_a, b_.get(), pose_b, *gaussian, request, result);
    } else if (const auto* error = std::get_if<PoseError>(&randomness)) {
      collisionProbability(a_.get(), pose_a, b_.get(), pose_b, *error, request, result);
    } else {
      answer(pose_a, pose_b, randomness, request, result);
    }
  }

  void answer(const fcl::Transform3d& pose_a, const fcl::Transform3d& pose_b,
              const Randomness& randomness, const ProbabilityRequest& request,
              ProbabilityResult& result) const {
    if (const auto* error = std::get_if<PoseError>(&randomness)) {
      poseQuery().collisionProbability(pose_a, pose_b, *error, request, result);
    } else if (const auto* gaussian = std::get_if<GaussianDisplacement>(&randomness)) {
      query().collisionProbability(pose_a, pose_b, *gaussian, request, result);
    } else if (const auto* mixture = std::get_if<GaussianMixture>(&randomness)) {
      collisionProbability(query(), pose_a, pose_b, *mixture, request, result);
    } else {
      collisionProbability(query(), pose_a, pose_b, std::get<TruncatedGaussian>(randomness),
                           request, result);
    }
  }

  /// Checks both geometries. \throws InvalidGeometry, UnsupportedGeometry
  const PreparedQuery& query() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!query_) query_ = std::make_unique<PreparedQuery>(a_, b_);
    return *query_;
  }

  const PreparedPoseQuery& poseQuery() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!pose_query_) pose_query_ = std::make_unique<PreparedPoseQuery>(a_, b_);
    return *pose_query_;
  }

 private:
  Geometry a_;
  Geometry b_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<PreparedQuery> query_;
  mutable std::unique_ptr<PreparedPoseQuery> pose_query_;
};

ProbabilityResult askOnce(const py::object& a, const py::object& b, const py::object& displacement,
                          const py::object& pose_a, const py::object& pose_b,
                          const py::kwargs& request) {
  const Pair pair(geometryFrom(a, "a"), geometryFrom(b, "b"));
  const Randomness randomness = randomnessFrom(displacement, "displacement");
  const fcl::Transform3d at_a = poseFrom(pose_a, "pose_a");
  const fcl::Transform3d at_b = poseFrom(pose_b, "pose_b");
  return answer(questionFrom(request), [&](const auto& of, ProbabilityResult& result) {
    pair.answerOnce(at_a, at_b, randomness, of, result);
  });
}

py::tuple certify(const py::object& a, const py::object& b, const py::object& displacement,
                  const py::object& pose_a, const py::object& pose_b, const py::kwargs& request) {
  const Randomness randomness = randomnessFrom(displacement, "displacement");
  const auto* gaussian = std::get_if<GaussianDisplacement>(&randomness);
  if (!gaussian) throw UnsupportedGeometry("no certificate of a displacement that is not Gaussian");
  const GroupQuery groups({geometryFrom(a, "a")}, {geometryFrom(b, "b")});
  const fcl::Transform3d at_a = poseFrom(pose_a, "pose_a");
  const fcl::Transform3d at_b = poseFrom(pose_b, "pose_b");
  std::ostringstream certificate;
  ProbabilityResult found =
      answer(questionFrom(request), [&](const auto& of, ProbabilityResult& result) {
        groups.certifiedProbability({at_a}, {at_b}, *gaussian, of, certificate, result);
      });
  return py::make_tuple(std::move(found), certificate.str());
}

ProbabilityResult ask(const Pair& pair, const py::object& displacement, const py::object& pose_a,
                      const py::object& pose_b, const py::kwargs& request) {
  const Randomness randomness = randomnessFrom(displacement, "displacement");
  const fcl::Transform3d at_a = poseFrom(pose_a, "pose_a");
  const fcl::Transform3d at_b = poseFrom(pose_b, "pose_b");
  return answer(questionFrom(request), [&](const auto& of, ProbabilityResult& result) {
    pair.answer(at_a, at_b, randomness, of, result);
  });
}

/// How many queries there are, of what there is one or n of.
class Count {
 public:
  void mayBe(std::size_t count, bool many, const char* name) {
    if (!many) return;
    if (many_ && count != count_) {
      throw py::value_error("there are " + std::to_string(count_) + " of " + name_ + ", but " +
                            std::to_string(count) + " of " + name);
    }
    many_ = true;
    count_ = count;
    name_ = name;
  }
  std::size_t value() const { return count_; }

 private:
  std::size_t count_ = 1;
  bool many_ = false;
  std::string name_;
};

BatchArrays askAll(const Pair& pair, const py::object& displacement, const py::object& pose_a,
                   const py::object& pose_b, const py::object& covariances, const py::object& means,
                   const std::string& convention, const py::kwargs& request) {
  Question question = questionFrom(request);
  const ManyDisplacements randomness =
      displacementsFrom(displacement, covariances, means, convention);
  const Poses poses_a(pose_a, "pose_a");
  const Poses poses_b(pose_b, "pose_b");
  Count count;
  count.mayBe(poses_a.size(), poses_a.areMany(), "pose_a");
  count.mayBe(poses_b.size(), poses_b.areMany(), "pose_b");
  count.mayBe(randomness.all.size(), randomness.many, "displacements");
  const auto one = [&](std::size_t i, const ProbabilityRequest& of, ProbabilityResult& result) {
    pair.answer(poses_a.at(i), poses_b.at(i), randomness.at(i), of, result);
  };
  return {answerAll(count.value(), std::move(question), one,
                    [](const Answers& answers) { return py::cast(BatchArrays{answers}); })};
}

BatchArrays askAllOnce(const py::object& a, const py::object& b, const py::object& displacement,
                       const py::object& pose_a, const py::object& pose_b,
                       const py::object& covariances, const py::object& means,
                       const std::string& convention, const py::kwargs& request) {
  const Pair pair(geometryFrom(a, "a"), geometryFrom(b, "b"));
  return askAll(pair, displacement, pose_a, pose_b, covariances, means, convention, request);
}

std::shared_ptr<Pair> preparedPair(const py::object& a, const py::object& b) {
  auto pair = std::make_shared<Pair>(geometryFrom(a, "a"), geometryFrom(b, "b"));
  const py::gil_scoped_release released;
  pair->query();
  return pair;
}

// Groups.

/// Two groups; their configurations (errors of poses) are prepared when the first of them comes.
class Groups {
 public:
  Groups(std::vector<Geometry> a, std::vector<Geometry> b)
      : a_(std::move(a)), b_(std::move(b)), query_(a_, b_) {}

  void answer(const std::vector<fcl::Transform3d>& poses_a,
              const std::vector<fcl::Transform3d>& poses_b, const fcl::Transform3d& frame,
              const Randomness& randomness, const ProbabilityRequest& request,
              ProbabilityResult& result) const {
    if (const auto* error = std::get_if<PoseError>(&randomness)) {
      const RandomPoses random({poses_a, frame, *error},
                               {poses_b, fcl::Transform3d::Identity(), PoseError()});
      configurations().collisionProbability(random, request, result);
    } else if (const auto* gaussian = std::get_if<GaussianDisplacement>(&randomness)) {
      query_.collisionProbability(poses_a, poses_b, *gaussian, request, result);
    } else if (const auto* mixture = std::get_if<GaussianMixture>(&randomness)) {
      collisionProbability(query_, poses_a, poses_b, *mixture, request, result);
    } else {
      collisionProbability(query_, poses_a, poses_b, std::get<TruncatedGaussian>(randomness),
                           request, result);
    }
  }

  MotionGradient gradient(const std::vector<fcl::Transform3d>& poses_a,
                          const std::vector<fcl::Transform3d>& poses_b,
                          const GaussianDisplacement& displacement,
                          const MemberVelocities& velocities,
                          const MotionGradientRequest& request) const {
    return query_.motionGradient(poses_a, poses_b, displacement, velocities, request);
  }

  std::size_t sizeA() const { return a_.size(); }
  std::size_t sizeB() const { return b_.size(); }

 private:
  const ConfigurationQuery& configurations() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!configurations_) configurations_ = std::make_unique<ConfigurationQuery>(a_, b_);
    return *configurations_;
  }

  std::vector<Geometry> a_;
  std::vector<Geometry> b_;
  GroupQuery query_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<ConfigurationQuery> configurations_;
};

std::vector<fcl::Transform3d> groupPoses(const py::object& value, std::size_t members,
                                         const char* name) {
  if (value.is_none()) return std::vector<fcl::Transform3d>(members, fcl::Transform3d::Identity());
  const Poses poses(value, name);
  if (!poses.areMany() || poses.size() != members) {
    throw py::value_error(std::string(name) + " must be " + std::to_string(members) +
                          " poses, one a member, not " +
                          (poses.areMany() ? std::to_string(poses.size()) : "a single one"));
  }
  return poses.all();
}

ProbabilityResult askGroups(const Groups& groups, const py::object& displacement,
                            const py::object& poses_a, const py::object& poses_b,
                            const py::object& frame, const py::kwargs& request) {
  const Randomness randomness = randomnessFrom(displacement, "displacement");
  const auto at_a = groupPoses(poses_a, groups.sizeA(), "poses_a");
  const auto at_b = groupPoses(poses_b, groups.sizeB(), "poses_b");
  const fcl::Transform3d of_frame = poseFrom(frame, "frame");
  if (!frame.is_none() && !std::holds_alternative<PoseError>(randomness)) {
    throw py::type_error("frame belongs to a PoseError, not to a displacement");
  }
  return answer(questionFrom(request), [&](const auto& of, ProbabilityResult& result) {
    groups.answer(at_a, at_b, of_frame, randomness, of, result);
  });
}

/// None: every member by itself. (members, 6, k).
MemberVelocities velocitiesFrom(const py::object& value, std::size_t members) {
  if (value.is_none()) return rigidMotions(members);
  const Numbers numbers(value, "velocities");
  if (!numbers.hasShape({static_cast<std::ptrdiff_t>(members), 6, -1})) {
    numbers.refuseShape("(" + std::to_string(members) + ", 6, k), a matrix a member");
  }
  MemberVelocities all(members, Eigen::MatrixXd(6, numbers.size(2)));
  for (std::size_t i = 0; i < members; ++i) {
    for (std::size_t j = 0; j < 6; ++j) {
      for (std::size_t k = 0; k < numbers.size(2); ++k) all[i](j, k) = numbers.at(i, j, k);
    }
  }
  return all;
}

MotionGradient motionGradient(const Groups& groups, const py::object& displacement,
                              const py::object& poses_a, const py::object& poses_b,
                              const py::object& velocities, const py::object& contact,
                              std::size_t lines, std::uint64_t seed, unsigned threads,
                              const std::optional<double>& time_limit,
                              const py::object& on_progress) {
  const auto at_a = groupPoses(poses_a, groups.sizeA(), "poses_a");
  const auto at_b = groupPoses(poses_b, groups.sizeB(), "poses_b");
  const Randomness randomness = randomnessFrom(displacement, "displacement");
  const auto* gaussian = std::get_if<GaussianDisplacement>(&randomness);
  if (!gaussian) throw py::type_error("displacement must be a GaussianDisplacement");
  const MemberVelocities moving = velocitiesFrom(velocities, groups.sizeA());
  MotionGradientRequest request;
  request.contact = contactFrom(contact);
  request.lines = lines;
  request.seed = seed;
  request.threads = threads;
  request.time_limit = time_limit;
  return runRequest<MotionGradient, MotionGradientRequest>(
      request, progressFrom(on_progress), [&](const MotionGradientRequest& of) {
        return groups.gradient(at_a, at_b, *gaussian, moving, of);
      });
}

void bindGradient(py::module_& module) {
  using G = MotionGradient;
  py::class_<G>(module, "MotionGradient",
                "P of a group, and how it changes as its members move: estimates.")
      .def_property_readonly("probability", [](const G& g) { return g.probability; })
      .def_property_readonly("standard_error", [](const G& g) { return g.standard_error; })
      .def_property_readonly(
          "gradient", [](const G& g) { return vectorArray(g.gradient); },
          "(k,) float64, by parameter; of members by themselves six each: along the world's axes,\n"
          "1/metre, and turned about axes through its origin, 1/radian.")
      .def_property_readonly("gradient_standard_error",
                             [](const G& g) { return vectorArray(g.gradient_standard_error); })
      .def_property_readonly(
          "lines", [](const G& g) { return g.lines; }, "Random lines that were drawn.")
      .def_property_readonly(
          "status", [](const G& g) { return toString(g.status); },
          "'sampled', 'time-limit' or 'cancelled'; 'exact' where nothing was to be drawn.")
      .def("__repr__", [](const G& g) {
        return "<MotionGradient by " + std::to_string(g.gradient.size()) + " parameters, " +
               std::to_string(g.lines) + " lines>";
      });
}

std::shared_ptr<Groups> preparedGroups(const py::object& a, const py::object& b) {
  std::vector<Geometry> of_a = geometriesFrom(a, "group_a");
  std::vector<Geometry> of_b = geometriesFrom(b, "group_b");
  const py::gil_scoped_release released;
  return std::make_shared<Groups>(std::move(of_a), std::move(of_b));
}

// What every question takes besides.
#define FCL_PROB_REQUEST_KEYWORDS                                                              \
  "request: method ('auto', 'interval', 'estimate', 'exact', ...), contact ('fcl', 'solid',\n" \
  "'contained'), relative_tolerance, absolute_tolerance, threshold, time_limit (seconds),\n"   \
  "max_cells, max_memory (bytes), confidence, samples, seed, threads, gradient, on_progress.\n\n"

constexpr const char* kAskDocumentation =
    "The probability that A, displaced at random, collides with B.\n\n"
    "displacement: a GaussianDisplacement, GaussianMixture, TruncatedGaussian or PoseError, of A\n"
    "relative to B. pose_a, pose_b: (4, 4) float64, or (3,) x, y, z, or (7,) with qw, qx, qy, qz,\n"
    "or (6,) with roll, pitch, yaw about fixed axes; metres, radians, world frame; None is the\n"
    "identity.\n\n" FCL_PROB_REQUEST_KEYWORDS
    "on_progress((lower, upper), fraction, seconds) is called now and then; returning False\n"
    "cancels the query, whose interval is valid all the same. Ctrl-C raises Interrupted, a\n"
    "KeyboardInterrupt whose `result` is what was certain by then. Runs without the GIL.\n\n"
    "Raises InvalidRequest, InvalidPose, InvalidGeometry, UnsupportedGeometry, OpenMesh.";

constexpr const char* kAskAllDocumentation =
    "Answers many queries on all cores, without the GIL; the answers are those of single ones.\n\n"
    "pose_a, pose_b: one pose, or n of them as (n, 4, 4), (n, 3), (n, 6) or (n, 7). displacement:\n"
    "one, or a list of n; or instead covariances (n, 3, 3), square metres, or (n, 6, 6) of pose "
    "errors\n"
    "(with `convention`), and means (n, 3) or (n, 6). What there is one of serves "
    "all.\n\n" FCL_PROB_REQUEST_KEYWORDS
    "Limits are those of each query. threads: all cores if not given. on_progress(done, total) is\n"
    "called now and then; returning False cancels what is left. Returns a BatchResult.";

}  // namespace

void bindQueries(py::module_& module) {
  const auto none = py::none();
  bindGradient(module);
  module.def("collision_probability", &askOnce, py::arg("a"), py::arg("b"), py::arg("displacement"),
             py::arg("pose_a") = none, py::arg("pose_b") = none, kAskDocumentation);
  module.def(
      "certified_probability", &certify, py::arg("a"), py::arg("b"), py::arg("displacement"),
      py::arg("pose_a") = none, py::arg("pose_b") = none,
      "An interval that somebody else can check: (ProbabilityResult, certificate as text).\n\n"
      "a, b: meshes and boxes; displacement: a GaussianDisplacement. The text goes to a file\n"
      "for fcl_prob_verify. Takes longer than "
      "collision_probability().\n\n" FCL_PROB_REQUEST_KEYWORDS
      "Raises UnsupportedGeometry, InvalidRequest, InvalidPose, OpenMesh.");
  module.def("collision_probabilities", &askAllOnce, py::arg("a"), py::arg("b"),
             py::arg("displacement") = none, py::arg("pose_a") = none, py::arg("pose_b") = none,
             py::kw_only(), py::arg("covariances") = none, py::arg("means") = none,
             py::arg("convention") = "world", kAskAllDocumentation);
  py::class_<Pair, std::shared_ptr<Pair>>(
      module, "PreparedQuery",
      "PreparedQuery(a, b): a pair of geometries prepared once, for many poses and displacements. "
      "May be used by several threads.")
      .def(py::init(&preparedPair), py::arg("a"), py::arg("b"))
      .def("collision_probability", &ask, py::arg("displacement"), py::arg("pose_a") = none,
           py::arg("pose_b") = none, kAskDocumentation)
      .def("collision_probabilities", &askAll, py::arg("displacement") = none,
           py::arg("pose_a") = none, py::arg("pose_b") = none, py::kw_only(),
           py::arg("covariances") = none, py::arg("means") = none, py::arg("convention") = "world",
           kAskAllDocumentation);
  py::class_<Groups, std::shared_ptr<Groups>>(
      module, "GroupQuery",
      "GroupQuery(group_a, group_b): two lists of geometries; all of A share one displacement "
      "relative to all of B. May be used by several threads.")
      .def(py::init(&preparedGroups), py::arg("group_a"), py::arg("group_b"))
      .def("collision_probability", &askGroups, py::arg("displacement"), py::arg("poses_a") = none,
           py::arg("poses_b") = none, py::kw_only(), py::arg("frame") = none,
           "The probability that any member of A collides with any member of B.\n\n"
           "poses_a, poses_b: one pose a member, (k, 4, 4), (k, 3) or (k, 7); metres, world\n"
           "frame; None: identities. frame: (4, 4), with a PoseError the pose that is uncertain\n"
           "and carries A.\n\n" FCL_PROB_REQUEST_KEYWORDS
           "Raises InvalidRequest, InvalidPose, OpenMesh, UnsupportedGeometry.")
      .def("motion_gradient", &motionGradient, py::arg("displacement"), py::arg("poses_a") = none,
           py::arg("poses_b") = none, py::kw_only(), py::arg("velocities") = none,
           py::arg("contact") = "fcl", py::arg("lines") = 4096, py::arg("seed") = 1,
           py::arg("threads") = 1, py::arg("time_limit") = none, py::arg("on_progress") = none,
           "How P changes as the members of A move (MotionGradient): an estimate from random "
           "lines.\n\n"
           "displacement: a GaussianDisplacement. velocities: (members, 6, k), a Jacobian for "
           "every\n"
           "member: the velocity of its point at the world's origin (metres) and the angular\n"
           "velocity (radians) by each of k parameters; None: every member by itself, six each.\n"
           "on_progress((0, 1), fraction, seconds) is called now and then; returning False leaves\n"
           "the estimate from the lines drawn by then, and Ctrl-C raises Interrupted with it.\n\n"
           "Raises InvalidRequest, InvalidPose, OpenMesh.");
}

}  // namespace fcl_prob::python
