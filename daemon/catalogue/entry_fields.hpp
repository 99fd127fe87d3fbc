#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/signal/assemble.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// One field of a catalogue entry as users write it: the column of the CSV and, with `_` as `-`,
/// the option of `loops add` and `loops set`.
struct EntryField {
  std::string_view name;
  std::string_view description;
  std::string (*read)(const storage::CatalogueEntry& entry);
  /// Throws std::invalid_argument naming what the text is not.
  void (*write)(storage::CatalogueEntry& entry, std::string_view text);
};

/// Every field that users may set, in the order of the CSV.
[[nodiscard]] std::span<const EntryField> entry_fields();

/// The field of that name; nullptr when there is none.
[[nodiscard]] const EntryField* find_entry_field(std::string_view name);

/// Whether an empty text says "none" for this field (a tag, a range); where it cannot, an empty
/// cell leaves the field as it is.
[[nodiscard]] bool can_be_empty(const EntryField& field);

/// Rules for the whole entry: a name of at most 1000 bytes, a pv tag, period and interval in range
/// (CatalogueEntry), both ends of the op and of the pv range or none, low below high. Throws
/// std::invalid_argument.
void check_entry(const storage::CatalogueEntry& entry);

/// What a tag is to its loop, in the words of the CSV, the settings and the results.
struct TagRole {
  std::string_view name;
  std::string storage::CatalogueEntry::*tag;
  core::signal::RawSeries core::signal::LoopRows::*rows;
  bool on_change;  ///< recorded when it changes, whatever the archive: it holds between its rows

  /// Whether its values are read as modes.
  [[nodiscard]] constexpr bool is_mode() const { return rows == &core::signal::LoopRows::mode; }
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
