// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "python/running.h"

#include <sched.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace fcl_prob::python {
namespace {

using Clock = std::chrono::steady_clock;

/// Often enough for people, and too seldom to be noticed beside a query.
constexpr std::chrono::milliseconds kBetweenLooks{20};

/// The cores that this process may use.
unsigned availableCores() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
    return static_cast<unsigned>(std::max(1, CPU_COUNT(&allowed)));
  }
  return std::max(1U, std::thread::hardware_concurrency());
}

/// The threads of one batch and what they share.
class Workers {
 public:
  using Query = std::function<void(std::size_t, const ProbabilityRequest&, ProbabilityResult&)>;

  Workers(std::size_t count, ProbabilityRequest request, const Query& query)
      : request_(std::move(request)), query_(query), answers_(count) {
    request_.threads = 1;
    request_.on_progress = [this](const ProbabilityProgress&) { return !stopped_; };
  }

  ~Workers() {
    stopped_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

  void start(std::size_t threads) {
    running_ = threads;
    threads_.reserve(threads);
    for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
  }

  /// False if time ran out first.
  bool waitFor(std::chrono::milliseconds time) {
    std::unique_lock<std::mutex> lock(mutex_);
    return finished_.wait_for(lock, time, [this] { return running_ == 0; });
  }

  void stop() { stopped_ = true; }

  std::size_t done() const { return done_; }

  /// After waitFor() has returned true. \throws what a query has thrown
  Answers take() {
    if (failure_) std::rethrow_exception(failure_);
    return std::move(answers_);
  }

 private:
  void work() {
    for (;;) {
      const std::size_t i = next_.fetch_add(1, std::memory_order_relaxed);
      if (i >= answers_.size() || stopped_ || !answerOne(i)) break;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    --running_;
    finished_.notify_all();
  }

  bool answerOne(std::size_t i) {
    try {
      ProbabilityResult result;
      query_(i, request_, result);
      if (result.status == ProbabilityStatus::cancelled) return false;
      answers_[i] = std::move(result);
      done_.fetch_add(1, std::memory_order_relaxed);
      return true;
    } catch (...) {
      stopped_ = true;
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!failure_ || i < failed_) {
        failure_ = std::current_exception();
        failed_ = i;
      }
      return false;
    }
  }

  ProbabilityRequest request_;
  const Query& query_;
  Answers answers_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::atomic<bool> stopped_{false};
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable finished_;
  std::size_t running_ = 0;
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
};

}  // namespace

bool Interruption::lookAround(const std::function<py::tuple()>& arguments) {
  if (raised_) return false;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!on_progress_ || said_no_) return !said_no_;
    const py::object goes_on = (*on_progress_)(*arguments());
    // None, of a callable that returns nothing, is no refusal.
    said_no_ = goes_on.is(py::bool_(false));
    return !said_no_;
  } catch (py::error_already_set& error) {
    raised_.emplace(std::move(error));
    return false;
  }
}

bool Interruption::goOn(const ProbabilityProgress& progress) {
  return goOn([&] {
    return py::make_tuple(py::make_tuple(progress.interval.lower, progress.interval.upper),
                          progress.fraction, progress.seconds);
  });
}

bool Interruption::goOn(const std::function<py::tuple()>& arguments) {
  const Clock::time_point now = Clock::now();
  if (!asked_) next_ = on_progress_ ? now : now + kBetweenLooks;
  asked_ = true;
  if (now < next_) return !said_no_;
  bool goes_on = true;
  {
    const py::gil_scoped_acquire acquired;
    goes_on = lookAround(arguments);
  }
  next_ = Clock::now() + kBetweenLooks;
  return goes_on;
}

void Interruption::raise(const std::function<py::object()>& result) {
  if (!raised_) return;
  if (raised_->matches(PyExc_KeyboardInterrupt)) {
    const py::object type = py::module_::import("fcl_prob._errors").attr("Interrupted");
    const py::object exception = type(result());
    PyErr_SetObject(type.ptr(), exception.ptr());
    throw py::error_already_set();
  }
  throw py::error_already_set(std::move(*raised_));
}

ProbabilityResult answer(
    Question question,
    const std::function<void(const ProbabilityRequest&, ProbabilityResult&)>& query) {
  return run<ProbabilityResult>(std::move(question), [&](const ProbabilityRequest& request) {
    ProbabilityResult result;
    query(request, result);
    return result;
  });
}

Answers answerAll(
    std::size_t count, Question question,
    const std::function<void(std::size_t, const ProbabilityRequest&, ProbabilityResult&)>& query,
    const std::function<py::object(const Answers&)>& interrupted) {
  const unsigned cores = availableCores();
  const unsigned threads =
      question.threads_are_given ? std::min(question.request.threads, cores) : cores;
  Interruption interruption(question.on_progress);
  Workers workers(count, question.request, query);
  bool finished = false;
  {
    const py::gil_scoped_release released;
    workers.start(std::min<std::size_t>(threads, count));
    finished = workers.waitFor(kBetweenLooks);
  }
  while (!finished) {
    if (!interruption.lookAround([&] { return py::make_tuple(workers.done(), count); })) {
      workers.stop();
    }
    const py::gil_scoped_release released;
    finished = workers.waitFor(kBetweenLooks);
  }
  interruption.lookAround([&] { return py::make_tuple(workers.done(), count); });
  Answers answers = workers.take();
  interruption.raise([&] { return interrupted(answers); });
  return answers;
}

}  // namespace fcl_prob::python
