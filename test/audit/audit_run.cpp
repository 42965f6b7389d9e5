// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "audit_run.h"

#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csetjmp>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <mutex>
#include <sstream>
#include <thread>

#include "scene_generator.h"
#include "shrink.h"

namespace fcl_prob_audit {
namespace {

constexpr std::size_t kFailuresOfAKind = 3;

/// Where a thread goes on after a crash of what it checks.
thread_local sigjmp_buf after_crash;
thread_local volatile std::sig_atomic_t is_checking = 0;

void leaveCrash(int signal) {
  if (is_checking) siglongjmp(after_crash, signal);
  std::_Exit(3);
}

void catchCrashes() {
  struct sigaction action = {};
  action.sa_handler = leaveCrash;
  action.sa_flags = SA_NODEFER;
  for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGALRM}) {
    sigaction(signal, &action, nullptr);
  }
}

/// Sends SIGALRM to the thread that it is made in, after so many seconds of that thread's time.
class Watchdog {
 public:
  explicit Watchdog(long seconds) {
    sigevent event = {};
    event.sigev_notify = SIGEV_THREAD_ID;
    event.sigev_signo = SIGALRM;
    event._sigev_un._tid = gettid();
    timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &timer_);
    const itimerspec time = {{0, 0}, {seconds, 0}};
    timer_settime(timer_, 0, &time, nullptr);
  }
  ~Watchdog() { timer_delete(timer_); }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  timer_t timer_ = {};
};

/// Of one scene, some ten times what the slowest one takes.
constexpr long kHangs = 8;
constexpr long kHangsWhereSlow = 120;

bool isSlow(const std::string& family) {
  const auto& slow = slowFamilies();
  return std::any_of(slow.begin(), slow.end(),
                     [&family](const Family& each) { return each.name == family; });
}

