#include "daemon/service/windows/window_cache.hpp"

#include <algorithm>

#include "daemon/catalogue/entry_fields.hpp"
#include "daemon/service/historians/storage_settings.hpp"

namespace loopscope::daemon {
namespace {

/// A window takes the place of another one only where it is worth so much more: sizes change a
/// little from slot to slot, and who loses his place is read whole once more.
constexpr double kWorthMore = 1.1;
/// Of the maps and the entry itself, beside the window.
constexpr std::size_t kEntryBytes = 256;

double worth_of(double saved_rows_per_hour, std::size_t bytes) {
  return saved_rows_per_hour / static_cast<double>(std::max<std::size_t>(bytes, 1));
}

}  // namespace

KeptTag kept(const std::string& tag, bool mode, const KnownRows& rows) {
  return {tag, mode, rows.from_us, rows.to_us, rows.before_known, PackedRows(rows.rows)};
}

KnownRows known(const KeptTag& tag) {
  return {tag.from_us, tag.to_us, tag.before_known, tag.rows.unpack()};
}

std::size_t KeptWindow::bytes() const {
  std::size_t sum = sizeof(*this);
  for (const auto& [end_us, digest] : digests) sum += sizeof(end_us) + digest.capacity();
  for (const KeptTag& tag : tags) sum += sizeof(tag) + tag.tag.capacity() + tag.rows.bytes();
  return sum;
}

bool KeptWindow::is_of(const storage::CatalogueEntry& loop,
                       const config::Settings& in_force) const {
  const auto same_tag = [](const KeptTag& tag, const TagKey& wanted) {
    return tag.tag == wanted.first && tag.mode == wanted.second;
  };
  const auto historian =
      std::ranges::find(settings->historians, loop.source, &config::HistorianSettings::name);
  return std::ranges::equal(tags, tags_of(loop), same_tag) &&
         historian != settings->historians.end() &&
         *historian == find_historian(in_force, loop.source);
}

std::vector<TagKey> tags_of(const storage::CatalogueEntry& loop) {
  std::vector<TagKey> tags;
  for (const TagRole& role : kTagRoles) {
    if (!(loop.*role.tag).empty()) tags.emplace_back(loop.*role.tag, role.is_mode());
  }
  return tags;
}

void WindowCache::limit(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  limit_ = bytes;
  while (bytes_ > limit_) drop(by_worth_.begin()->second);
}

bool WindowCache::is_off() const {
  const std::lock_guard lock(mutex_);
  return limit_ == 0;
}

std::shared_ptr<const KeptWindow> WindowCache::find(std::int64_t loop_id) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(loop_id);
  return found == entries_.end() ? nullptr : found->second.window;
}

bool WindowCache::has_use_for(std::int64_t loop_id, double saved_rows_per_hour) const {
  const std::lock_guard lock(mutex_);
  if (saved_rows_per_hour <= 0.0) return false;
  const auto found = refused_.find(loop_id);
  if (found == refused_.end() || bytes_ + found->second <= limit_) return true;
  return worth_of(saved_rows_per_hour, found->second) > kWorthMore * by_worth_.begin()->first;
}

void WindowCache::keep(std::int64_t loop_id, KeptWindow window, std::int64_t now_us) {
  Entry entry;
  entry.bytes = window.bytes() + kEntryBytes;
  entry.worth = worth_of(window.saved_rows_per_hour, entry.bytes);
  entry.window = std::make_shared<const KeptWindow>(std::move(window));
  const std::lock_guard lock(mutex_);
  drop(loop_id);
  drop_stale(entry.bytes, now_us);
  if (!make_room(entry.bytes, entry.worth)) {
    if (limit_ > 0) refused_[loop_id] = entry.bytes;
    return;
  }
  refused_.erase(loop_id);
  bytes_ += entry.bytes;
  by_worth_.emplace(entry.worth, loop_id);
  by_stale_.emplace(entry.window->stale_us, loop_id);
  entries_.emplace(loop_id, std::move(entry));
}

void WindowCache::forget(std::int64_t loop_id) {
  const std::lock_guard lock(mutex_);
  drop(loop_id);
}

WindowCache::Size WindowCache::size() const {
  const std::lock_guard lock(mutex_);
  return {entries_.size(), bytes_};
}

void WindowCache::drop(std::int64_t loop_id) {
  const auto found = entries_.find(loop_id);
  if (found == entries_.end()) return;
  const Entry& entry = found->second;
  bytes_ -= entry.bytes;
  by_worth_.erase({entry.worth, loop_id});
  by_stale_.erase({entry.window->stale_us, loop_id});
  entries_.erase(found);
}

void WindowCache::drop_stale(std::size_t bytes, std::int64_t now_us) {
  while (bytes_ + bytes > limit_ && !by_stale_.empty() && by_stale_.begin()->first < now_us) {
    drop(by_stale_.begin()->second);
  }
}

/// Drops what is worth less; all or nothing, so that nobody loses his place for a window that does
/// not find one.
bool WindowCache::make_room(std::size_t bytes, double worth) {
  std::vector<std::int64_t> losers;
  std::size_t left = bytes_;
  for (auto least = by_worth_.begin(); left + bytes > limit_; ++least) {
    if (least == by_worth_.end() || kWorthMore * least->first >= worth) return false;
    losers.push_back(least->second);
    left -= entries_.at(least->second).bytes;
  }
  for (const std::int64_t loop_id : losers) drop(loop_id);
  return true;
}

}  // namespace loopscope::daemon
