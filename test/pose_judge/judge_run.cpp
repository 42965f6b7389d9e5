// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "judge_run.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace fcl_prob_judge {
namespace {

using namespace fcl_prob;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Answer askOnce(const JudgePlan& plan, const AskableScene& scene, Answer question) {
  ProbabilityRequest request;
  request.method = plan.method;
  request.relative_tolerance = plan.relative_tolerance;
  request.confidence = question.confidence;
  request.seed = question.seed;
  request.threads = plan.threads;
  request.time_limit = plan.time_limit;
  if (plan.max_cells) request.max_cells = *plan.max_cells;
  if (question.mode == Mode::decide) request.threshold = question.threshold;
  const auto start = Clock::now();
  try {
    const ProbabilityResult result = scene.ask(request);
    question.decision = toString(result.decision);
    question.status = toString(result.status);
    question.lower = result.lower;
    question.upper = result.upper;
    question.estimate = result.estimate;
    question.standard_error = result.standard_error;
    if (result.confidence_interval) {
      question.interval_lower = result.confidence_interval->lower;
      question.interval_upper = result.confidence_interval->upper;
    }
    question.samples = static_cast<double>(result.statistics.samples);
  } catch (const std::exception& exception) {
    question.exception = exception.what();
  }
  question.seconds = secondsSince(start);
  return question;
}

std::vector<Answer> questionsOf(const JudgePlan& plan, const JudgedScene& scene) {
  std::vector<Answer> questions;
  Answer question;
  question.scene = scene.name;
  question.truth = scene.truth;
  for (const Mode mode : plan.modes) {
    question.mode = mode;
    if (mode == Mode::estimate) {
      question.factor = question.threshold = 0.0;
      question.confidence = plan.confidences.back();
      questions.push_back(question);
      continue;
    }
    for (const double factor : plan.factors) {
      for (const double confidence : plan.confidences) {
        question.factor = factor;
        question.threshold = thresholdAt(scene.truth, factor);
        question.confidence = confidence;
        questions.push_back(question);
      }
    }
  }
  return questions;
}

nlohmann::json numberOf(const std::optional<double>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json();
}

std::optional<double> optionalOf(const nlohmann::json& value) {
  if (value.is_null()) return std::nullopt;
  return value.get<double>();
}

}  // namespace

double thresholdAt(double probability, double factor) {
  const double threshold = factor * probability;
  return threshold < 1.0 ? threshold : 1.0 - (1.0 - probability) / factor;
}

bool Answer::decidedWrongly() const {
  if (mode != Mode::decide) return false;
  return (decision == "below" && truth > threshold) || (decision == "above" && truth < threshold);
}

bool Answer::missed() const {
  // What rounding leaves of an interval that is a point.
  const double slack = 1e-9 * truth;
  return interval_lower && interval_upper &&
         (truth < *interval_lower - slack || truth > *interval_upper + slack);
}

bool Answer::violated() const {
  const double slack = 1e-9 * truth;
  return (lower && truth < *lower - slack) || (upper && truth > *upper + slack);
}

std::optional<double> Answer::deviations() const {
  if (!estimate || !standard_error) return std::nullopt;
  const double error = *estimate - truth;
  if (*standard_error > 0.0) return error / *standard_error;
  if (std::fabs(error) <= 1e-9 * truth) return 0.0;
  return std::copysign(std::numeric_limits<double>::infinity(), error);
}

void runJudge(const JudgePlan& plan, const std::vector<AskableScene>& scenes,
              const std::function<void(const Answer&)>& tell) {
  const auto start = Clock::now();
  for (std::uint64_t i = 0; i < plan.seeds; ++i) {
    if (plan.budget && secondsSince(start) > *plan.budget) return;
    for (const AskableScene& scene : scenes) {
      for (Answer question : questionsOf(plan, scene.scene())) {
        question.seed = plan.first_seed + i;
        tell(askOnce(plan, scene, question));
      }
    }
  }
}

std::string jsonOf(const Answer& answer) {
  nlohmann::json line;
  line["scene"] = answer.scene;
  line["truth"] = answer.truth;
  line["mode"] = answer.mode == Mode::decide ? "decide" : "estimate";
  line["factor"] = answer.factor;
  line["threshold"] = answer.threshold;
  line["confidence"] = answer.confidence;
  line["seed"] = answer.seed;
  line["decision"] = answer.decision;
  line["status"] = answer.status;
  line["lower"] = numberOf(answer.lower);
  line["upper"] = numberOf(answer.upper);
  line["estimate"] = numberOf(answer.estimate);
  line["standard_error"] = numberOf(answer.standard_error);
  line["interval_lower"] = numberOf(answer.interval_lower);
  line["interval_upper"] = numberOf(answer.interval_upper);
  line["seconds"] = answer.seconds;
  line["samples"] = answer.samples;
  if (!answer.exception.empty()) line["exception"] = answer.exception;
  return line.dump();
}

Answer answerFromJson(const std::string& text) {
  const nlohmann::json line = nlohmann::json::parse(text);
  Answer answer;
  answer.scene = line.at("scene");
  answer.truth = line.at("truth");
  answer.mode = line.at("mode") == "decide" ? Mode::decide : Mode::estimate;
  answer.factor = line.at("factor");
  answer.threshold = line.at("threshold");
  answer.confidence = line.at("confidence");
  answer.seed = line.at("seed");
  answer.decision = line.at("decision");
  answer.status = line.at("status");
  answer.lower = optionalOf(line.at("lower"));
  answer.upper = optionalOf(line.at("upper"));
  answer.estimate = optionalOf(line.at("estimate"));
  answer.standard_error = optionalOf(line.at("standard_error"));
  answer.interval_lower = optionalOf(line.at("interval_lower"));
  answer.interval_upper = optionalOf(line.at("interval_upper"));
  answer.seconds = line.at("seconds");
  answer.samples = line.at("samples");
  answer.exception = line.value("exception", "");
  return answer;
}

}  // namespace fcl_prob_judge
