#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>

namespace loopscope::core::hos {

/// FFTW's planner must not run in two threads: one lock for all plans of the program. It is the one
/// thing in core that all threads share.
[[nodiscard]] std::mutex& planner_lock();

/// The plan of one kind for one length, made at its first use and kept for the life of the program
/// (a few kilobytes each). `Plan` is made from a length.
template <class Plan>
const Plan& cached_plan(std::size_t length) {
  static std::map<std::size_t, std::unique_ptr<const Plan>> plans;
  const std::lock_guard lock(planner_lock());
  std::unique_ptr<const Plan>& plan = plans[length];
  if (!plan) plan = std::make_unique<const Plan>(length);
  return *plan;
}

}  // namespace loopscope::core::hos
