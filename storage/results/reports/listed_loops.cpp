#include "storage/results/reports/listed_loops.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

namespace loopscope::storage {
namespace {

/// More than verdicts, states, areas and units together; of other texts, where two meet, the later
/// one stays.
constexpr std::size_t kRecent = 4096;
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::min();

std::uint32_t number_or_none(std::optional<std::int64_t> number) {
  return static_cast<std::uint32_t>(number.value_or(0));
}

std::optional<std::int64_t> maybe_number(std::uint32_t number) {
  return number == 0 ? std::nullopt : std::optional<std::int64_t>(number);
}

}  // namespace

ListedLoops::Text ListedLoops::keep(std::optional<std::string_view> text) {
  if (!text) return {};
  recent_.resize(kRecent);
  Text& known = recent_[std::hash<std::string_view>()(*text) % kRecent];
  if (known.size != Text::kNone && told(known) == *text) return known;
  if (texts_.size() + text->size() >= Text::kNone)
    throw std::length_error("the texts of the loops take 4 GB");
  known = {static_cast<std::uint32_t>(texts_.size()), static_cast<std::uint32_t>(text->size())};
  texts_ += *text;
  return known;
}

std::string_view ListedLoops::told(Text text) const {
  return std::string_view(texts_).substr(text.at, text.size);
}

std::optional<std::string_view> ListedLoops::maybe_told(Text text) const {
  return text.size == Text::kNone ? std::nullopt : std::optional(told(text));
}

void ListedLoops::push_back(const LoopRow& row) {
  entries_.push_back({.slot_end_us = row.slot_end_us.value_or(kNever),
                      .confidence = row.confidence.value_or(std::nan("")),
                      .name = keep(row.name),
                      .area = keep(row.area),
                      .unit = keep(row.unit),
                      .description = keep(row.description),
                      .searched = keep(row.searched),
                      .state = keep(row.state),
                      .code = keep(row.code),
                      .status = keep(row.status),
                      .hidden_by = keep(row.hidden_by),
                      .health = keep(row.health),
                      .follows = keep(row.follows),
                      .shown_code = keep(row.shown_code),
                      .name_place = number_or_none(row.name_place),
                      .area_place = number_or_none(row.area_place),
                      .unit_place = number_or_none(row.unit_place),
                      .rank = number_or_none(row.rank),
                      .number = static_cast<std::uint32_t>(entries_.size()),
                      .enabled = row.enabled});
}

LoopRow ListedLoops::operator[](std::size_t number) const {
  const Entry& entry = entries_[number];
  LoopRow row;
  row.name = told(entry.name);
  row.area = maybe_told(entry.area);
  row.unit = maybe_told(entry.unit);
  row.description = maybe_told(entry.description);
  row.searched = told(entry.searched);
  row.name_place = maybe_number(entry.name_place);
  row.area_place = maybe_number(entry.area_place);
  row.unit_place = maybe_number(entry.unit_place);
  row.enabled = entry.enabled;
  row.state = told(entry.state);
  row.code = maybe_told(entry.code);
  if (!std::isnan(entry.confidence)) row.confidence = entry.confidence;
  if (entry.slot_end_us != kNever) row.slot_end_us = entry.slot_end_us;
  row.status = maybe_told(entry.status);
  row.rank = maybe_number(entry.rank);
  row.hidden_by = maybe_told(entry.hidden_by);
  row.health = told(entry.health);
  row.follows = maybe_told(entry.follows);
  row.shown_code = maybe_told(entry.shown_code);
  return row;
}

void ListedLoops::put_flagged_first() {
  // A rank of 0, none, wraps round to the largest.
  std::ranges::sort(entries_, {},
                    [](const Entry& entry) { return std::pair(entry.rank - 1U, entry.number); });
}

}  // namespace loopscope::storage
