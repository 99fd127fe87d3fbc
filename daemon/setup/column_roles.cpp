#include "daemon/setup/column_roles.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::SeenColumn;
using storage::SeenTable;
using Words = std::vector<std::string_view>;
using Columns = std::vector<SeenColumn>;

// As they are found in plants, the likeliest first; letters and digits only.
const Words kTimeWords = {"time",
                          "timestamp",
                          "ts",
                          "tstamp",
                          "datetime",
                          "sampletime",
                          "utc",
                          "utctime",
                          "timeutc",
                          "t",
                          "date",
                          "sourcetime",
                          "sourcetimestamp",
                          "logtime",
                          "recordedat",
                          "stamp",
                          "zeit",
                          "zeitstempel",
                          "zeitpunkt",
                          "epoch"};
const Words kTagWords = {"loop",       "loopname",   "tag",         "tagname",      "tagpath",
                         "tagid",      "point",      "pointname",   "pointid",      "signal",
                         "signalname", "signalid",   "variable",    "variablename", "varname",
                         "item",       "itemname",   "itemid",      "sensor",       "sensorname",
                         "sensorid",   "channel",    "channelname", "channelid",    "name",
                         "device",     "devicename", "deviceid",    "node",         "nodeid",
                         "metric",     "metricname", "metricid",    "series",       "seriesname",
                         "seriesid",   "loopid",     "id",          "kks",          "messstelle",
                         "asset",      "unit",       "controller",  "topic",        "key"};
const Words kValueWords = {"value",    "val",        "v",         "wert",        "messwert",
                           "reading",  "floatvalue", "realvalue", "doublevalue", "numericvalue",
                           "numvalue", "pointvalue", "vvalue",    "data"};
const Words kQualityWords = {
    "quality", "qualitycode",   "opcquality",    "qual", "q",      "statuscode", "status",
    "stat",    "dataintegrity", "qualitydetail", "good", "isgood", "valid",      "isvalid",
    "ok",      "qualitaet",     "flag",          "flags"};
const Words kOtherWords = {"mode",          "md",  "auto",       "state", "host",
                           "unitofmeasure", "uom", "description"};

const Words& words_of(ColumnRole role) {
  switch (role) {
    case ColumnRole::time:
      return kTimeWords;
    case ColumnRole::tag:
      return kTagWords;
    case ColumnRole::value:
      return kValueWords;
    case ColumnRole::quality:
      return kQualityWords;
    case ColumnRole::mode:
      break;
  }
  return kOtherWords;
}

std::string letters_of(const std::string& name) {
  std::string letters;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') letters += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) letters += c;
  }
  return letters;
}

template <typename Keep>
Columns those_of(const Columns& columns, Keep keep) {
  Columns kept;
  std::ranges::copy_if(columns, std::back_inserter(kept), keep);
  return kept;
}

Columns of_kinds(const Columns& columns, std::initializer_list<ColumnKind> kinds) {
  return those_of(columns, [&](const SeenColumn& column) {
    return std::ranges::find(kinds, kind_of(column)) != kinds.end();
  });
}

/// The best by its name; nullopt when no name says so.
std::optional<SeenColumn> best_of(const Columns& columns, ColumnRole role) {
  std::optional<SeenColumn> best;
  for (const SeenColumn& column : columns) {
    const auto rank = rank_of(role, column.name);
    if (rank && (!best || *rank < *rank_of(role, best->name))) best = column;
  }
  return best;
}

/// The best by its name, or the only one.
std::optional<SeenColumn> best_or_only(const Columns& columns, ColumnRole role) {
  if (auto best = best_of(columns, role)) return best;
  return columns.size() == 1 ? std::optional(columns.front()) : std::nullopt;
}

std::optional<SeenColumn> wished(const SeenTable& table, const std::string& column,
                                 std::string_view option) {
  if (column.empty()) return std::nullopt;
  const auto found = std::ranges::find(table.columns, column, &SeenColumn::name);
  if (found != table.columns.end()) return *found;
  std::vector<std::string> names;
  for (const SeenColumn& known : table.columns) names.push_back(known.name);
  throw Failure(ExitCode::usage,
                fmt::format("{}: {}.{} has no column {}", option, table.schema, table.name, column),
                fmt::format("its columns are {}", fmt::join(names, ", ")));
}

