#include "daemon/service/historians/storage_settings.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/text/cells.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::QualityRule;
using storage::TimeKind;

constexpr std::array kTimeKinds{
    std::pair{std::string_view{"timestamptz"}, TimeKind::timestamptz},
    std::pair{std::string_view{"timestamp_utc"}, TimeKind::timestamp_utc},
    std::pair{std::string_view{"timestamp_local"}, TimeKind::timestamp_local},
    std::pair{std::string_view{"epoch_s"}, TimeKind::epoch_s},
    std::pair{std::string_view{"epoch_s_float"}, TimeKind::epoch_s_float},
    std::pair{std::string_view{"epoch_ms"}, TimeKind::epoch_ms},
    std::pair{std::string_view{"epoch_us"}, TimeKind::epoch_us},
    std::pair{std::string_view{"epoch_ns"}, TimeKind::epoch_ns},
};

constexpr std::array kQualityRules{
    std::pair{std::string_view{"none"}, QualityRule::none},
    std::pair{std::string_view{"opcda"}, QualityRule::opcda},
    std::pair{std::string_view{"opcda_exact"}, QualityRule::opcda_exact},
    std::pair{std::string_view{"opcua"}, QualityRule::opcua},
    std::pair{std::string_view{"opchda"}, QualityRule::opchda},
    std::pair{std::string_view{"zero"}, QualityRule::zero},
    std::pair{std::string_view{"truth"}, QualityRule::truth},
    std::pair{std::string_view{"codes"}, QualityRule::codes},
};

constexpr std::array kShapes{
    std::pair{std::string_view{"narrow"}, storage::Shape::narrow},
    std::pair{std::string_view{"loop_row"}, storage::Shape::loop_row},
    std::pair{std::string_view{"wide"}, storage::Shape::wide},
};

constexpr std::array kHolds{
    std::pair{std::string_view{"sample"}, core::signal::Hold::sample},
    std::pair{std::string_view{"step"}, core::signal::Hold::step},
    std::pair{std::string_view{"linear"}, core::signal::Hold::linear},
};

/// Words were validated by config/; an unknown one is a fault of this program.
template <typename Table>
auto look_up(const Table& table, std::string_view word) {
  for (const auto& [known, value] : table) {
    if (known == word) return value;
  }
  throw std::logic_error(fmt::format("the word \"{}\" passed validation but is not known", word));
}

const std::string& first_filled(const std::string& preferred, const std::string& fallback) {
  return preferred.empty() ? fallback : preferred;
}

std::optional<storage::SideTable> side_table(const std::string& relation, const std::string& name,
                                             const std::string& id) {
  if (relation.empty()) return std::nullopt;
  return storage::SideTable{relation, name, id};
}

std::vector<storage::KeyPart> key_of(const config::HistorianSettings& historian) {
  std::vector<storage::KeyPart> key;
  if (!historian.tag_column.empty()) {
    key.push_back(
        {historian.tag_column,
         side_table(historian.tag_table, historian.tag_name_column, historian.tag_id_column),
         historian.tag_ignore_case, historian.tag_order_column, historian.interpolation_column});
  }
  if (!historian.subtag_column.empty()) {
    key.push_back({historian.subtag_column,
                   side_table(historian.subtag_table, historian.subtag_name_column,
                              historian.subtag_id_column),
                   false, "", ""});
  }
  return key;
}

/// "TEXT=NUMBER", validated by config/.
std::vector<std::pair<std::string, double>> states_of(const config::HistorianSettings& historian) {
  // Words for the mode come with every historian; a state of the settings goes before them.
  std::vector<std::pair<std::string, double>> states;
  for (const std::string& state : historian.states) {
    const std::size_t equals = state.rfind('=');
    states.emplace_back(state.substr(0, equals), std::stod(state.substr(equals + 1)));
  }
  for (const auto& [word, mode] : kModeWords) states.emplace_back(word, static_cast<double>(mode));
  return states;
}

/// Texts that config/ has found to be numbers.
std::vector<double> numbers(const std::vector<std::string>& texts) {
  std::vector<double> values;
  values.reserve(texts.size());
  for (const std::string& text : texts) values.push_back(std::stod(text));
  return values;
}

