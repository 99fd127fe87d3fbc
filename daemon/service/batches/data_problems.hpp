#pragma once

#include <cstddef>
#include <vector>

#include "core/diagnosis/diagnose.hpp"
#include "daemon/service/windows/window_reader.hpp"
#include "storage/catalogue_entry.hpp"
#include "storage/loop_work.hpp"

namespace loopscope::daemon {

/// What is wrong with the tags of a loop as its historian holds them, whatever the analysis says:
///
/// | code | when |
/// |---|---|
/// | `no_rows` | the tag has no row at all |
/// | `dead_tag` | no row for two periods, and not for 512 samples (pv) or a window (op, mv) |
/// | `bad_quality` | more than half of the rows of the window are of bad quality |
/// | `unknown_quality` | rows of the window have a quality code that the settings do not know |
/// | `rows_too_dense` | the window was cut off: more than two rows a sample |
/// | `future_rows` | rows are stamped in the future |
///
/// By the historian's clock, so that an archive that has ended is dead whatever slot is looked at.
/// sp and mode may stand still for months where they are recorded on change: never dead.
[[nodiscard]] std::vector<storage::DataProblem> tag_problems(const storage::CatalogueEntry& loop,
                                                             const LoopWindowAtSlot& at_slot,
                                                             std::size_t max_samples);

/// The flags of an analysis as problems, and its verdict where that is about no loop in control.
[[nodiscard]] std::vector<storage::DataProblem> flag_problems(const core::Diagnosis& diagnosis);

/// Not `insufficient_data`, and not `not_controlling`.
[[nodiscard]] bool shows_a_loop(core::diagnosis::VerdictCode code);

}  // namespace loopscope::daemon
