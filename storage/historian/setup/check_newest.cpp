#include "storage/historian/setup/check_newest.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/text/phrases.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
// Without an index on the time alone the newest row needs a scan of the span: look at a week.
constexpr std::int64_t kRecentUs = std::int64_t{7} * 86'400 * kSecondUs;

// Clocks that went wrong say 2036 or 2099. The end of the calendar is no bound to send: in local
// time it lies in the year 10000, which the DATETIME of MySQL and MariaDB does not have.
constexpr std::int64_t kFutureUs = std::int64_t{100} * 366 * 86'400 * kSecondUs;

// A day, since a tag that is stored on change may be quiet at night; every 5 s has 17 280 rows.
constexpr std::int64_t kPaceSpanUs = 86'400 * kSecondUs;
constexpr std::int64_t kPaceRows = 20'000;
// Of rows at random times, as a tag that is stored on change has them, the time since the newest
// one exceeds k times the longest of n times between rows with the chance n! k! / (n + k)!: of 100
// and 3 less than 1 in 100 000.
constexpr std::size_t kFewestGaps = 100;
constexpr std::int64_t kBeyond = 3;
// Rows that a collector sends in batches come so late; zones differ by a quarter of an hour.
constexpr std::int64_t kLateUs = 600 * kSecondUs;

/// Times between the rows of a tag.
struct Pace {
  std::int64_t usual_us = 0, longest_us = 0;
};

/// nullopt when the server gave up, perhaps for want of an index: nothing is wrong with that.
std::optional<PqRows> run_if_quick(PqConnection& connection, const Statement& statement,
                                   const std::vector<std::string>& parameters) {
  constexpr const char* kQueryCanceled = "57014";
  try {
    return connection.run(statement, parameters, ResultFormat::binary);
  } catch (const DatabaseError& error) {
    if (error.sqlstate() == kQueryCanceled) return std::nullopt;
    throw;
  }
}

std::vector<std::int64_t> gaps_of(const PqRows& rows, TimeKind kind) {
  std::vector<std::int64_t> gaps;
  for (int row = 1; row < rows.size(); ++row) {
    const std::int64_t gap = microseconds(kind, decode_value(rows.bytes(row - 1, 0))) -
                             microseconds(kind, decode_value(rows.bytes(row, 0)));
    if (gap > 0) gaps.push_back(gap);
  }
  return gaps;
}

/// Times of the rows of a tag, newest first; `key` has the parts of its key as text.
std::optional<PqRows> times_of(PqConnection& connection, const ResolvedLayout& layout,
                               const PqRows& key, std::int64_t from_us, std::int64_t to_us,
                               std::int64_t most) {
  const TimeKind kind = layout.layout.time_kind;
  const int parts = static_cast<int>(layout.key.size());
  std::vector<std::string> parameters;
  for (int part = 0; part < parts; ++part) parameters.push_back(key.text(0, part));
  parameters.push_back(native_bound(kind, from_us, Bound::lower));
  parameters.push_back(native_bound(kind, to_us, Bound::upper));
  parameters.push_back(std::to_string(most));
  return run_if_quick(connection, historian_statements::times_of_key(layout, layout.data.sql),
                      parameters);
}

/// A newest row: parts of its key; whether there is one, its time.
struct Newest {
  PqRows key;
  std::optional<std::int64_t> time_us;
  std::string whose;  ///< "row" or "row of TIC101"
};

/// nullopt = not found in time.
std::optional<Newest> newest_of_table(PqConnection& connection, const ResolvedLayout& layout,
                                      std::int64_t now_us) {
  const TimeKind kind = layout.layout.time_kind;
  std::optional<PqRows> found =
      run_if_quick(connection, historian_statements::newest_row(layout, layout.data.sql),
                   {native_bound(kind, now_us - kRecentUs, Bound::lower),
                    native_bound(kind, now_us + kFutureUs, Bound::upper)});
  if (!found) return std::nullopt;
  std::optional<std::int64_t> time_us;
  if (found->size() > 0)
    time_us =
        microseconds(kind, decode_value(found->bytes(0, static_cast<int>(layout.key.size()))));
  return Newest{*std::move(found), time_us, "row"};
}

