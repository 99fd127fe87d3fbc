#include "daemon/service/storage_settings.hpp"

#include <array>
#include <fmt/format.h>
#include <utility>

#include "daemon/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::QualityRule;
using storage::TimeKind;

constexpr std::array kTimeKinds{
    std::pair{std::string_view{"timestamptz"}, TimeKind::timestamptz},
    std::pair{std::string_view{"timestamp_utc"}, TimeKind::timestamp_utc},
    std::pair{std::string_view{"epoch_s"}, TimeKind::epoch_s},
    std::pair{std::string_view{"epoch_s_float"}, TimeKind::epoch_s_float},
    std::pair{std::string_view{"epoch_ms"}, TimeKind::epoch_ms},
    std::pair{std::string_view{"epoch_us"}, TimeKind::epoch_us},
};

constexpr std::array kQualityRules{
    std::pair{std::string_view{"none"}, QualityRule::none},
    std::pair{std::string_view{"opcda"}, QualityRule::opcda},
    std::pair{std::string_view{"zero"}, QualityRule::zero},
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

storage::ConnectionSettings connection(const std::string& conninfo, const std::string& purpose,
                                       bool read_only) {
  storage::ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = purpose;
  settings.read_only = read_only;
  return settings;
}

}  // namespace

storage::ConnectionSettings results_connection(const config::Settings& settings) {
  return connection(settings.results.connection, "results", false);
}

storage::ConnectionSettings owner_connection(const config::Settings& settings) {
  return connection(first_filled(settings.results.owner_connection, settings.results.connection),
                    "owner", false);
}

storage::ConnectionSettings historian_connection(const config::HistorianSettings& historian) {
  return connection(historian.connection, "historian " + historian.name, true);
}

storage::ConnectionSettings historian_writer_connection(
    const config::HistorianSettings& historian) {
  return connection(first_filled(historian.writer_connection, historian.connection),
                    "import " + historian.name, false);
}

storage::NarrowLayout historian_layout(const config::HistorianSettings& historian) {
  storage::NarrowLayout layout;
  layout.source = historian.name;
  layout.relation = historian.table;
  layout.tag_column = historian.tag_column;
  layout.time_column = historian.time_column;
  layout.value_column = historian.value_column;
  layout.quality_column = historian.quality_column;
  layout.time_kind = look_up(kTimeKinds, historian.time_kind);
  layout.quality_rule = look_up(kQualityRules, historian.quality_rule);
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
