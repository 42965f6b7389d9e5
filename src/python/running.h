// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Queries without the GIL that Ctrl-C, signals and Python's callables can end.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "fcl_prob/probability_result.h"
#include "python/request.h"

namespace fcl_prob::python {

/// What ends a query from outside: exceptions of signal handlers and of on_progress.
class Interruption {
 public:
  /// \param call  what on_progress is called with; it returns false to cancel
  explicit Interruption(std::optional<py::function> on_progress)
      : on_progress_(std::move(on_progress)) {}

  /// For ProbabilityRequest::on_progress: takes the GIL now and then.
  bool goOn(const ProbabilityProgress& progress);

  /// The same for what calls on_progress with other arguments, which are made with the GIL.
  bool goOn(const std::function<py::tuple()>& arguments);

  /// With the GIL: lets signal handlers run, and on_progress with what `arguments` gives.
  bool lookAround(const std::function<py::tuple()>& arguments);

  /// Raises what was raised meanwhile. Ctrl-C becomes Interrupted, which holds `result`. Needs the
  /// GIL.
  void raise(const std::function<py::object()>& result);

 private:
  std::optional<py::function> on_progress_;
  std::optional<py::error_already_set> raised_;
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
  bool asked_ = false;
  bool said_no_ = false;  ///< then it is not asked again
};

/// Runs `query` on the request without the GIL. `query` must touch nothing of Python.
/// \throws what it throws, and what signal handlers and on_progress raise
ProbabilityResult answer(
    Question question,
    const std::function<void(const ProbabilityRequest&, ProbabilityResult&)>& query);

/// The same for any kind of request with an on_progress, and of result that is valid when it was
/// cancelled: Interrupted holds it.
template <class Result, class Request>
Result runRequest(Request request, std::optional<py::function> on_progress,
                  const std::function<Result(const Request&)>& query) {
  Interruption interruption(std::move(on_progress));
  request.on_progress = [&](const ProbabilityProgress& now) { return interruption.goOn(now); };
  std::optional<Result> result;
  {
    const py::gil_scoped_release released;
    result = query(request);
  }
  interruption.raise([&] { return py::cast(*result); });
  return std::move(*result);
}

template <class Result>
Result run(Question question, const std::function<Result(const ProbabilityRequest&)>& query) {
  return runRequest<Result, ProbabilityRequest>(std::move(question.request),
                                                std::move(question.on_progress), query);
}

/// Answers of many queries; those that were not reached when the run was cancelled are not set.
using Answers = std::vector<std::optional<ProbabilityResult>>;

/// Answers queries 0 … count - 1 on `threads` threads of its own (which, unlike a pool, are there
/// after a fork as well), each on one of them.
/// \param interrupted  what to hand over with Ctrl-C, of the answers so far
/// \throws what the query of the least index throws, among those that do
Answers answerAll(
    std::size_t count, Question question,
    const std::function<void(std::size_t, const ProbabilityRequest&, ProbabilityResult&)>& query,
    const std::function<py::object(const Answers&)>& interrupted);

}  // namespace fcl_prob::python