class RoleFinder {
 public:
  RoleFinder(const SeenTable& table, const LayoutWishes& wishes)
      : table_(table), wishes_(wishes), left_(table.columns) {}

  ColumnRoles find() {
    take(roles_.time, wishes_.time_column, "--time-column", [this] { return likely_time(); });
    take(roles_.quality, wishes_.quality_column, "--quality-column",
         [this] { return likely_quality(); });
    take(roles_.value, wishes_.value_column, "--value-column", [this] { return likely_value(); });
    take(roles_.tag, wishes_.tag_column, "--tag-column", [this] { return likely_tag(); });
    for (const SeenColumn& column : of_kinds(left_, {ColumnKind::real, ColumnKind::whole})) {
      if (letters_of(column.name) != "id") roles_.numbers.push_back(column.name);
    }
    return roles_;
  }

 private:
  template <typename Likely>
  void take(std::optional<SeenColumn>& role, const std::string& wish, std::string_view option,
            Likely likely) {
    role = wished(table_, wish, option);
    if (!role) role = likely();
    if (!role) return;
    std::erase_if(left_, [&](const SeenColumn& column) { return column.name == role->name; });
  }

  [[nodiscard]] std::optional<SeenColumn> likely_time() const {
    if (auto time = best_or_only(of_kinds(left_, {ColumnKind::time}), ColumnRole::time))
      return time;
    return best_of(of_kinds(left_, {ColumnKind::whole, ColumnKind::real}), ColumnRole::time);
  }

  [[nodiscard]] std::optional<SeenColumn> likely_quality() const {
    return best_of(of_kinds(left_, {ColumnKind::whole, ColumnKind::truth, ColumnKind::text}),
                   ColumnRole::quality);
  }

  [[nodiscard]] std::optional<SeenColumn> likely_value() const {
    return best_or_only(of_kinds(left_, {ColumnKind::real}), ColumnRole::value);
  }

  /// Telegraf writes "tag" as the comment of its tag columns.
  [[nodiscard]] std::optional<SeenColumn> likely_tag() {
    Columns texts = those_of(of_kinds(left_, {ColumnKind::text}), [](const SeenColumn& column) {
      return !rank_of(ColumnRole::mode, column.name);
    });
    const Columns commented =
        those_of(texts, [](const SeenColumn& column) { return column.comment == "tag"; });
    if (!commented.empty()) texts = commented;
    if (auto tag = best_or_only(texts, ColumnRole::tag)) return tag;
    for (const SeenColumn& column : texts) roles_.possible_tags.push_back(column.name);
    if (!texts.empty()) return std::nullopt;
    return best_of(
        those_of(of_kinds(left_, {ColumnKind::whole, ColumnKind::uuid}),
                 [](const SeenColumn& column) { return letters_of(column.name) != "id"; }),
        ColumnRole::tag);
  }

  const SeenTable& table_;
  const LayoutWishes& wishes_;
  Columns left_;
  ColumnRoles roles_;
};

}  // namespace

ColumnKind kind_of(const SeenColumn& column) {
  using enum ColumnKind;
  struct Type {
    std::string_view name;
    ColumnKind kind;
  };
  constexpr Type kTypes[] = {{"timestamptz", time}, {"timestamp", time}, {"float8", real},
                             {"float4", real},      {"numeric", real},   {"int8", whole},
                             {"int4", whole},       {"int2", whole},     {"bool", truth},
                             {"text", text},        {"varchar", text},   {"bpchar", text},
                             {"name", text},        {"uuid", uuid}};
  for (const Type& type : kTypes) {
    if (type.name == column.type) return type.kind;
  }
  return other;
}

std::optional<std::size_t> rank_of(ColumnRole role, const std::string& column) {
  const Words& words = words_of(role);
  const auto found = std::ranges::find(words, letters_of(column));
  if (found == words.end()) return std::nullopt;
  return static_cast<std::size_t>(found - words.begin());
}

ColumnRoles find_roles(const SeenTable& table, const LayoutWishes& wishes) {
  return RoleFinder(table, wishes).find();
}

std::optional<SeenColumn> find_name_column(const SeenTable& table) {
  return best_or_only(
      those_of(of_kinds(table.columns, {ColumnKind::text}),
               [](const SeenColumn& column) { return !rank_of(ColumnRole::mode, column.name); }),
      ColumnRole::tag);
}

}  // namespace loopscope::daemon