/// A crash is a violation like others. What was in use then is lost, which a short run can afford.
std::vector<Violation> checkSurviving(const Scene& scene, Tally& tally,
                                      const CheckOptions& options = {}) {
  std::vector<Violation> found;
  const Watchdog watchdog(isSlow(scene.family) ? kHangsWhereSlow : kHangs);
  const int signal = sigsetjmp(after_crash, 1);
  if (signal == 0) {
    is_checking = 1;
    found = check(scene, tally, options);
    is_checking = 0;
    return found;
  }
  is_checking = 0;
  const std::string what = signal == SIGALRM ? "hang" : "crash";
  ++tally.violations[scene.family + ": " + what];
  return {{what, "signal " + std::to_string(signal)}};
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Scene sceneAt(const AuditPlan& plan, std::uint64_t index) {
  if (plan.family.empty()) return generate(plan.seed, index);
  for (const auto* all : {&families(), &slowFamilies()}) {
    for (const Family& family : *all) {
      if (family.name == plan.family) return generate(plan.seed, index, family);
    }
  }
  throw std::invalid_argument("no family is called " + plan.family);
}

class Run {
 public:
  explicit Run(const AuditPlan& plan) : plan_(plan), next_(plan.first), begin_(now()) {
    if (!plan.family.empty()) sceneAt(plan, 0);  // throws here rather than in a thread
  }

  AuditReport run() {
    std::vector<std::thread> threads;
    for (unsigned i = 1; i < plan_.threads; ++i) threads.emplace_back([this] { work(); });
    work();
    for (std::thread& thread : threads) thread.join();
    finish();
    return std::move(report_);
  }

 private:
  bool isOver(std::uint64_t index) const {
    return (plan_.scenes && index >= plan_.first + *plan_.scenes) ||
           (plan_.seconds && now() - begin_ > *plan_.seconds);
  }

  void work() {
    Tally tally;
    std::uint64_t done = 0;
    for (;;) {
      const std::uint64_t index = next_++;
      if (isOver(index)) break;
      const Scene scene = sceneAt(plan_, index);
      if (plan_.verbose) std::cout << textOf(scene) << std::flush;
      const double started = now();
      const std::vector<Violation> found = checkSurviving(scene, tally, plan_.options);
      tell(scene, found, now() - started);
      ++done;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    report_.tally.add(tally);
    report_.scenes += done;
  }

  void tell(const Scene& scene, const std::vector<Violation>& found, double seconds) {
    constexpr double kSlow = 5.0;
    if (found.empty() && seconds < kSlow && !plan_.verbose) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    if (seconds > kSlow || plan_.verbose) {
      std::cout << scene.family << ", index " << scene.index << ": " << seconds << " s\n";
    }
    for (const Violation& violation : found) {
      if (plan_.verbose) std::cout << violation.check << ": " << violation.detail << "\n";
      const std::string kind = scene.family + ": " + violation.check;
      std::vector<Failure>& failures = failures_[kind];
      if (failures.empty()) std::cout << kind << ", index " << scene.index << std::endl;
      failures.push_back({scene, violation});
    }
  }

  void finish() {
    report_.seconds = now() - begin_;
    for (auto& [unused, failures] : failures_) {
      std::sort(failures.begin(), failures.end(),
                [](const Failure& x, const Failure& y) { return x.scene.index < y.scene.index; });
      if (failures.size() > kFailuresOfAKind) failures.resize(kFailuresOfAKind);
      report_.failures.insert(report_.failures.end(), failures.begin(), failures.end());
    }
  }

  const AuditPlan plan_;
  std::atomic<std::uint64_t> next_;
  const double begin_;
  std::mutex mutex_;
  AuditReport report_;
  std::map<std::string, std::vector<Failure>> failures_;
};

template <typename Map>
void writeCounts(std::ostream& out, const char* title, const Map& counts) {
  if (counts.empty()) return;
  out << title << "\n";
  for (const auto& [name, count] : counts) out << "  " << name << ": " << count << "\n";
}

}  // namespace

AuditReport runAudit(const AuditPlan& plan) {
  catchCrashes();
  return Run(plan).run();
}

Failure smallest(const Failure& failure, CheckOptions options) {
  options.everything = true;
  options.only = failure.violation.check;
  const auto again = [&](const Scene& scene) -> std::optional<Violation> {
    Tally unused;
    for (const Violation& violation : checkSurviving(scene, unused, options)) {
      if (violation.check == failure.violation.check) return violation;
    }
    return std::nullopt;
  };
  Failure result = failure;
  result.scene =
      shrunk(failure.scene, [&](const Scene& scene) { return again(scene).has_value(); });
  if (const auto violation = again(result.scene)) result.violation = *violation;
  return result;
}

bool hasHeavyTails(const Tally& tally) {
  constexpr double kShareBeyond = 5.7e-7;
  const double expected = kShareBeyond * static_cast<double>(tally.estimates);
  return static_cast<double>(tally.estimates_beyond) > 3.0 + 10.0 * expected;
}

std::string textOf(const AuditReport& report) {
  std::ostringstream out;
  char line[200];
  std::snprintf(line, sizeof line, "%-26s %8s %8s %8s %8s %8s %11s %8s %6s %8s\n", "family",
                "scenes", "answered", "P inside", "exact", "sampled", "claims", "ms", "late",
                "slowest");
  out << line;
  FamilyTally sum;
  const auto writeRow = [&](const std::string& name, const FamilyTally& f) {
    std::snprintf(line, sizeof line, "%-26s %8zu %8zu %8zu %8zu %8zu %11zu %8.2f %6zu %8.2f\n",
                  name.c_str(), f.scenes, f.answered, f.non_trivial, f.exact_truths,
                  f.sampled_truths, f.claims,
                  1e3 * f.seconds / static_cast<double>(std::max<std::size_t>(1, f.scenes)), f.late,
                  f.slowest);
    out << line;
  };
  for (const auto& [name, f] : report.tally.families) {
    writeRow(name, f);
    sum.scenes += f.scenes;
    sum.answered += f.answered;
    sum.non_trivial += f.non_trivial;
    sum.exact_truths += f.exact_truths;
    sum.sampled_truths += f.sampled_truths;
    sum.claims += f.claims;
    sum.seconds += f.seconds;
    sum.late += f.late;
    sum.slowest = std::max(sum.slowest, f.slowest);
  }
  writeRow("all", sum);
  writeCounts(out, "ranks", report.tally.ranks);
  writeCounts(out, "shapes", report.tally.kinds);
  writeCounts(out, "decades of P", report.tally.decades);
  writeCounts(out, "checks", report.tally.checks);
  writeCounts(out, "refused", report.tally.refusals);
  out << "estimates beyond 5 standard errors: " << report.tally.estimates_beyond << " of "
      << report.tally.estimates << "\n";
  writeCounts(out, "VIOLATIONS", report.tally.violations);
  return out.str();
}

}  // namespace fcl_prob_audit
