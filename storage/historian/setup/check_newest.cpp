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

namespace loopscope::storage {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
// Without an index on the time alone the newest row needs a scan of the span: look at a week.
constexpr std::int64_t kRecentUs = std::int64_t{7} * 86'400 * kSecondUs;

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

/// Of the tag of the newest row (parts of its key, then its time); nullopt = too few rows.
std::optional<Pace> pace_before(PqConnection& connection, const ResolvedLayout& layout,
                                const PqRows& newest, std::int64_t newest_us) {
  const TimeKind kind = layout.layout.time_kind;
  const int parts = static_cast<int>(layout.key.size());
  std::vector<std::string> parameters;
  for (int part = 0; part < parts; ++part) parameters.push_back(newest.text(0, part));
  parameters.push_back(native_bound(kind, newest_us - kPaceSpanUs, Bound::lower));
  parameters.push_back(native_bound(kind, newest_us, Bound::upper));
  parameters.push_back(std::to_string(kPaceRows));
  const auto rows = run_if_quick(
      connection, historian_statements::times_of_key(layout, layout.data.sql), parameters);
  if (!rows) return std::nullopt;
  std::vector<std::int64_t> gaps = gaps_of(*rows, kind);
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

Finding judge_age(PqConnection& connection, const ResolvedLayout& layout, const PqRows& newest,
                  std::int64_t newest_us, std::int64_t age_us) {
  const std::string when = "the newest row is of " + second_text(newest_us) + ", " +
                           in_words(age_us) + " ago, " + layout.data.sql;
  if (age_us <= kLateUs) return {true, when, "", false};
  const std::optional<Pace> pace = pace_before(connection, layout, newest, newest_us);
  if (!pace || age_us <= kBeyond * pace->longest_us) return {true, when, "", false};
  return {true, "rows of a tag come every " + in_words(pace->usual_us) + ", and " + when,
          "either the recording stands still, or its times are of another time zone (`loopscope "
          "init --time-zone`, `time_zone` in the settings)",
          true};
}

}  // namespace

Finding check_newest(PqConnection& connection, const ResolvedLayout& layout, std::int64_t now_us) {
  const TimeKind kind = layout.layout.time_kind;
  const std::optional<PqRows> found =
      run_if_quick(connection, historian_statements::newest_row(layout, layout.data.sql),
                   {native_bound(kind, now_us - kRecentUs, Bound::lower),
                    native_bound(kind, kLatestTimeUs, Bound::upper)});
  if (!found) {
    return {true, "the newest row was not found in time, " + layout.data.sql,
            "it is only this check that wants an index on the time alone", true};
  }
  if (found->size() == 0) {
    return {true, "no row is younger than a week, " + layout.data.sql,
            "check that the historian records, and `time_kind`", true};
  }
  const std::int64_t newest_us =
      microseconds(kind, decode_value(found->bytes(0, static_cast<int>(layout.key.size()))));
  if (newest_us > now_us) {
    return {
        true,
        "the newest row lies in the future, at " + second_text(newest_us) + ", " + layout.data.sql,
        "check `time_kind`, the time zone of the recorder and its clock", true};
  }
  return judge_age(connection, layout, *found, newest_us, now_us - newest_us);
}

}  // namespace loopscope::storage
