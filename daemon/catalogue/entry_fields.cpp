#include "daemon/catalogue/entry_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "daemon/text/cells.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::kMissing;
using storage::CatalogueEntry;

template <std::string CatalogueEntry::*member>
std::string read_text(const CatalogueEntry& entry) {
  return entry.*member;
}

template <std::string CatalogueEntry::*member>
void write_text(CatalogueEntry& entry, std::string_view text) {
  entry.*member = std::string(text);
}

double number_in(std::string_view text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value)) {
    throw std::invalid_argument(fmt::format("\"{}\" is not a number", text));
  }
  return *value;
}

struct Limits {
  double low;
  double high;
  const char* unit;
};

/// A period under a second only floods the results; beyond a month nothing is monitored.
constexpr Limits kPeriod{1.0, 2'592'000.0, "s"};
constexpr Limits kInterval{0.001, 86'400.0, "s"};
constexpr Limits kImportance{0.001, 1000.0, "(factor)"};

double limited_number_in(std::string_view text, const Limits& limits) {
  const double value = number_in(text);
  if (value >= limits.low && value <= limits.high) return value;
  throw std::invalid_argument(
      fmt::format("{} is out of range, {} to {} {}", text, limits.low, limits.high, limits.unit));
}

template <double CatalogueEntry::*member>
std::string read_number(const CatalogueEntry& entry) {
  return fmt::format("{}", entry.*member);
}

template <double CatalogueEntry::*member, const Limits& range>
void write_limited(CatalogueEntry& entry, std::string_view text) {
  entry.*member = limited_number_in(text, range);
}

std::string read_interval(const CatalogueEntry& entry) {
  return entry.interval_s ? fmt::format("{}", *entry.interval_s) : std::string();
}

void write_interval(CatalogueEntry& entry, std::string_view text) {
  entry.interval_s.reset();
  if (!trimmed(text).empty()) entry.interval_s = limited_number_in(text, kInterval);
}

using EntryRange = std::optional<core::signal::OpRange>;

template <EntryRange CatalogueEntry::*range, double core::signal::OpRange::*end>
std::string read_end(const CatalogueEntry& entry) {
  return entry.*range ? fmt::format("{}", *(entry.*range).*end) : std::string();
}

/// The ends come one after the other; check_entry() sees to it that both came.
template <EntryRange CatalogueEntry::*range, double core::signal::OpRange::*end>
void write_end(CatalogueEntry& entry, std::string_view text) {
  if (trimmed(text).empty()) {
    (entry.*range).reset();
    return;
  }
  if (!(entry.*range)) entry.*range = core::signal::OpRange{kMissing, kMissing};
  *(entry.*range).*end = number_in(text);
}

std::string read_enabled(const CatalogueEntry& entry) {
  return entry.enabled ? "true" : "false";
}

void write_enabled(CatalogueEntry& entry, std::string_view text) {
  for (const std::string_view word : {"true", "yes", "1", "t"}) {
    if (same_word(trimmed(text), word)) return void(entry.enabled = true);
  }
  for (const std::string_view word : {"false", "no", "0", "f"}) {
    if (same_word(trimmed(text), word)) return void(entry.enabled = false);
  }
  throw std::invalid_argument(fmt::format("\"{}\" is neither true nor false", text));
}

using core::signal::OpRange;

constexpr std::array kFields{
    EntryField{"name", "unique name", read_text<&CatalogueEntry::name>,
               write_text<&CatalogueEntry::name>},
    EntryField{"source", "name of the historian in the settings",
               read_text<&CatalogueEntry::source>, write_text<&CatalogueEntry::source>},
    EntryField{"sp_tag", "setpoint tag", read_text<&CatalogueEntry::sp_tag>,
               write_text<&CatalogueEntry::sp_tag>},
    EntryField{"pv_tag", "process variable tag", read_text<&CatalogueEntry::pv_tag>,
               write_text<&CatalogueEntry::pv_tag>},
    EntryField{"op_tag", "controller output tag", read_text<&CatalogueEntry::op_tag>,
               write_text<&CatalogueEntry::op_tag>},
    EntryField{"mv_tag", "valve position tag", read_text<&CatalogueEntry::mv_tag>,
               write_text<&CatalogueEntry::mv_tag>},
    EntryField{"mode_tag", "mode tag (0 manual, 1 automatic, 2 cascade)",
               read_text<&CatalogueEntry::mode_tag>, write_text<&CatalogueEntry::mode_tag>},
    EntryField{"interval_s", "sample interval, 0.001 to 86400 seconds; empty = found from the rows",
               read_interval, write_interval},
    EntryField{"period_s", "seconds between two analyses, 1 to 2592000",
               read_number<&CatalogueEntry::period_s>,
               write_limited<&CatalogueEntry::period_s, kPeriod>},
    EntryField{"op_low", "controller output at 0 %",
               read_end<&CatalogueEntry::op_range, &OpRange::low>,
               write_end<&CatalogueEntry::op_range, &OpRange::low>},
    EntryField{"op_high", "controller output at 100 %",
               read_end<&CatalogueEntry::op_range, &OpRange::high>,
               write_end<&CatalogueEntry::op_range, &OpRange::high>},
    EntryField{"loop_type", "flow, pressure, temperature, ...; level = integrating",
               read_text<&CatalogueEntry::loop_type>, write_text<&CatalogueEntry::loop_type>},
    EntryField{"importance", "weight in the ranking, 0.001 to 1000",
               read_number<&CatalogueEntry::importance>,
               write_limited<&CatalogueEntry::importance, kImportance>},
    EntryField{"enabled", "true or false", read_enabled, write_enabled},
    EntryField{"area", "area of the plant", read_text<&CatalogueEntry::area>,
               write_text<&CatalogueEntry::area>},
    EntryField{"unit", "process unit within the area", read_text<&CatalogueEntry::unit>,
               write_text<&CatalogueEntry::unit>},
    EntryField{"description", "what the loop controls", read_text<&CatalogueEntry::description>,
               write_text<&CatalogueEntry::description>},
    EntryField{"pv_unit", "unit of sp and pv, such as m3/h", read_text<&CatalogueEntry::pv_unit>,
               write_text<&CatalogueEntry::pv_unit>},
    EntryField{"owner", "who is responsible for the loop", read_text<&CatalogueEntry::owner>,
               write_text<&CatalogueEntry::owner>},
    EntryField{"pv_low", "pv at 0 % of its transmitter",
               read_end<&CatalogueEntry::pv_range, &OpRange::low>,
               write_end<&CatalogueEntry::pv_range, &OpRange::low>},
    EntryField{"pv_high", "pv at 100 % of its transmitter",
               read_end<&CatalogueEntry::pv_range, &OpRange::high>,
               write_end<&CatalogueEntry::pv_range, &OpRange::high>},
};

}  // namespace

