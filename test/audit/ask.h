// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Putting a scene's question to the library.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fcl_prob/probability_result.h"
#include "scene.h"

namespace fcl_prob_audit {

struct Answer {
  std::optional<fcl_prob::ProbabilityResult> result;
  std::string refusal;  ///< the type of exception that the library documents, and its text
  std::string foreign_exception;  ///< of a type that it does not
  double seconds = 0.0;
  int progress_calls = 0;
  int calls_after_stop = 0;  ///< of on_progress, once it has said stop

  explicit operator bool() const { return result.has_value(); }
};

/// A pair (its first displacement, a mixture or a truncation) or a group.
Answer ask(const Scene& scene);

/// Runs something and tells what it threw.
template <typename Function>
void guarded(Answer& answer, Function&& function);

std::string nameOfException(const std::exception& exception, bool& documented);

/// Bounds with 17 digits, status and method.
std::string textOf(const fcl_prob::ProbabilityResult& result);

template <typename Function>
void guarded(Answer& answer, Function&& function) {
  try {
    function();
  } catch (const std::exception& exception) {
    answer.result.reset();
    bool documented = false;
    const std::string name = nameOfException(exception, documented);
    (documented ? answer.refusal : answer.foreign_exception) = name;
  }
}

}  // namespace fcl_prob_audit
