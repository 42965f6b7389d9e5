// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/displacements.h"

#include <pybind11/stl.h>

#include <array>
#include <sstream>

#include "fcl_prob/exceptions.h"
#include "python/arrays.h"
#include "python/pickled.h"
#include "python/request.h"

namespace fcl_prob::python {
namespace {

/// A private copy of an array, so that what is recorded cannot be changed afterwards.
py::object kept(const py::object& value) {
  if (value.is_none()) return value;
  return py::module_::import("numpy").attr("array")(value, "float64");
}

Eigen::Vector3d orZero(const py::object& value, const std::string& name) {
  return value.is_none() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : vectorFrom(value, name);
}

Eigen::Quaterniond quaternionFrom(const py::object& value, const std::string& name) {
  if (value.is_none()) return Eigen::Quaterniond::Identity();
  const Numbers numbers(value, name);
  if (!numbers.hasShape({4})) numbers.refuseShape("(4,): qw, qx, qy, qz");
  return {numbers.at(0), numbers.at(1), numbers.at(2), numbers.at(3)};
}

PoseError::Vector6 sixFrom(const py::object& value, const std::string& name) {
  if (value.is_none()) return PoseError::Vector6::Zero();
  const Numbers numbers(value, name);
  if (!numbers.hasShape({6})) numbers.refuseShape("(6,): x, y, z, rx, ry, rz");
  PoseError::Vector6 six;
  for (int i = 0; i < 6; ++i) six[i] = numbers.at(i);
  return six;
}

PoseError::Matrix6 sixBySixFrom(const py::object& value, const std::string& name) {
  const Numbers numbers(value, name);
  if (!numbers.hasShape({6, 6})) numbers.refuseShape("(6, 6)");
  PoseError::Matrix6 matrix;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) matrix(i, j) = numbers.at(i, j);
  }
  return matrix;
}

// Gaussian displacements.

MadeGaussian gaussian(const py::object& covariance, const py::object& mean) {
  return {GaussianDisplacement(orZero(mean, "mean"), matrixFrom(covariance, "covariance")),
          py::make_tuple("covariance", kept(covariance), kept(mean))};
}

MadeGaussian nothingMoves() { return {GaussianDisplacement(), py::make_tuple("nothing")}; }

MadeGaussian gaussianFromDeviations(const py::object& deviations, const py::object& axes,
                                    const py::object& mean) {
  return {GaussianDisplacement::fromStandardDeviations(
              vectorFrom(deviations, "standard_deviations"), quaternionFrom(axes, "axes"),
              orZero(mean, "mean")),
          py::make_tuple("deviations", kept(deviations), kept(axes), kept(mean))};
}

MadeGaussian gaussianFromIndependent(const MadeGaussian& a, const MadeGaussian& b) {
  return {GaussianDisplacement::fromIndependent(a, b), py::make_tuple("independent", a, b)};
}

MadeGaussian gaussianWithMean(const MadeGaussian& self, const py::object& mean) {
  return {self.withMean(vectorFrom(mean, "mean")), py::make_tuple("mean", self, kept(mean))};
}

MadeGaussian gaussianReversed(const MadeGaussian& self) {
  return {self.reversed(), py::make_tuple("reversed", self)};
}

MadeGaussian gaussianRotated(const MadeGaussian& self, const py::object& rotation) {
  return {self.rotated(matrixFrom(rotation, "rotation")),
          py::make_tuple("rotated", self, kept(rotation))};
}

MadeGaussian gaussianMadeAgain(const py::tuple& made_by) {
  const std::string maker = made_by[0].cast<std::string>();
  const auto argument = [&](std::size_t i) { return made_by[i].cast<py::object>(); };
  const auto other = [&](std::size_t i) { return made_by[i].cast<MadeGaussian>(); };
  if (maker == "nothing") return nothingMoves();
  if (maker == "covariance") return gaussian(argument(1), argument(2));
  if (maker == "deviations") {
    return gaussianFromDeviations(argument(1), argument(2), argument(3));
  }
  if (maker == "independent") return gaussianFromIndependent(other(1), other(2));
  if (maker == "mean") return gaussianWithMean(other(1), argument(2));
  if (maker == "reversed") return gaussianReversed(other(1));
  if (maker == "rotated") return gaussianRotated(other(1), argument(2));
  throw InvalidDistribution("'" + maker + "' makes no GaussianDisplacement");
}

