// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// A progress bar for people, on standard error.
#pragma once

#include <chrono>
#include <string>

#include "fcl_prob/probability_request.h"

namespace fcl_prob::cli {

/// Shown only if standard error is a terminal, and only for work that takes longer than a moment.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// \param fraction  of the work that is done, 0 to 1
  void show(double fraction, const std::string& text);

  /// For ProbabilityRequest::on_progress: shows the interval, and cancels the query after Ctrl-C.
  bool operator()(const ProbabilityProgress& progress);

 private:
  std::string label_;
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point next_;
};

/// From now on Ctrl-C is noted instead of ending the process, once; a second one ends it.
void noteInterrupts();
bool interrupted();

}  // namespace fcl_prob::cli