std::span<const EntryField> entry_fields() {
  return kFields;
}

const EntryField* find_entry_field(std::string_view name) {
  for (const EntryField& field : kFields) {
    if (same_word(field.name, trimmed(name))) return &field;
  }
  return nullptr;
}

bool can_be_empty(const EntryField& field) {
  constexpr std::string_view kFilled[] = {"source", "period_s", "importance", "enabled"};
  return std::find(std::begin(kFilled), std::end(kFilled), field.name) == std::end(kFilled);
}

void check_entry(const CatalogueEntry& entry) {
  // An entry of the index on names has no room for more than some 2700 bytes.
  constexpr std::size_t kLongestName = 1000;
  if (entry.name.empty()) throw std::invalid_argument("the name is empty");
  if (entry.name.size() > kLongestName) {
    throw std::invalid_argument(
        fmt::format("the name has {} bytes, {} are the most", entry.name.size(), kLongestName));
  }
  if (entry.pv_tag.empty()) throw std::invalid_argument("the pv tag is empty");
  static_cast<void>(limited_number_in(fmt::format("{}", entry.period_s), kPeriod));
  if (entry.interval_s) {
    static_cast<void>(limited_number_in(fmt::format("{}", *entry.interval_s), kInterval));
  }
  if (entry.op_range && !(entry.op_range->low < entry.op_range->high)) {
    throw std::invalid_argument("op_low and op_high need both ends, low below high");
  }
  if (entry.pv_range && !(entry.pv_range->low < entry.pv_range->high)) {
    throw std::invalid_argument("pv_low and pv_high need both ends, low below high");
  }
}

}  // namespace loopscope::daemon
