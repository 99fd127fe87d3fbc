#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/signal/loop_window.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// Something that the catalogue lacks, or that its history contradicts.
struct Proposal {
  std::string loop;
  std::string fields;  ///< "op_low=0 op_high=1"; empty = nothing to fill in, a person has to look
  std::string reason;
  std::function<void(storage::CatalogueEntry&)> apply = nullptr;  ///< null = nothing to fill in
  /// What a person may answer, as options of `loops set`: "--op-low=0 --op-high=1".
  std::vector<std::string> answers = {};
};

/// Values of the tags of a loop over its history, as far as it was looked at.
struct LoopValues {
  core::signal::Samples pv, op;  ///< as recorded, in any order, finite; empty = nothing recorded
};

/// What history and name propose for a loop: op's range where it is clear (0 to 1, a current, 0 to
/// 100 that cannot be a current), a doubt of one that was set, pv's range as a question, and the
/// loop type after ISA 5.1. Nothing that a person has set is replaced.
[[nodiscard]] std::vector<Proposal> propose(const storage::CatalogueEntry& entry,
                                            const LoopValues& values);

/// Puts what can be filled in into the entry.
void fill_in(std::span<const Proposal> proposals, storage::CatalogueEntry& entry);

}  // namespace loopscope::daemon
