#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/signal/raw_series.hpp"
#include "storage/historian/mode_codes.hpp"

namespace loopscope::storage {

/// What one row of the historian's table holds.
enum class Shape {
  narrow,    ///< one value of one tag: tag, time, value
  loop_row,  ///< several values of one loop or device: key, time, one column per value
  wide,      ///< one value of every tag: time, one column per tag
};

/// How the historian's time column counts.
enum class TimeKind {
  timestamptz,
  timestamp_utc,    ///< without time zone, in UTC
  timestamp_local,  ///< without time zone, in the layout's `time_zone`
  epoch_s,
  epoch_s_float,
  epoch_ms,
  epoch_us,
  epoch_ns,
};

/// How a quality code reads as good, bad or unknown.
enum class QualityRule {
  none,         ///< no quality column: every finite value is good
  opcda,        ///< (q & 0xC0): 0xC0 good, 0x40 uncertain, 0x00 bad
  opcda_exact,  ///< 192 is good, everything else bad
  opcua,        ///< bits 30 and 31: 0 good, 1 uncertain, 2 bad; interpolated values are no data
  opchda,       ///< as opcda, without values that were interpolated or calculated
  zero,         ///< 0 is good
  truth,        ///< a boolean column, true is good
  codes,        ///< lists of codes or, with a side table, of their names
};

/// A table beside the data that gives names to ids.
struct SideTable {
  std::string relation;     ///< [schema.]table or view
  std::string name_column;  ///< what a tag is compared with
  std::string id_column;    ///< what the data refer to
};

/// One column of the key that a tag stands for. A tag may have several ids (its type was changed,
/// it was deleted and made again): their rows are read together, those of later ids winning.
struct KeyPart {
  std::string column;
  std::optional<SideTable> names;  ///< nullopt = the column holds the tag itself
  bool ignore_case = false;        ///< of the names
  std::string order_column;        ///< of the side table: ids in the order in which they were made
  std::string hold_column;         ///< of the side table: how the tag is archived
};

/// A table that lists the tables of the data by time; its times are in the unit of the data's.
struct PartitionList {
  std::string relation;
  std::string name_column;
  std::string start_column;
  std::string end_column;
};

struct QualityDecoder {
  QualityRule rule = QualityRule::opcda;
  bool accept_uncertain = false;  ///< uncertain values count as good ones
  /// Of `codes`: numbers, words or, with `names`, names. A code in none of the lists is unknown.
  std::vector<std::string> good, uncertain, bad;
  std::optional<SideTable> names;
};

/// How a tag's archive keeps its values, by what `KeyPart::hold_column` says.
struct HoldRule {
  core::signal::Hold usual = core::signal::Hold::sample;
  std::vector<std::string> step_codes, linear_codes;
};

/// Where and how one historian keeps its tags: all that the reader knows of a vendor. Names come
/// from the settings: they are checked against the catalogue of the database and quoted.
///
/// A tag is written as the parts of its key and, in a loop_row table, the column of its value,
/// joined by `separator`: "TIC101", "TIC101.pv", "<device>/<key>". A wide table's tag is a column.
struct SourceLayout {
  std::string source = "plant";  ///< the name that loops refer to
  Shape shape = Shape::narrow;
  std::string relation = "public.history";  ///< [schema.]table or view, split at the first dot
  std::optional<PartitionList> partitions;  ///< then `relation` serves only while it lists none
  std::vector<KeyPart> key{{"tag", {}, false, {}, {}}};  ///< wide: empty
  std::string separator = ".";
  std::string time_column = "time";
  TimeKind time_kind = TimeKind::timestamptz;
  std::string time_zone;     ///< of timestamp_local, as the database names it
  std::string nanos_column;  ///< nanoseconds after the full second of `time_column`; empty = none
  /// narrow: the first that is not NULL counts.
  std::vector<std::string> value_columns{"value"};
  std::vector<std::pair<std::string, double>> states;  ///< what texts mean; case does not count
  QualityDecoder quality;
  std::string quality_column = "quality";  ///< empty = none
  std::string tiebreak_column;             ///< of rows with one time the largest counts
  bool null_is_absent = false;             ///< NULL means "not recorded then", not "bad"
  HoldRule hold;
  ModeCodes modes;
};

/// Whether the layout judges quality at all.
[[nodiscard]] inline bool has_quality(const SourceLayout& layout) {
  return !layout.quality_column.empty() && layout.quality.rule != QualityRule::none;
}

}  // namespace loopscope::storage
