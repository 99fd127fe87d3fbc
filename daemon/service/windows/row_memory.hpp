#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/historian_reader.hpp"

namespace loopscope::daemon {

/// The rows that a batch has read, so that a longer or an earlier span of the same tags asks the
/// historian only for the rows before them: the windows of neighbouring slots are nearly the same.
/// Gives exactly the rows that reading the whole span would give.
class RowMemory {
 public:
  using Read = std::function<std::vector<core::signal::RawSeries>(
      std::span<const storage::TagRequest> requests)>;

  /// Rows of each request, in order. `read` is called once at most, with one request for each.
  [[nodiscard]] std::vector<core::signal::RawSeries> read(
      std::span<const storage::TagRequest> requests, const Read& read);

 private:
  struct Known {
    storage::TagRequest request;
    core::signal::RawSeries rows;
  };
  /// What is known of the later part of the span; nullptr = nothing that can be used.
  [[nodiscard]] const Known* later_part(const storage::TagRequest& request) const;
  void remember(const storage::TagRequest& request, const core::signal::RawSeries& rows);

  /// By tag and whether its values were read as modes: the first read of each.
  std::map<std::pair<std::string, bool>, Known> known_;
};

}  // namespace loopscope::daemon
