#pragma once

#include <string>
#include <string_view>

#include "core/signal/assemble.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// What a tag is to its loop, in the words of the CSV, the settings and the results.
struct TagRole {
  std::string_view name;
  std::string storage::CatalogueEntry::*tag;
  core::signal::RawSeries core::signal::LoopRows::*rows;
  bool on_change;  ///< recorded when it changes, whatever the archive: it holds between its rows
};

/// All of them: the one list of roles in this room.
inline constexpr TagRole kTagRoles[] = {
    {"sp", &storage::CatalogueEntry::sp_tag, &core::signal::LoopRows::sp, true},
    {"pv", &storage::CatalogueEntry::pv_tag, &core::signal::LoopRows::pv, false},
    {"op", &storage::CatalogueEntry::op_tag, &core::signal::LoopRows::op, false},
    {"mv", &storage::CatalogueEntry::mv_tag, &core::signal::LoopRows::mv, false},
    {"mode", &storage::CatalogueEntry::mode_tag, &core::signal::LoopRows::mode, true},
};

}  // namespace loopscope::daemon
