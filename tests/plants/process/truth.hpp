#pragma once

#include <optional>

#include "tests/plants/process/causes.hpp"
#include "tests/plants/process/simulate.hpp"

namespace loopscope::tests::process {

/// What the two runs of a draft say: as it is, and without its cause.
struct Twins {
  std::vector<Record> with, without;
};

/// What the cause changes in a loop's sp - pv.
[[nodiscard]] std::vector<double> change_of_error(const Twins& twins, std::size_t loop);
[[nodiscard]] std::vector<double> error_of(const Record& record);

/// Part of the error lies about one frequency.
[[nodiscard]] bool swings(const Record& record);

/// Of the source, or the one that the cause sets; nullopt where nothing swings, or where the
/// second run was spared.
[[nodiscard]] std::optional<double> period_of(const Draft& draft, const Twins& twins);

/// Every loop with its record and its truth, for an oscillation of this period (0 = none).
[[nodiscard]] std::vector<ProcessLoop> loops_of(const Draft& draft, Twins twins, double period_s);

/// Outputs off their limits, but for one that is meant to reach them.
[[nodiscard]] bool runs_well(const Draft& draft, const std::vector<Record>& records);

/// No loop's error has a line.
[[nodiscard]] bool is_calm(const std::vector<Record>& records);

}  // namespace loopscope::tests::process
