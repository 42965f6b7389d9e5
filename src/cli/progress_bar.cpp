// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "cli/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace fcl_prob::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kFirstDelay{500};
constexpr std::chrono::milliseconds kInterval{100};
constexpr int kBarWidth = 24;

volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void onInterrupt(int signal) {
  interrupt_seen = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)),
      terminal_(::isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + kFirstDelay) {}

ProgressBar::~ProgressBar() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::show(double fraction, const std::string& text) {
  if (!terminal_ || Clock::now() < next_) return;
  next_ = Clock::now() + kInterval;
  drawn_ = true;
  const int filled = static_cast<int>(kBarWidth * std::clamp(fraction, 0.0, 1.0));
  std::cerr << "\r\033[K" << label_ << " [" << std::string(filled, '#')
            << std::string(kBarWidth - filled, ' ') << "] " << text << std::flush;
}

bool ProgressBar::operator()(const ProbabilityProgress& progress) {
  std::ostringstream text;
  text << std::setprecision(4) << progress.interval.lower << " <= P <= " << progress.interval.upper
       << "  " << std::fixed << std::setprecision(1) << progress.seconds << " s";
  show(progress.fraction, text.str());
  return !interrupted();
}

void noteInterrupts() { std::signal(SIGINT, onInterrupt); }

bool interrupted() { return interrupt_seen != 0; }

}  // namespace fcl_prob::cli
