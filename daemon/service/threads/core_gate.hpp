#pragma once

#include <cstddef>
#include <semaphore>

namespace loopscope::daemon {

/// Admits as many lanes to the work on the rows as there are cores to do it; the others fetch and
/// write meanwhile. Whoever is inside waits for nothing else, so nothing can lock up. Thread-safe.
class CoreGate {
 public:
  explicit CoreGate(std::size_t cores) : free_(static_cast<std::ptrdiff_t>(cores)) {}

  /// A core for as long as it lives.
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

}  // namespace loopscope::daemon