std::string reprOf(const GaussianDisplacement& g) {
  std::ostringstream text;
  const Eigen::Vector3d& sigma = g.standardDeviations();
  text << "<GaussianDisplacement mean (" << g.mean().x() << ", " << g.mean().y() << ", "
       << g.mean().z() << ") m, standard deviations " << sigma.x() << ", " << sigma.y() << ", "
       << sigma.z() << " m>";
  return text.str();
}

void bindGaussian(py::module_& module) {
  using G = MadeGaussian;
  const auto none = py::none();
  py::class_<G>(
      module, "GaussianDisplacement",
      "GaussianDisplacement(covariance, mean=None): the random translation of A relative\n"
      "to B, world frame. covariance (3, 3) float64, square metres, positive\n"
      "semidefinite of any rank; mean (3,), metres, 0 if None. Without arguments: no\n"
      "displacement at all. Immutable.\n\n"
      "Raises InvalidDistribution.")
      .def(py::init(&nothingMoves))
      .def(py::init(&gaussian), py::arg("covariance"), py::arg("mean") = none)
      .def_static("from_standard_deviations", &gaussianFromDeviations,
                  py::arg("standard_deviations"), py::arg("axes") = none, py::arg("mean") = none,
                  "Standard deviations (3,), metres, along the axes of a quaternion (4,) qw, qx, "
                  "qy, qz (None: the world's axes).")
      .def_static("from_independent", &gaussianFromIndependent, py::arg("of_a"), py::arg("of_b"),
                  "That of A relative to B if both move independently.")
      .def_property_readonly(
          "mean", [](const G& g) { return vectorArray(g.mean()); }, "(3,) float64, metres.")
      .def_property_readonly(
          "covariance", [](const G& g) { return arrayOf(g.covariance()); },
          "(3, 3) float64, square metres.")
      .def_property_readonly(
          "standard_deviations", [](const G& g) { return vectorArray(g.standardDeviations()); },
          "(3,) float64, metres, along the axes, largest first.")
      .def_property_readonly(
          "axes", [](const G& g) { return arrayOf(g.axes()); },
          "Principal axes as columns, (3, 3) float64.")
      .def_property_readonly(
          "rank", [](const G& g) { return g.rank(); },
          "Number of directions in which A moves, 0 to 3.")
      .def("with_mean", &gaussianWithMean, py::arg("mean"),
           "The same with another mean (3,), metres.")
      .def("reversed", &gaussianReversed, "That of B relative to A.")
      .def("rotated", &gaussianRotated, py::arg("rotation"),
           "The same seen from a world rotated by a matrix (3, 3).")
      .def("__repr__", [](const G& g) { return reprOf(g); })
      .def(pickledAs<const G&>([](const G& g) { return g.made_by; }, &gaussianMadeAgain));
}

// Mixtures and truncated Gaussians.

MadeMixture mixture(const std::vector<double>& weights,
                    const std::vector<MadeGaussian>& displacements) {
  if (weights.size() != displacements.size()) {
    throw InvalidDistribution("there are " + std::to_string(weights.size()) + " weights, but " +
                              std::to_string(displacements.size()) + " displacements");
  }
  std::vector<GaussianMixture::Component> components;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    components.push_back({weights[i], displacements[i]});
  }
  return {GaussianMixture(std::move(components)), py::make_tuple(weights, displacements)};
}

MadeTruncated truncated(const MadeGaussian& gaussian, double deviations) {
  return {TruncatedGaussian(gaussian, deviations), py::make_tuple(gaussian, deviations)};
}

