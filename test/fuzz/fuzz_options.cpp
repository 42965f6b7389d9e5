// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// What comes from a command line or a caller as numbers: the options of `fcl_prob check`,
// covariances, standard deviations, requests.
#include <fuzzer/FuzzedDataProvider.h>

#include <CLI/CLI.hpp>
#include <Eigen/LU>
#include <cmath>

#include "cli/scene_arguments.h"
#include "fcl_prob/exceptions.h"
#include "fuzz_tally.h"
#include "io/text_reader.h"

using namespace fcl_prob;
using namespace fcl_prob_fuzz;

namespace {

void requireDistribution(const GaussianDisplacement& displacement) {
  const Eigen::Vector3d& s = displacement.standardDeviations();
  require(s.allFinite() && displacement.mean().allFinite(), "a deviation that is not finite");
  require(s[0] >= s[1] && s[1] >= s[2] && s[2] >= 0.0, "deviations that are not sorted");
  int rank = 0;
  for (int k = 0; k < 3; ++k) rank += s[k] > 0.0;
  require(rank == displacement.rank(), "a rank that is not the count of deviations");
  const Eigen::Matrix3d& axes = displacement.axes();
  require((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-9 &&
              axes.determinant() > 0.0,
          "axes that are not a rotation");
  const Eigen::Matrix3d factor = axes * (s / std::max(s[0], 1e-300)).asDiagonal();
  const Eigen::Matrix3d scaled =
      displacement.covariance() / std::max(s[0], 1e-300) / std::max(s[0], 1e-300);
  // Below the first bound the squares underflow.
  if (s[0] > 1e-150) {
    require((factor * factor.transpose() - scaled).cwiseAbs().maxCoeff() < 1e-8,
            "axes and deviations that are not those of the covariance");
  }
  require(displacement.reversed().standardDeviations() == s, "another deviation in reverse");
}

bool optionsAreRead(FuzzedDataProvider& input) {
  std::vector<std::string> words;
  while (input.remaining_bytes() > 0 && words.size() < 40) {
    words.push_back(input.ConsumeRandomLengthString(200));
  }
  CLI::App app("options");
  cli::SceneArguments arguments;
  cli::addSceneOptions(app, arguments);
  cli::addRequestOptions(app, arguments);
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError&) {
    return false;
  }
  arguments.scene_file.clear();  // fuzzed by another target
  const Scene scene = cli::sceneFrom(arguments);
  validateRequest(scene.request);
  requireDistribution(scene.displacement);
  return true;
}

Eigen::Vector3d vectorFrom(FuzzedDataProvider& input) {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) {
    const std::vector<std::uint8_t> bytes = input.ConsumeBytes<std::uint8_t>(sizeof(double));
    v[k] = 0.0;
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::uint8_t*>(&v[k]));
  }
  return v;
}

bool covarianceIsRead(FuzzedDataProvider& input) {
  const Eigen::Vector3d diagonal = vectorFrom(input);
  const Eigen::Vector3d mixed = vectorFrom(input);
  Eigen::Matrix3d covariance = diagonal.asDiagonal();
  covariance(0, 1) = covariance(1, 0) = mixed[0];
  covariance(0, 2) = covariance(2, 0) = mixed[1];
  covariance(1, 2) = covariance(2, 1) = mixed[2];
  requireDistribution(GaussianDisplacement(vectorFrom(input), covariance));
  return true;
}

/// A positive semidefinite matrix, which random entries seldom are.
bool productIsRead(FuzzedDataProvider& input) {
  Eigen::Matrix3d factor;
  for (int k = 0; k < 3; ++k) factor.col(k) = vectorFrom(input);
  requireDistribution(GaussianDisplacement(vectorFrom(input), factor * factor.transpose()));
  return true;
}

bool deviationsAreRead(FuzzedDataProvider& input) {
  const Eigen::Vector3d sigma = vectorFrom(input);
  const Eigen::Vector3d xyz = vectorFrom(input);
  const Eigen::Quaterniond axes(vectorFrom(input)[0], xyz[0], xyz[1], xyz[2]);
  requireDistribution(GaussianDisplacement::fromStandardDeviations(sigma, axes, vectorFrom(input)));
  return true;
}

bool requestIsRead(FuzzedDataProvider& input) {
  ProbabilityRequest request;
  const Eigen::Vector3d numbers = vectorFrom(input);
  const Eigen::Vector3d more = vectorFrom(input);
  request.relative_tolerance = numbers[0];
  request.absolute_tolerance = numbers[1];
  request.confidence = numbers[2];
  if (input.ConsumeBool()) request.threshold = more[0];
  if (input.ConsumeBool()) request.time_limit = more[1];
  request.samples = input.ConsumeIntegral<std::size_t>();
  request.threads = input.ConsumeIntegral<unsigned>();
  request.max_cells = input.ConsumeIntegral<std::size_t>();
  request.max_memory = input.ConsumeIntegral<std::size_t>();
  validateRequest(request);
  require(std::isfinite(request.relative_tolerance) && request.relative_tolerance >= 0.0 &&
              request.absolute_tolerance >= 0.0 && request.confidence > 0.0 &&
              request.confidence < 1.0,
          "a request out of its range is accepted");
  return true;
}

bool textIsRead(FuzzedDataProvider& input) {
  const std::string text = input.ConsumeRemainingBytesAsString();
  detail::LineReader lines(text);
  bool number = false;
  while (const auto line = lines.next()) {
    for (const std::string_view word : detail::splitWords(*line)) {
      number = number || detail::parseNumber(word) || detail::parseInteger(word);
      require(detail::inQuotes(word).find('\n') == std::string::npos, "a quote of two lines");
    }
  }
  return number;
}

bool isRead(FuzzedDataProvider& input) {
  switch (input.ConsumeIntegralInRange<int>(0, 5)) {
    case 0:
      return optionsAreRead(input);
    case 1:
      return covarianceIsRead(input);
    case 2:
      return productIsRead(input);
    case 3:
      return deviationsAreRead(input);
    case 4:
      return requestIsRead(input);
    default:
      return textIsRead(input);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Tally tally("options");
  tally.count("inputs");
  FuzzedDataProvider input(data, size);
  try {
    if (isRead(input)) tally.count("accepted");
  } catch (const Exception&) {
    tally.count("refused");
  }
  return 0;
}
