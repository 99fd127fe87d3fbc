#include "config/historian_presets.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace loopscope::config {
namespace {

void set_no_quality(HistorianSettings& historian) {
  historian.quality_column.clear();
  historian.quality_rule = "none";
}

void narrow(HistorianSettings&) {}

/// One row per loop and time; whoever lays it out so has no usual name for the table.
void loop_row(HistorianSettings& historian) {
  historian.layout = "loop_row";
  historian.table.clear();
  historian.tag_column = "loop";
  historian.value_column.clear();
  set_no_quality(historian);
}

void wide(HistorianSettings& historian) {
  historian.layout = "wide";
  historian.table.clear();
  historian.tag_column.clear();
  historian.value_column.clear();
  set_no_quality(historian);
}

/// Ignition SQL Historian 7.9 to 8.3. The tables are found through sqlth_partitions alone: their
/// names change with the gateway's. querymode: 0 is discrete, 1 and 2 are the dead-banded analog of
/// old versions, 3 the compressed analog that is drawn as lines.
void ignition(HistorianSettings& historian) {
  historian.table = "public.sqlth_1_data";
  historian.partition_table = "public.sqlth_partitions";
  historian.partition_name_column = "pname";
  historian.partition_start_column = "start_time";
  historian.partition_end_column = "end_time";
  historian.tag_column = "tagid";
  historian.tag_table = "public.sqlth_te";
  historian.tag_name_column = "tagpath";
  historian.tag_id_column = "id";
  historian.tag_order_column = "created";
  historian.tag_ignore_case = true;
  historian.time_column = "t_stamp";
  historian.time_kind = "epoch_ms";
  historian.value_column = "floatvalue";
  historian.more_value_columns = {"intvalue", "stringvalue"};
  historian.quality_column = "dataintegrity";
  historian.quality_rule = "opcda_exact";
  historian.interpolation = "step";
  historian.interpolation_column = "querymode";
  historian.step_codes = {"0", "1", "2"};
  historian.linear_codes = {"3"};
}

/// ThingsBoard: "<device>/<key>", the device by name or by its uuid.
void thingsboard(HistorianSettings& historian) {
  historian.table = "public.ts_kv";
  historian.tag_column = "entity_id";
  historian.tag_table = "public.device";
  historian.tag_name_column = "name";
  historian.tag_id_column = "id";
  historian.subtag_column = "key";
  historian.subtag_table = "public.ts_kv_dictionary";
  historian.subtag_name_column = "key";
  historian.subtag_id_column = "key_id";
  historian.tag_separator = "/";
  historian.time_column = "ts";
  historian.time_kind = "epoch_ms";
  historian.value_column = "dbl_v";
  historian.more_value_columns = {"long_v", "bool_v", "str_v"};
  set_no_quality(historian);
}

/// Telegraf outputs.postgresql: a table per measurement, a column per tag and per field. A row
/// holds the fields of one metric, so NULL says nothing.
void telegraf(HistorianSettings& historian) {
  historian.layout = "loop_row";
  historian.table.clear();
  historian.tag_column.clear();
  historian.time_kind = "timestamp_utc";
  historian.value_column.clear();
  historian.null_means = "absent";
  set_no_quality(historian);
}

/// Rapid SCADA 6, ModArcPostgreSql: tags are channel numbers. 11 to 15 are alarm states of values
/// that are as good as any.
void rapid_scada(HistorianSettings& historian) {
  historian.table = "mod_arc_postgre_sql.min_historical";
  historian.tag_column = "cnl_num";
  historian.time_column = "time_stamp";
  historian.value_column = "val";
  historian.quality_column = "stat";
  historian.quality_rule = "codes";
  historian.good_codes = {"1", "2", "11", "12", "13", "14", "15", "21", "22"};
  historian.bad_codes = {"0", "3", "4", "23"};
}

/// Scada-LTS and Mango: rows with one time are told apart by their id.
void scada_lts(HistorianSettings& historian) {
  historian.table = "public.pointvalues";
  historian.tag_column = "datapointid";
  historian.tag_table = "public.datapoints";
  historian.tag_name_column = "xid";
  historian.tag_id_column = "id";
  historian.time_column = "ts";
  historian.time_kind = "epoch_ms";
  historian.value_column = "pointvalue";
  historian.tiebreak_column = "id";
  historian.interpolation = "step";
  set_no_quality(historian);
}

/// EPICS archive engine (RDB). The nanoseconds replace the fraction of the second; severities have
/// numbers of the site's own, so they go by name.
void epics(HistorianSettings& historian) {
  historian.table = "public.sample";
  historian.tag_column = "channel_id";
  historian.tag_table = "public.channel";
  historian.tag_name_column = "name";
  historian.tag_id_column = "channel_id";
  historian.time_column = "smpl_time";
  historian.nanos_column = "nanosecs";
  historian.value_column = "float_val";
  historian.more_value_columns = {"num_val", "str_val"};
  historian.quality_column = "severity_id";
  historian.quality_rule = "codes";
  historian.good_codes = {"OK", "NO_ALARM", "NONE", "MINOR", "MAJOR"};
  historian.bad_codes = {"INVALID", "UNDEFINED"};
  historian.quality_table = "public.severity";
  historian.quality_name_column = "name";
  historian.quality_id_column = "severity_id";
  historian.interpolation = "step";
}

/// Home Assistant recorder: states are texts, recorded on change.
void home_assistant(HistorianSettings& historian) {
  historian.table = "public.states";
  historian.tag_column = "metadata_id";
  historian.tag_table = "public.states_meta";
  historian.tag_name_column = "entity_id";
  historian.tag_id_column = "metadata_id";
  historian.time_column = "last_updated_ts";
  historian.time_kind = "epoch_s_float";
  historian.value_column = "state";
  historian.states = {"on=1", "off=0"};
  historian.interpolation = "step";
  set_no_quality(historian);
}

struct Preset {
  std::string_view name;
  void (*fill)(HistorianSettings&);
};

constexpr std::array kPresets{
    Preset{"narrow", narrow},
    Preset{"loop_row", loop_row},
    Preset{"wide", wide},
    Preset{"ignition", ignition},
    Preset{"thingsboard", thingsboard},
    Preset{"telegraf", telegraf},
    Preset{"rapid_scada", rapid_scada},
    Preset{"scada_lts", scada_lts},
    Preset{"epics", epics},
    Preset{"home_assistant", home_assistant},
};

constexpr auto kNames = [] {
  std::array<std::string_view, kPresets.size()> names;
  for (std::size_t k = 0; k < names.size(); ++k) names[k] = kPresets[k].name;
  return names;
}();

}  // namespace

std::span<const std::string_view> preset_names() {
  return kNames;
}

HistorianSettings historian_preset(std::string_view name) {
  for (const Preset& preset : kPresets) {
    if (preset.name != name) continue;
    HistorianSettings historian;
    historian.preset = name;
    preset.fill(historian);
    return historian;
  }
  throw std::invalid_argument("no preset is called " + std::string(name));
}

}  // namespace loopscope::config
