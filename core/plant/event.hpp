#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/plant/in_step.hpp"
#include "core/plant/line_pairs.hpp"
#include "core/plant/shared_oscillation.hpp"

namespace loopscope::core::plant {

/// One loop beside the common course of an event.
struct Follower {
  std::size_t index = 0;
  double p = 1.0;         ///< InStep::p against the course of the others
  double strength = 0.0;  ///< share of the error's variance that follows that course
};

/// Loops that keep step, as found from the records alone.
struct Event {
  double frequency_hz = 0.0;
  double p = 1.0;
  std::vector<Follower> followers;  ///< in the order of their indices
};

/// The course that several loops have in common, at one frequency.
class CommonCourse {
 public:
  /// `core` = loops that keep step, the first being the one that the phases are counted from.
  CommonCourse(std::span<const MemberLoop> loops, std::span<const std::size_t> core,
               double frequency_hz);

  [[nodiscard]] double frequency_hz() const { return frequency_hz_; }
  /// A loop of the core is compared with the course of the rest.
  [[nodiscard]] Follower follow(std::size_t index) const;

 private:
  /// nullopt = of all.
  [[nodiscard]] Envelope course_of_others(std::optional<std::size_t> index) const;

  struct Aligned {
    std::size_t index = 0;
    Envelope envelope;    ///< divided by its gain against the first
    double weight = 0.0;  ///< one by the mean square of what does not follow
  };
  std::span<const MemberLoop> loops_;
  double frequency_hz_;
  std::vector<Aligned> core_;
  Wander whole_;
};

/// Every event of the plant, strongest evidence first.
[[nodiscard]] std::vector<Event> find_events(std::span<const MemberLoop> loops,
                                             const PlantSettings& settings);

}  // namespace loopscope::core::plant
