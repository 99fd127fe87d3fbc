#pragma once

#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/plant/envelope.hpp"
#include "core/plant/synchrony.hpp"

namespace loopscope::core::plant {

/// One loop beside the common course of several.
struct Follower {
  std::size_t index = 0;
  double p = 1.0;         ///< Following::p against the course of the others, or Synchrony::p
  double followed = 0.0;  ///< variance that follows the course of all, signal units squared
};

/// The course that several loops have in common, at one frequency: the mean of their envelopes,
/// each divided by its gain against the first and weighted by how closely it follows that one.
class CommonCourse {
 public:
  /// `envelopes` = of every loop, at one frequency; they have to outlive this. `core` = loops that
  /// follow the first of them, in the order of `envelopes`.
  CommonCourse(std::span<const Envelope> envelopes, std::span<const std::size_t> core);

  /// Mean frequency: that of the envelopes and what the course turns against it, weighted by power.
  [[nodiscard]] double frequency_hz() const;
  /// A loop of the core is compared with the course of the rest. `own_line` = the loop's spectrum
  /// shows a line of its own here, so that it has to keep step (synchrony.hpp), not only to follow.
  [[nodiscard]] Follower follow(std::size_t index, bool own_line) const;

 private:
  struct Aligned {
    std::size_t index = 0;
    Envelope envelope;    ///< divided by its gain against the first
    double weight = 0.0;  ///< one by the mean square of what does not follow
  };
  /// One point of the weighted mean; a loop is taken off with its weight negative.
  struct Sum {
    std::complex<double> sum = 0.0;
    double weight = 0.0;
    int count = 0;

    void add(std::complex<double> value, double by_weight);
    /// NaN without a loop: what rounding leaves of the weights is no zero.
    [[nodiscard]] std::complex<double> mean() const;
  };
  void add_up();
  /// nullptr = of all.
  [[nodiscard]] Envelope course_without(const Aligned* left_out) const;

  std::span<const Envelope> envelopes_;
  std::vector<Aligned> core_;
  std::int64_t first_ = 0;  ///< number of the first of sums_
  std::vector<Sum> sums_;
  Envelope whole_;
  Increments increments_;  // of whole_
};

}  // namespace loopscope::core::plant
