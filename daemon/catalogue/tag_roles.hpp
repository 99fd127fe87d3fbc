#pragma once

#include <string>
#include <string_view>

#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// What a tag is to its loop, in the words of the CSV, the settings and the results.
struct TagRole {
  std::string_view name;
  std::string storage::CatalogueEntry::*tag;
};

inline constexpr TagRole kTagRoles[] = {
    {"sp", &storage::CatalogueEntry::sp_tag},     {"pv", &storage::CatalogueEntry::pv_tag},
    {"op", &storage::CatalogueEntry::op_tag},     {"mv", &storage::CatalogueEntry::mv_tag},
    {"mode", &storage::CatalogueEntry::mode_tag},
};

}  // namespace loopscope::daemon
