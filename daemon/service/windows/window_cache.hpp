#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/service/windows/packed_rows.hpp"
#include "daemon/service/windows/row_memory.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// All rows of a tag in a span, as at KnownRows.
struct KeptTag {
  std::string tag;
  bool mode = false;  ///< the values were read as modes
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
  bool before_known = false;
  PackedRows rows = {};
};

[[nodiscard]] KeptTag kept(const std::string& tag, bool mode, const KnownRows& rows);
[[nodiscard]] KnownRows known(const KeptTag& tag);

/// What was read for a loop's last slot, kept for its next one.
struct KeptWindow {
  std::shared_ptr<const config::Settings> settings;  ///< that were in force
  std::size_t facts = 0;  ///< what of catalogue and settings is in the digests, hashed
  double sample_interval_s = 0.0;
  std::int64_t slot_end_us = 0;        ///< the slot; its rows end there
  std::int64_t whole_slot_end_us = 0;  ///< the slot at which all of it was read last
  /// Slots whose stored analysis is that of these rows, with the digest of each.
  std::map<std::int64_t, std::string> digests;
  std::vector<KeptTag> tags;
  double saved_rows_per_hour = 0.0;  ///< rows that need not be read again, while the loop is here
  std::int64_t stale_us = 0;         ///< a loop that has not come by then is with others

  [[nodiscard]] std::size_t bytes() const;
  /// Whether its tags are those of the loop, in the same historian.
  [[nodiscard]] bool is_of(const storage::CatalogueEntry& loop,
                           const config::Settings& in_force) const;
};

/// The tags of a loop that are read for its windows, in the order of KeptWindow::tags.
[[nodiscard]] std::vector<TagKey> tags_of(const storage::CatalogueEntry& loop);

/// Windows kept in memory within a limit. What is kept is what saves most rows for each byte and
/// hour, never what is newest: loops come round in a circle, and the newest of more than fit are
/// always gone before they come again. Thread-safe.
class WindowCache {
 public:
  /// 0 = nothing is kept. What is too much is dropped, the least useful first.
  void limit(std::size_t bytes);
  [[nodiscard]] bool is_off() const;
  [[nodiscard]] std::shared_ptr<const KeptWindow> find(std::int64_t loop_id) const;
  /// False where a window that saves so much would not be kept, by the size that it had last.
  [[nodiscard]] bool has_use_for(std::int64_t loop_id, double saved_rows_per_hour) const;
  /// In place of what was kept of the loop; `now_us` says whose windows are stale.
  void keep(std::int64_t loop_id, KeptWindow window, std::int64_t now_us);
  void forget(std::int64_t loop_id);

  struct Size {
    std::size_t loops = 0;
    std::size_t bytes = 0;
  };
  [[nodiscard]] Size size() const;

 private:
  struct Entry {
    std::shared_ptr<const KeptWindow> window;
    std::size_t bytes = 0;
    double worth = 0.0;  ///< rows saved per byte and hour
  };
  void drop(std::int64_t loop_id);
  void drop_stale(std::size_t bytes, std::int64_t now_us);
  bool make_room(std::size_t bytes, double worth);

  mutable std::mutex mutex_;
  std::size_t limit_ = 0;
  std::size_t bytes_ = 0;
  std::unordered_map<std::int64_t, Entry> entries_;
  std::set<std::pair<double, std::int64_t>> by_worth_;        ///< worth, loop
  std::set<std::pair<std::int64_t, std::int64_t>> by_stale_;  ///< time, loop
  std::unordered_map<std::int64_t, std::size_t> refused_;     ///< bytes of windows not kept
};

}  // namespace loopscope::daemon