/// A server elsewhere would have to read and sort the week of all tags, and no deadline ends that.
std::optional<Newest> newest_of_some_tag(PqConnection& connection, const ResolvedLayout& layout,
                                         std::int64_t now_us) {
  PqRows key = connection.run(historian_statements::any_row(layout, layout.data.sql), {},
                              ResultFormat::binary);
  if (key.size() == 0) return Newest{std::move(key), std::nullopt, "row"};
  const auto times = times_of(connection, layout, key, now_us - kRecentUs, now_us + kFutureUs, 1);
  if (!times) return std::nullopt;
  std::string whose = "row of";
  for (int part = 0; part < static_cast<int>(layout.key.size()); ++part)
    whose += " " + make_storable(key.text(0, part));
  std::optional<std::int64_t> time_us;
  if (times->size() > 0)
    time_us = microseconds(layout.layout.time_kind, decode_value(times->bytes(0, 0)));
  return Newest{std::move(key), time_us, whose};
}

/// Of the tag of the newest row; nullopt = too few rows.
std::optional<Pace> pace_before(PqConnection& connection, const ResolvedLayout& layout,
                                const Newest& newest) {
  const std::int64_t newest_us = newest.time_us.value();
  const auto rows =
      times_of(connection, layout, newest.key, newest_us - kPaceSpanUs, newest_us, kPaceRows);
  if (!rows) return std::nullopt;
  std::vector<std::int64_t> gaps = gaps_of(*rows, layout.layout.time_kind);
  if (gaps.size() < kFewestGaps) return std::nullopt;
  std::ranges::sort(gaps);
  return Pace{gaps[gaps.size() / 2], gaps.back()};
}

std::string in_words(std::int64_t time_us) {
  return core::text::duration(static_cast<double>(time_us) / kSecondUs);
}

/// Nobody reads microseconds.
std::string second_text(std::int64_t time_us) {
  const std::string text = timestamp_text(time_us);
  return text.substr(0, text.find('.')) + " UTC";
}

Finding judge_age(PqConnection& connection, const ResolvedLayout& layout, const Newest& newest,
                  std::int64_t age_us) {
  const std::string when = "the newest " + newest.whose + " is of " +
                           second_text(newest.time_us.value()) + ", " + in_words(age_us) +
                           " ago, " + layout.data.sql;
  if (age_us <= kLateUs) return {true, when, "", false};
  const std::optional<Pace> pace = pace_before(connection, layout, newest);
  if (!pace || age_us <= kBeyond * pace->longest_us) return {true, when, "", false};
  return {true, "rows of a tag come every " + in_words(pace->usual_us) + ", and " + when,
          "either the recording stands still, or its times are of another time zone (`loopscope "
          "init --time-zone`, `time_zone` in the settings)",
          true};
}

}  // namespace

Finding check_newest(PqConnection& connection, const ResolvedLayout& layout, std::int64_t now_us) {
  const bool by_tag = layout.foreign && !layout.key.empty();
  const std::optional<Newest> newest = by_tag ? newest_of_some_tag(connection, layout, now_us)
                                              : newest_of_table(connection, layout, now_us);
  if (!newest) {
    return {true, "the newest row was not found in time, " + layout.data.sql,
            "it is only this check that wants an index on the time alone", true};
  }
  if (!newest->time_us) {
    return {true, "no " + newest->whose + " is younger than a week, " + layout.data.sql,
            "check that the historian records, and `time_kind`", true};
  }
  if (*newest->time_us > now_us) {
    return {true,
            "the newest " + newest->whose + " lies in the future, at " +
                second_text(*newest->time_us) + ", " + layout.data.sql,
            "check `time_kind`, the time zone of the recorder and its clock", true};
  }
  return judge_age(connection, layout, *newest, now_us - *newest->time_us);
}

}  // namespace loopscope::storage
