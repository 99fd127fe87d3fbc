#pragma once
/// How far the statistical tests of this run go: `deploy/test` shows breaks on a fifth of the
/// records, `deploy/test --long` (LOOPSCOPE_LONG=1) measures rates on all of them.

#include <cstddef>

namespace loopscope::tests {

/// Whether LOOPSCOPE_LONG is set to anything but 0.
[[nodiscard]] bool is_long_run();

/// Records (draws, seeds) of a sweep that takes `full` of them in the long form: a fifth, rounded
/// up, but five at least, in the short one. LOOPSCOPE_RECORDS=N replaces both, for the tables of
/// the READMEs.
/// @throws std::invalid_argument LOOPSCOPE_RECORDS is not a whole number of at least 1
[[nodiscard]] std::size_t records(std::size_t full);

/// The same number in both forms, for what compares two rates and takes seconds;
/// LOOPSCOPE_RECORDS=N replaces it.
[[nodiscard]] std::size_t all_records(std::size_t full);

}  // namespace loopscope::tests