storage::QualityDecoder quality_of(const config::HistorianSettings& historian) {
  return {look_up(kQualityRules, historian.quality_rule),
          historian.accept_uncertain,
          historian.good_codes,
          historian.uncertain_codes,
          historian.bad_codes,
          side_table(historian.quality_table, historian.quality_name_column,
                     historian.quality_id_column)};
}

storage::ConnectionSettings connection(const std::string& conninfo, const std::string& purpose,
                                       bool read_only) {
  storage::ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = purpose;
  settings.read_only = read_only;
  return settings;
}

/// Whatever a worker waits for ends in time for the loops that it holds meanwhile: no wait takes
/// more than a third of what a claim holds, which is also how often claims are extended.
storage::ConnectionSettings within_hold(storage::ConnectionSettings settings, double hold_s) {
  const int third_s = std::max(2, static_cast<int>(hold_s / 3.0));
  settings.connect_timeout_s = std::min(settings.connect_timeout_s, third_s);
  settings.statement_timeout_s = std::min(settings.statement_timeout_s, third_s);
  settings.network_timeout_s = std::min(settings.network_timeout_s, third_s);
  settings.idle_timeout_s = std::min(settings.idle_timeout_s, third_s);
  return settings;
}

}  // namespace

storage::ConnectionSettings results_connection(const config::Settings& settings) {
  return within_hold(connection(settings.results.connection, "results", false),
                     settings.schedule.hold_s());
}

storage::ConnectionSettings owner_connection(const config::Settings& settings) {
  return connection(first_filled(settings.results.owner_connection, settings.results.connection),
                    "owner", false);
}

storage::ConnectionSettings engineer_connection(const config::Settings& settings) {
  if (settings.results.engineer_connection.empty()) return owner_connection(settings);
  return connection(settings.results.engineer_connection, "engineer", false);
}

storage::ConnectionSettings reader_connection(const config::Settings& settings) {
  return connection(settings.results.connection, "reader", true);
}

storage::ConnectionSettings historian_connection(const config::HistorianSettings& historian) {
  return connection(historian.connection, "historian " + historian.name, true);
}

storage::ConnectionSettings historian_connection(const config::HistorianSettings& historian,
                                                 double hold_s) {
  return within_hold(historian_connection(historian), hold_s);
}

storage::ConnectionSettings historian_writer_connection(
    const config::HistorianSettings& historian) {
  return connection(first_filled(historian.writer_connection, historian.connection),
                    "import " + historian.name, false);
}

storage::SourceLayout historian_layout(const config::HistorianSettings& historian) {
  storage::SourceLayout layout;
  layout.source = historian.name;
  layout.shape = look_up(kShapes, historian.layout);
  layout.relation = historian.table;
  if (!historian.partition_table.empty()) {
    layout.partitions = {historian.partition_table, historian.partition_name_column,
                         historian.partition_start_column, historian.partition_end_column};
  }
  layout.key = key_of(historian);
  layout.separator = historian.tag_separator;
  layout.time_column = historian.time_column;
  layout.time_kind = look_up(kTimeKinds, historian.time_kind);
  layout.time_zone = historian.time_zone;
  layout.nanos_column = historian.nanos_column;
  layout.value_columns = historian.more_value_columns;
  layout.value_columns.insert(layout.value_columns.begin(), historian.value_column);
  layout.states = states_of(historian);
  layout.quality = quality_of(historian);
  layout.quality_column = historian.quality_column;
  layout.tiebreak_column = historian.tiebreak_column;
  layout.null_is_absent = historian.null_means == "absent";
  layout.hold = {look_up(kHolds, historian.interpolation), historian.step_codes,
                 historian.linear_codes};
  layout.modes = {numbers(historian.manual_codes), numbers(historian.automatic_codes),
                  numbers(historian.cascade_codes)};
  return layout;
}

const config::HistorianSettings& find_historian(const config::Settings& settings,
                                                const std::string& name) {
  for (const config::HistorianSettings& historian : settings.historians) {
    if (historian.name == name) return historian;
  }
  throw Failure(ExitCode::configuration,
                fmt::format("no historian named \"{}\" in the settings", name),
                "add it to /historians, or change the loop's source");
}

}  // namespace loopscope::daemon
