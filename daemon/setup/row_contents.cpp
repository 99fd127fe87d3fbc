#include "daemon/setup/row_contents.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <string_view>

#include "daemon/setup/column_roles.hpp"

namespace loopscope::daemon {
namespace {

using storage::CountedTexts;
using storage::SeenColumn;

constexpr std::int64_t kOpcDaGood = 192;
constexpr std::int64_t kUncertainStatus = std::int64_t{1} << 30;  // OPC UA, severity 1
constexpr std::int64_t kLargestByte = 255;

std::int64_t number_of(const std::string& text) {
  std::int64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

bool holds(const std::string& text, std::string_view words) {
  return lower(text).find(words) != std::string::npos;
}

template <typename Test>
bool any_code(const CountedTexts& codes, Test test) {
  return std::ranges::any_of(codes, [&](const auto& code) { return test(number_of(code.first)); });
}

std::string list_of(const CountedTexts& codes) {
  std::vector<std::string> texts;
  for (const auto& [code, rows] : codes) texts.push_back(code);
  texts.resize(std::min<std::size_t>(texts.size(), 8));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// The commonest for good, the others for bad.
QualityGuess commonest(const CountedTexts& codes) {
  QualityGuess guess{"codes", {codes.front().first}, {}, {}, ""};
  for (std::size_t k = 1; k < codes.size(); ++k) guess.bad_codes.push_back(codes[k].first);
  return guess;
}

/// 0 is good by OPC UA, and in a recorder's own codes.
QualityGuess of_zeros(const SeenColumn& column) {
  const bool status = holds(column.name, "statuscode") || holds(column.name, "opcua");
  return {status ? "opcua" : "zero", {}, {}, {}, ""};
}

QualityGuess of_numbers(const SeenColumn& column, const CountedTexts& codes) {
  if (any_code(codes, [](auto q) { return q < 0 || q >= kUncertainStatus; }))
    return {"opcua", {}, {}, {}, ""};
  if (any_code(codes, [](auto q) { return (q & kOpcDaGood) == kOpcDaGood; })) {
    const bool has_more = any_code(codes, [](auto q) { return q > kLargestByte; });
    return {has_more ? "opchda" : "opcda", {}, {}, {}, ""};
  }
  const std::string& usual = codes.front().first;
  if (usual == "0") return of_zeros(column);
  QualityGuess guess = commonest(codes);
  const bool truth = usual == "1" && !any_code(codes, [](auto q) { return q > 1; });
  if (!truth) {
    guess.note = fmt::format(
        "quality codes seen: {}; {} is the commonest and counts as good: review good_codes",
        list_of(codes), usual);
  }
  return guess;
}

QualityGuess of_words(const CountedTexts& codes) {
  QualityGuess guess{"codes", {}, {}, {}, ""};
  for (const auto& [code, rows] : codes) {
    const std::string word = lower(code);
    const bool good = word.starts_with("good") || word.starts_with("ok") || word == "192";
    const bool uncertain = word.starts_with("uncertain");
    (good ? guess.good_codes : uncertain ? guess.uncertain_codes : guess.bad_codes).push_back(code);
  }
  if (!guess.good_codes.empty()) return guess;
  guess = commonest(codes);
  guess.note = fmt::format(
      "quality words seen: {}; the first is the commonest and counts as good: review good_codes",
      list_of(codes));
  return guess;
}

}  // namespace

QualityGuess guess_quality(const SeenColumn& column, const CountedTexts& codes) {
  const ColumnKind kind = kind_of(column);
  if (kind == ColumnKind::truth) return {"truth", {}, {}, {}, ""};
  if (codes.empty()) {
    if (kind != ColumnKind::whole)
      return {"none", {}, {}, {}, "no row has a quality yet: every value counts as good"};
    return {"opcda", {}, {}, {}, "no row has a quality yet: OPC DA is taken for granted"};
  }
  return kind == ColumnKind::whole ? of_numbers(column, codes) : of_words(codes);
}

TimeGuess guess_epoch(const CountedTexts& times) {
  // The year 2001 is 1e9 s.
  constexpr double kMostSeconds = 1e11, kStep = 1e3;
  double largest = 0.0;
  for (const auto& [time, rows] : times)
    largest = std::max(largest, std::abs(static_cast<double>(number_of(time))));
  if (largest <= 0.0)
    return {"epoch_ms", "no row has a time yet: milliseconds since 1970 are taken"};
  if (largest < kMostSeconds) return {"epoch_s", ""};
  if (largest < kMostSeconds * kStep) return {"epoch_ms", ""};
  return {largest < kMostSeconds * kStep * kStep ? "epoch_us" : "epoch_ns", ""};
}

TimeGuess guess_zone(std::optional<double> behind_utc_s) {
  constexpr double kAhead_s = -600.0, kRecent_s = 1800.0, kHour_s = 3600.0, kFarthest_h = 13.0;
  if (!behind_utc_s) {
    return {"timestamp_utc",
            "whether the times are UTC could not be seen: else timestamp_local and time_zone"};
  }
  const double hours = *behind_utc_s / kHour_s;
  if (*behind_utc_s < kAhead_s) {
    return {"timestamp_local",
            fmt::format("the newest time lies {:.1f} h ahead of UTC, so times are local", -hours)};
  }
  if (*behind_utc_s < kRecent_s || hours > kFarthest_h) return {"timestamp_utc", ""};
  return {
      "timestamp_utc",
      fmt::format("the newest time lies {:.1f} h behind UTC: if it was recorded just now, times "
                  "are local: timestamp_local and time_zone",
                  hours)};
}

}  // namespace loopscope::daemon
