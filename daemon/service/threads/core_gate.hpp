#pragma once

#include <cstddef>
#include <semaphore>

#include "daemon/service/threads/progress_board.hpp"

namespace loopscope::daemon {

/// Admits as many workers to the work on the rows as there are cores to do it; the others fetch and
/// write meanwhile. Whoever is inside waits for nothing else, so there is no deadlock. Thread-safe.
class CoreGate {
 public:
  explicit CoreGate(std::size_t cores) : free_(static_cast<std::ptrdiff_t>(cores)) {}

  /// A core for as long as it lives; the constructor waits for one.
  class Permit {
   public:
    explicit Permit(CoreGate& gate) : gate_(gate) { gate_.free_.acquire(); }
    ~Permit() { gate_.free_.release(); }
    Permit(const Permit&) = delete;
    Permit& operator=(const Permit&) = delete;

   private:
    CoreGate& gate_;
  };

 private:
  std::counting_semaphore<> free_;
};

/// Waits for a core, shown as waiting.
[[nodiscard]] inline CoreGate::Permit take_core(CoreGate& cores, ProgressBoard::Entry& progress) {
  const ProgressBoard::Entry::Wait wait(progress);
  return CoreGate::Permit(cores);
}

/// The scheduler prefers the threads that analyse to the calling one and to the programs that it
/// starts. A sandbox may refuse: then it is one thread among others.
/// `nice` is 1 to 19: what threads that it starts later inherit.
void yield_to_analysis(int nice = 10);

}  // namespace loopscope::daemon
