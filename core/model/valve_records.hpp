#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/model/op_swings.hpp"
#include "core/model/valve_search.hpp"
#include "core/model/valve_tracking.hpp"

namespace loopscope::core::model {

/// One record at several rates: slow cycles are judged on means over several samples, which keeps
/// delays within the lags and lets the noise of single samples drop out.
class ValveRecords {
 public:
  explicit ValveRecords(const ValveSearchInput& input);

  /// A record with what is known about the process at its rate.
  struct Entry {
    TrackedRecord record;
    LaggedModel model;        ///< of the best candidate so far; linear before
    double evidence = 0.0;    ///< its evidence
    std::size_t samples = 0;  ///< covered
    std::size_t samples_per_row = 1;
  };

  /// The whole record.
  [[nodiscard]] Entry& full(std::size_t samples_per_row);
  /// The stretch of kQuickRows rows with the most usable samples: for the first look.
  [[nodiscard]] Entry& quick(std::size_t samples_per_row);

  [[nodiscard]] const OpSwings& swings() const { return *swings_; }
  [[nodiscard]] double op_level() const { return op_level_; }
  [[nodiscard]] double op_span() const { return op_span_; }
  [[nodiscard]] std::size_t samples() const { return op_.size(); }

 private:
  [[nodiscard]] Entry make(std::size_t first, std::size_t count, std::size_t samples_per_row) const;
  [[nodiscard]] std::size_t best_stretch(std::size_t count) const;

  ValveSearchInput input_;
  std::vector<std::uint8_t> op_known_;  ///< filled while op_ is made
  std::vector<double> op_;
  double op_level_ = 0.0;
  double op_span_ = 0.0;
  std::optional<OpSwings> swings_;
  std::map<std::size_t, Entry> full_, quick_;
};

}  // namespace loopscope::core::model
