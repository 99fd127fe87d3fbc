#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/core/model/field_recordings.hpp"

namespace loopscope::tests::verdict {

/// seed, family, causes, doubtful causes, then the names of the figures; those that a loop without
/// a model lacks are marked by a star. Between tabs, with an end of line.
[[nodiscard]] std::string heading();

/// The same of one labelled record (as_recorded.hpp), with a model where the data allow one; empty
/// cells = not computed. Empty where the data cannot be judged.
[[nodiscard]] std::string simulated_row(std::uint64_t seed);

/// The same of `windows` successive windows of a loop (draw_windows), a row each, with
/// "seed/window/share of new samples" in place of the seed.
[[nodiscard]] std::string window_rows(std::uint64_t seed, std::size_t windows);

/// Of a recording: name, type and label in place of seed, family and causes. One look at its last
/// window.
[[nodiscard]] std::string recorded_row(const model::FieldRecording& recording);

}  // namespace loopscope::tests::verdict
