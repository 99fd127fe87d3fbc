#pragma once
/// Work on many records side by side.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

namespace loopscope::tests {

/// Calls `work` once for each of 0 to count - 1, from several threads. After a failure no further
/// one is begun, and what it threw is thrown.
template <typename Work>
void in_threads(std::size_t count, unsigned threads, const Work& work) {
  std::atomic<std::size_t> next = 0;
  const auto take_turns = [&] {
    for (std::size_t k = next++; k < count; k = next++) try {
        work(k);
      } catch (...) {
        next = count;
        throw;
      }
  };
  std::vector<std::future<void>> workers;
  for (unsigned i = 0; i < std::max(1U, threads); ++i)
    workers.push_back(std::async(std::launch::async, take_turns));
  for (const std::future<void>& worker : workers) worker.wait();
  for (std::future<void>& worker : workers) worker.get();
}

}  // namespace loopscope::tests
