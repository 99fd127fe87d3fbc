#pragma once

#include <span>
#include <vector>

#include "core/model/response/noise_model.hpp"

namespace loopscope::core::model {

/// Signals to be whitened, taken two at a time, and no longer than their whitened signal lasts: one
/// that sits in one place is zero before it and, up to rounding, soon after it. Equal lengths; the
/// spans have to outlive run().
class Whitening {
 public:
  void add(std::span<const double> signal, std::span<double> whitened);
  /// Fills every `whitened`.
  void run(const NoiseModel& noise) const;

 private:
  void run(const NoiseModel& noise, std::size_t first, std::size_t count) const;

  std::vector<std::span<const double>> from_;
  std::vector<std::span<double>> to_;
};

/// One sample later; before the record as in its first row. Whitening such a signal gives the same.
void put_later(std::span<const double> signal, std::span<double> later);

}  // namespace loopscope::core::model
