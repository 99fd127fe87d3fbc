#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::storage {

/// Any loop of the catalogue in one line. The texts are those of the ListedLoops that it is from.
struct LoopRow {
  std::string_view name;
  std::optional<std::string_view> area, unit, description;
  /// Name, description and owner in small letters, as the database has them.
  std::string_view searched;
  /// Places in the order of the database's collation, whatever the case, 1 and more; equal texts
  /// have one place. nullopt = the loop has none.
  std::optional<std::int64_t> name_place, area_place, unit_place;
  bool enabled = false;
  std::string_view state;  ///< flagged, off the list, not flagged, never analysed, disabled
  std::optional<std::string_view> code;     ///< nullopt = never analysed, as the next two
  std::optional<double> confidence;         ///< 0 to 1
  std::optional<std::int64_t> slot_end_us;  ///< microseconds UTC since 1970
  std::optional<std::string_view> status;   ///< watch or confirmed; nullopt = not flagged
  std::optional<std::int64_t> rank;         ///< in flagged_loop, 1 and more
  /// Why a fault is not flagged, in words; nullopt = flagged, or no fault.
  std::optional<std::string_view> hidden_by;
  std::string_view health;                     ///< state of monitor_health
  std::optional<std::string_view> follows;     ///< the shared oscillation, in words; nullopt = none
  std::optional<std::string_view> shown_code;  ///< as FollowedRow::shown_code
};

/// The loops of a catalogue of a hundred thousand and more in 136 bytes each and their texts, of
/// which equal ones are mostly kept once.
class ListedLoops {
 public:
  class Iterator {
   public:
    using difference_type = std::ptrdiff_t;
    using value_type = LoopRow;
    Iterator() = default;
    Iterator(const ListedLoops& rows, std::size_t number) : rows_(&rows), number_(number) {}
    LoopRow operator*() const { return (*rows_)[number_]; }
    Iterator& operator++() {
      ++number_;
      return *this;
    }
    Iterator operator++(int) {
      Iterator before = *this;
      ++number_;
      return before;
    }
    bool operator==(const Iterator&) const = default;

   private:
    const ListedLoops* rows_ = nullptr;
    std::size_t number_ = 0;
  };

  /// Keeps its texts. Throws std::length_error beyond 4 GB of them.
  void push_back(const LoopRow& row);
  /// Those with a rank first, by that; the others stay in their order.
  void put_flagged_first();
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  /// Good as long as this is and stays where it is, and until the next push_back(), which must not
  /// be given one of them.
  [[nodiscard]] LoopRow operator[](std::size_t number) const;
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size()}; }

 private:
  struct Text {
    std::uint32_t at = 0;
    std::uint32_t size = kNone;
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  };
  /// 0 = none of a rank or a place, NaN of the confidence, the lowest of slot_end_us.
  struct Entry {
    std::int64_t slot_end_us = 0;
    double confidence = 0.0;
    Text name, area, unit, description, searched, state, code, status, hidden_by, health, follows,
        shown_code;
    std::uint32_t name_place = 0, area_place = 0, unit_place = 0, rank = 0;
    std::uint32_t number = 0;  // of push_back()
    bool enabled = false;
  };
  [[nodiscard]] Text keep(std::optional<std::string_view> text);
  [[nodiscard]] std::string_view told(Text text) const;
  [[nodiscard]] std::optional<std::string_view> maybe_told(Text text) const;

  std::deque<Entry> entries_;  // grows without a second one beside it
  std::string texts_;          // one behind the other
  std::vector<Text> recent_;   // by hash, the last of each
};

}  // namespace loopscope::storage
