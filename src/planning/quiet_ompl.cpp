// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include "planning/quiet_ompl.h"

#include <ompl/util/Console.h>

#include <mutex>

namespace fcl_prob::detail {
namespace {

std::mutex& quietMutex() {
  static std::mutex mutex;
  return mutex;
}

int quiet_plans = 0;
ompl::msg::OutputHandler* handler_before = nullptr;

}  // namespace

QuietOmpl::QuietOmpl() {
  const std::lock_guard<std::mutex> lock(quietMutex());
  if (quiet_plans++ > 0) return;
  handler_before = ompl::msg::getOutputHandler();
  ompl::msg::noOutputHandler();
}

QuietOmpl::~QuietOmpl() {
  const std::lock_guard<std::mutex> lock(quietMutex());
  if (--quiet_plans == 0) ompl::msg::useOutputHandler(handler_before);
}

}  // namespace fcl_prob::detail
