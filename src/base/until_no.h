// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// Callers who cancel are not asked again.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <utility>

namespace fcl_prob::detail {

/// `ask` until it has returned false once: from then on the answer is false, and it is not called.
/// Copies share that, so that whatever parts a call is made of, its caller cancels all of them at
/// once. Every public call makes one of its own.
template <typename Progress>
std::function<bool(const Progress&)> untilNo(std::function<bool(const Progress&)> ask) {
  if (!ask) return ask;
  return [ask = std::move(ask),
          said_no = std::make_shared<std::atomic<bool>>(false)](const Progress& progress) {
    if (*said_no) return false;
    const bool goes_on = ask(progress);
    if (!goes_on) *said_no = true;
    return goes_on;
  };
}

/// A request, of any kind, for the parts of one call.
template <typename Request>
Request ofOneCall(Request request) {
  request.on_progress = untilNo(std::move(request.on_progress));
  return request;
}

}  // namespace fcl_prob::detail
