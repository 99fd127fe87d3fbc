#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace loopscope::storage {

/// A place in the order in which loops are claimed: schedule.visible_at, then loop_id.
struct DuePlace {
  std::int64_t due_us = 0;  ///< microseconds UTC
  std::int64_t loop_id = 0;
  // NOLINTNEXTLINE(modernize-use-nullptr): the 0 that the result is compared with is no pointer
  auto operator<=>(const DuePlace&) const = default;
};

/// Before everything: the earliest time that PostgreSQL knows.
inline constexpr DuePlace kBeforeAll{-210'866'803'200'000'000, 0};
/// Behind whatever is due at `time_us`.
[[nodiscard]] constexpr DuePlace behind(std::int64_t time_us) {
  return {time_us, std::numeric_limits<std::int64_t>::max()};
}

/// Where claims begin to look. Each claim and each completion leaves an entry behind in the index
/// of due loops; as long as a snapshot of anybody's is older than these, nothing can remove them,
/// and a scan from the head passes all of them. What was claimed lies at the head, so a claim
/// begins behind the last loop that the one before it has found.
///
/// Loops may come to lie before the watermark all the same: a claim that was rolled back, a
/// transaction that took long, a clock that was set back. look_back() finds them, in slices of time
/// whose cost does not depend on the age of the snapshot either, and lowers the watermark.
/// Thread-safe.
class ClaimWatermark {
 public:
  /// Where a claim begins, to be handed to passed() with what it found.
  struct Start {
    DuePlace place;
    std::uint64_t lowered = 0;
  };
  /// `now_us` is the time of the transaction: a watermark seconds beyond it comes of a clock that
  /// was ahead, and begins anew there, as the first one does.
  [[nodiscard]] Start start(std::int64_t now_us);
  /// Everything due up to `last` has been taken; says nothing where the watermark was lowered
  /// since.
  void passed(const Start& start, DuePlace last);
  /// A loop that is due lies there. Says nothing where it does not lie before the floor.
  void lower(DuePlace found);
  /// nullopt: nobody has begun yet.
  [[nodiscard]] std::optional<DuePlace> place() const;
  /// Everything before `place` is taken for certain; nullopt says nothing.
  void raise_to(std::optional<DuePlace> place);

  /// Loops due from `from_us` (microseconds UTC) on, up to and with `to`.
  struct Slice {
    std::int64_t from_us = 0;
    DuePlace to;
  };
  /// The minute before the watermark: where a loop that is missed most probably lies.
  [[nodiscard]] Slice nearest() const;
  /// Before it a new walk back in time begins, where none is under way.
  void looked_nearest(const Slice& nearest);
  /// The next slice of the walk, down to the beginning of time.
  [[nodiscard]] Slice next() const;
  /// The slice of next() was looked through in so many seconds of the server's, which decides how
  /// wide the one after it is. True: it reached the beginning of time.
  bool looked(const Slice& slice, double seconds);

 private:
  mutable std::mutex mutex_;
  std::optional<DuePlace> place_;
  std::uint64_t lowered_ = 0;
  std::optional<std::int64_t> looked_down_to_us_;  ///< nullopt = begin at the watermark
  std::optional<std::int64_t> width_us_;
};

/// The watermarks of a process, whatever its connections. Claims that leave out sources have one of
/// their own for each list of these, because the loops of these stay where they are. Thread-safe.
class ClaimWatermarks {
 public:
  /// Stays valid as long as this object.
  [[nodiscard]] ClaimWatermark& of(const std::vector<std::string>& but_of);

 private:
  ClaimWatermark all_;
  std::mutex mutex_;
  std::map<std::vector<std::string>, ClaimWatermark> elsewhere_;
};

}  // namespace loopscope::storage