void bindMixtures(py::module_& module) {
  using M = MadeMixture;
  py::class_<M>(module, "GaussianMixture",
                "GaussianMixture(weights, displacements): one of several GaussianDisplacements, "
                "each with its probability; the weights add up to 1. Immutable.")
      .def(py::init(&mixture), py::arg("weights"), py::arg("displacements"))
      .def_property_readonly(
          "weights",
          [](const M& m) {
            std::vector<double> weights;
            for (const auto& c : m.components()) weights.push_back(c.weight);
            return arrayOf(weights);
          },
          "(k,) float64.")
      .def_property_readonly(
          "displacements", [](const M& m) { return m.made_by[1]; },
          "A list of GaussianDisplacements.")
      .def("__repr__",
           [](const M& m) {
             return "<GaussianMixture of " + std::to_string(m.components().size()) + " components>";
           })
      .def(pickledAs<const M&>([](const M& m) { return m.made_by; },
                               [](const py::tuple& s) {
                                 return mixture(s[0].cast<std::vector<double>>(),
                                                s[1].cast<std::vector<MadeGaussian>>());
                               }));
  using T = MadeTruncated;
  py::class_<T>(module, "TruncatedGaussian",
                "TruncatedGaussian(gaussian, deviations): a GaussianDisplacement that stays within "
                "its ellipsoid of so many standard deviations. Immutable.")
      .def(py::init(&truncated), py::arg("gaussian"), py::arg("deviations"))
      .def_property_readonly("gaussian", [](const T& t) { return t.made_by[0]; })
      .def_property_readonly("deviations", [](const T& t) { return t.deviations(); })
      .def("__repr__",
           [](const T& t) {
             std::ostringstream text;
             text << "<TruncatedGaussian of " << reprOf(t.gaussian()) << " within "
                  << t.deviations() << " standard deviations>";
             return text.str();
           })
      .def(pickledAs<const T&>([](const T& t) { return t.made_by; },
                               [](const py::tuple& s) {
                                 return truncated(s[0].cast<MadeGaussian>(), s[1].cast<double>());
                               }));
}

// Errors of poses.

MadePoseError poseError(const py::object& covariance, const std::string& convention,
                        const py::object& mean) {
  return {PoseError(sixBySixFrom(covariance, "covariance"), conventionFrom(convention),
                    sixFrom(mean, "mean")),
          py::make_tuple("covariance", kept(covariance), convention, kept(mean))};
}

MadePoseError poseErrorFromDeviations(const py::object& translation, const py::object& rotation,
                                      const std::string& convention) {
  return {PoseError::fromStandardDeviations(vectorFrom(translation, "translation"),
                                            vectorFrom(rotation, "rotation"),
                                            conventionFrom(convention)),
          py::make_tuple("deviations", kept(translation), kept(rotation), convention)};
}

MadePoseError poseErrorFromIndependent(const MadeGaussian& translation,
                                       const py::object& rotation_covariance,
                                       const std::string& convention) {
  return {PoseError::fromIndependent(translation,
                                     matrixFrom(rotation_covariance, "rotation_covariance"),
                                     conventionFrom(convention)),
          py::make_tuple("independent", translation, kept(rotation_covariance), convention)};
}

PoseError rosError(const py::object& covariance) {
  const Numbers numbers(covariance, "covariance");
  if (numbers.dimensions() == 2) {
    return PoseError::fromRosCovariance(sixBySixFrom(covariance, "covariance"));
  }
  std::array<double, 36> rows{};
  if (!numbers.hasShape({36})) numbers.refuseShape("(36,) or (6, 6)");
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = numbers.at(i);
  return PoseError::fromRosCovariance(rows);
}

MadePoseError poseErrorFromRos(const py::object& covariance) {
  return {rosError(covariance), py::make_tuple("ros", kept(covariance))};
}

MadePoseError poseErrorBetween(const MadePoseError& of_a, const py::object& pose_a,
                               const MadePoseError& of_b, const py::object& pose_b) {
  return {
      PoseError::betweenBodies(of_a, poseFrom(pose_a, "pose_a"), of_b, poseFrom(pose_b, "pose_b")),
      py::make_tuple("between", of_a, kept(pose_a), of_b, kept(pose_b))};
}

MadePoseError poseErrorMadeAgain(const py::tuple& made_by) {
  const std::string maker = made_by[0].cast<std::string>();
  const auto argument = [&](std::size_t i) { return made_by[i].cast<py::object>(); };
  const auto text = [&](std::size_t i) { return made_by[i].cast<std::string>(); };
  if (maker == "covariance") return poseError(argument(1), text(2), argument(3));
  if (maker == "deviations") return poseErrorFromDeviations(argument(1), argument(2), text(3));
  if (maker == "independent") {
    return poseErrorFromIndependent(made_by[1].cast<MadeGaussian>(), argument(2), text(3));
  }
  if (maker == "ros") return poseErrorFromRos(argument(1));
  if (maker == "between") {
    return poseErrorBetween(made_by[1].cast<MadePoseError>(), argument(2),
                            made_by[3].cast<MadePoseError>(), argument(4));
  }
  throw InvalidDistribution("'" + maker + "' makes no PoseError");
}

std::string reprOf(const PoseError& error) {
  std::ostringstream text;
  text << "<PoseError with standard deviations";
  for (int i = 0; i < 6; ++i) {
    text << (i > 0 ? ", " : " ") << std::sqrt(error.covariance()(i, i)) << (i < 3 ? " m" : " rad");
  }
  text << ", convention " << toString(error.convention()) << ">";
  return text.str();
}

void bindPoseErrors(py::module_& module) {
  using P = MadePoseError;
  const auto none = py::none();
  py::class_<P>(module, "PoseError",
                "PoseError(covariance, convention='world', mean=None): the random error of a pose\n"
                "in the order x, y, z, rx, ry, rz. covariance (6, 6) float64: square metres,\n"
                "metres·radians, square radians; mean (6,). convention: 'world', 'body' (a\n"
                "translation and a rotation vector in that frame, about the origin of the body),\n"
                "'world-exponential' or 'body-exponential' (of SE(3)). Immutable.\n\n"
                "Raises InvalidDistribution.")
      .def(py::init(&poseError), py::arg("covariance"), py::arg("convention") = "world",
           py::arg("mean") = none)
      .def_static("from_standard_deviations", &poseErrorFromDeviations, py::arg("translation"),
                  py::arg("rotation"), py::arg("convention") = "world",
                  "Independent ones: translation (3,), metres; rotation (3,), radians.")
      .def_static("from_independent", &poseErrorFromIndependent, py::arg("translation"),
                  py::arg("rotation_covariance"), py::arg("convention") = "world",
                  "A GaussianDisplacement and, independent of it, a rotation vector with a "
                  "covariance (3, 3), square radians.")
      .def_static(
          "from_ros_covariance", &poseErrorFromRos, py::arg("covariance"),
          "From the covariance of geometry_msgs/PoseWithCovariance, (36,) or (6, 6): x, y, z, "
          "and rotations about fixed axes of the world frame through the pose's origin, the "
          "convention \"world\".")
      .def_static("between_bodies", &poseErrorBetween, py::arg("of_a"), py::arg("pose_a"),
                  py::arg("of_b"), py::arg("pose_b"),
                  "That of A relative to B, from independent errors of both; poses (4, 4).")
      .def_property_readonly(
          "covariance", [](const P& e) { return arrayOf(e.covariance()); }, "(6, 6) float64.")
      .def_property_readonly(
          "mean", [](const P& e) { return vectorArray(e.mean()); }, "(6,) float64.")
      .def_property_readonly("convention", [](const P& e) { return toString(e.convention()); })
      .def_property_readonly(
          "rotation_rank", [](const P& e) { return e.rotationRank(); },
          "Independent directions in which the rotation varies, 0 to 3.")
      .def("__repr__", [](const P& e) { return reprOf(e); })
      .def(pickledAs<const P&>([](const P& e) { return e.made_by; }, &poseErrorMadeAgain));
}

}  // namespace

Randomness randomnessFrom(py::handle value, const std::string& name) {
  if (py::isinstance<MadeGaussian>(value)) {
    return static_cast<const GaussianDisplacement&>(value.cast<const MadeGaussian&>());
  }
  if (py::isinstance<MadeMixture>(value)) {
    return static_cast<const GaussianMixture&>(value.cast<const MadeMixture&>());
  }
  if (py::isinstance<MadeTruncated>(value)) {
    return static_cast<const TruncatedGaussian&>(value.cast<const MadeTruncated&>());
  }
  if (py::isinstance<MadePoseError>(value)) {
    return static_cast<const PoseError&>(value.cast<const MadePoseError&>());
  }
  throw py::type_error(name +
                       " must be a GaussianDisplacement, GaussianMixture, "
                       "TruncatedGaussian or PoseError, not " +
                       textOf(value));
}

void bindDisplacements(py::module_& module) {
  bindGaussian(module);
  bindMixtures(module);
  bindPoseErrors(module);
}

}  // namespace fcl_prob::python
