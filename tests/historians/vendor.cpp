#include "tests/historians/vendor.hpp"

#include <array>
#include <stdexcept>

#include "config/historian_presets.hpp"

namespace loopscope::tests {
namespace {

using config::HistorianSettings;

// One row per loop and role; what most fills start from.
#define LOOPSCOPE_TAGGED                                                                      \
  "(SELECT loop, k, time, role.number, role.name, role.value FROM truth"                      \
  " CROSS JOIN LATERAL (VALUES (1, 'sp', sp), (2, 'pv', pv), (3, 'op', op)) AS role (number," \
  " name, value))"

constexpr const char* kNarrow =
    "CREATE TABLE history (tag text NOT NULL, time timestamptz NOT NULL, value float8,"
    " quality smallint);"
    "INSERT INTO history SELECT 'FIC' || loop || '.' || upper(name), time, value, 192"
    " FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "CREATE INDEX ON history (tag, time) INCLUDE (value, quality)";

// A hypertable is a table in chunks of time; ids for tags are the convention there.
constexpr const char* kTimescaleNarrow =
    "CREATE TABLE tags (tag_id int PRIMARY KEY, name text UNIQUE);"
    "CREATE TABLE measurements (time timestamptz NOT NULL, tag_id int NOT NULL, value float8)"
    " PARTITION BY RANGE (time);"
    "CREATE TABLE chunk_1 PARTITION OF measurements FOR VALUES FROM (MINVALUE) TO ('2026-03-01');"
    "CREATE TABLE chunk_2 PARTITION OF measurements FOR VALUES FROM ('2026-03-01') TO (MAXVALUE);"
    "INSERT INTO tags SELECT DISTINCT loop * 10 + number, 'FIC' || loop || '.' || name"
    " FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "INSERT INTO measurements SELECT time, loop * 10 + number, value FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "CREATE INDEX ON measurements (tag_id, time DESC)";

void timescale_narrow(HistorianSettings& historian) {
  historian.table = "public.measurements";
  historian.tag_column = "tag_id";
  historian.tag_table = "public.tags";
  historian.tag_name_column = "name";
  historian.tag_id_column = "tag_id";
  historian.quality_column = "";
  historian.quality_rule = "none";
}

constexpr const char* kLoopRow =
    "CREATE TABLE loop_history (time timestamptz NOT NULL, loop text NOT NULL, sp float8,"
    " pv float8, op real, mode text) PARTITION BY RANGE (time);"
    "CREATE TABLE lr_1 PARTITION OF loop_history FOR VALUES FROM (MINVALUE) TO ('2026-03-01');"
    "CREATE TABLE lr_2 PARTITION OF loop_history FOR VALUES FROM ('2026-03-01') TO (MAXVALUE);"
    "INSERT INTO loop_history SELECT time, 'FIC' || loop, sp, pv, op, 'AUTO' FROM truth;"
    "CREATE INDEX ON loop_history (loop, time DESC)";

void loop_row(HistorianSettings& historian) {
  historian.table = "public.loop_history";
}

// Column names as people give them: quoted, with dots.
constexpr const char* kWide = R"(
    DO $$
    DECLARE columns text; sums text;
    BEGIN
      SELECT string_agg(format('%I float8', 'FIC' || l || '.' || r), ', '),
             string_agg(format('max(%s) FILTER (WHERE loop = %s)', r, l), ', ')
        INTO columns, sums
        FROM (SELECT DISTINCT loop AS l FROM truth) AS loops,
             unnest(ARRAY['sp', 'pv', 'op']) AS r;
      EXECUTE 'CREATE TABLE wide_history (time timestamptz PRIMARY KEY, ' || columns || ')';
      EXECUTE 'INSERT INTO wide_history SELECT time, ' || sums || ' FROM truth GROUP BY time';
    END $$)";

void wide(HistorianSettings& historian) {
  historian.table = "public.wide_history";
}

// The gateway was renamed on 1 March: another driver, another table, another id for every tag. The
// first ids of op were of whole numbers. The list of tables has one twice and one that was pruned.
constexpr const char* kIgnition =
    "CREATE TABLE sqlth_drv (id serial PRIMARY KEY, name varchar, provider varchar);"
    "CREATE TABLE sqlth_scinfo (id serial PRIMARY KEY, scname varchar, drvid int);"
    "CREATE TABLE sqlth_te (id serial PRIMARY KEY, tagpath varchar, scid int, datatype int,"
    " querymode int, created int8, retired int8);"
    "CREATE INDEX sqlth_tetagpathndx ON sqlth_te (tagpath);"
    "CREATE TABLE sqlth_partitions (pname varchar, drvid int, start_time int8, end_time int8,"
    " blocksize int, flags int);"
    "CREATE TABLE sqlt_data_1_2026_02 (tagid int, intvalue int8, floatvalue float8,"
    " stringvalue varchar, datevalue timestamp, dataintegrity int, t_stamp int8,"
    " PRIMARY KEY (tagid, t_stamp));"
    "CREATE TABLE sqlt_data_2_2026_03 (LIKE sqlt_data_1_2026_02 INCLUDING ALL);"
    "INSERT INTO sqlth_drv (name, provider) VALUES ('old', 'default'), ('new', 'default');"
    "INSERT INTO sqlth_scinfo (scname, drvid) VALUES ('_exempt_', 1), ('_exempt_', 2);"
    "INSERT INTO sqlth_te (tagpath, scid, datatype, querymode, created, retired)"
    " SELECT DISTINCT 'area/fic' || loop || '/' || name, scid,"
    "  CASE WHEN name = 'op' AND scid = 1 THEN 0 ELSE 1 END, 3,"
    "  CASE scid WHEN 1 THEN 1000 ELSE 2000 END, CASE scid WHEN 1 THEN 2000 END"
    " FROM " LOOPSCOPE_TAGGED
    " AS t, (VALUES (2), (1)) AS s (scid);"
    "INSERT INTO sqlth_partitions (pname, drvid, start_time, end_time) VALUES"
    " ('sqlt_data_1_2026_01', 1, 1767225600000, 1769904000000),"
    " ('sqlt_data_1_2026_02', 1, 1769904000000, 1772323200000),"
    " ('sqlt_data_1_2026_02', 1, 1769904000000, 1772323200000),"
    " ('sqlt_data_2_2026_03', 2, 1772323200000, 1775001600000);"
    "INSERT INTO sqlt_data_1_2026_02 SELECT e.id, CASE WHEN name = 'op' THEN value::int8 END,"
    "  CASE WHEN name <> 'op' THEN value END, NULL, NULL, 192,"
    "  (extract(epoch FROM time) * 1000)::int8"
    " FROM " LOOPSCOPE_TAGGED
    " AS t JOIN sqlth_te AS e ON e.tagpath = 'area/fic' || loop || '/' || name AND e.scid = 1"
    " WHERE time < '2026-03-01';"
    "INSERT INTO sqlt_data_2_2026_03 SELECT e.id, NULL, value, NULL, NULL, 192,"
    "  (extract(epoch FROM time) * 1000)::int8"
    " FROM " LOOPSCOPE_TAGGED
    " AS t JOIN sqlth_te AS e ON e.tagpath = 'area/fic' || loop || '/' || name AND e.scid = 2"
    " WHERE time >= '2026-03-01'";

// A whole number goes into long_v, whatever the key had before.
constexpr const char* kThingsboard =
    "CREATE TABLE device (id uuid PRIMARY KEY, name varchar(255));"
    "CREATE TABLE ts_kv_dictionary (key varchar(255) PRIMARY KEY, key_id serial UNIQUE);"
    "CREATE TABLE ts_kv (entity_id uuid NOT NULL, key int NOT NULL, ts bigint NOT NULL,"
    " bool_v boolean, str_v varchar(10000000), long_v bigint, dbl_v double precision, json_v json,"
    " PRIMARY KEY (entity_id, key, ts)) PARTITION BY RANGE (ts);"
    "CREATE TABLE ts_kv_2026_02 PARTITION OF ts_kv FOR VALUES FROM (1769904000000)"
    " TO (1772323200000);"
    "CREATE TABLE ts_kv_2026_03 PARTITION OF ts_kv FOR VALUES FROM (1772323200000)"
    " TO (1775001600000);"
    "INSERT INTO device SELECT DISTINCT"
    " ('00000000-0000-0000-0000-' || lpad(loop::text, 12, '0'))::uuid, 'FIC' || loop FROM truth;"
    "INSERT INTO ts_kv_dictionary (key) VALUES ('op'), ('pv'), ('sp');"
    "INSERT INTO ts_kv SELECT ('00000000-0000-0000-0000-' || lpad(loop::text, 12, '0'))::uuid,"
    " d.key_id, (extract(epoch FROM time) * 1000)::int8, NULL, NULL,"
    " CASE WHEN value = trunc(value) AND k % 3 = 0 THEN value::int8 END,"
    " CASE WHEN NOT (value = trunc(value) AND k % 3 = 0) THEN value END, NULL"
    " FROM " LOOPSCOPE_TAGGED " AS t JOIN ts_kv_dictionary AS d ON d.key = t.name";

// Fields of one measurement that come in metrics of their own make rows of their own, and what was
// sent again after a lost connection stands twice.
constexpr const char* kTelegraf =
    "CREATE TABLE control (time timestamp without time zone, host text, loop text,"
    " sp double precision, pv double precision, op bigint);"
    "INSERT INTO control SELECT time AT TIME ZONE 'UTC', 'plc1', 'FIC' || loop, NULL, pv, op::int8"
    " FROM truth;"
    "INSERT INTO control SELECT time AT TIME ZONE 'UTC', 'plc1', 'FIC' || loop, sp, NULL, NULL"
    " FROM truth;"
    "CREATE INDEX ON control (loop, time)";

void telegraf(HistorianSettings& historian) {
  historian.table = "public.control";
  historian.tag_column = "loop";
}

// tags_as_foreign_keys: the tags in a table of their own.
constexpr const char* kTelegrafKeys =
    "CREATE TABLE control_tag (tag_id bigint PRIMARY KEY, host text, loop text);"
    "CREATE TABLE control (time timestamp without time zone, tag_id bigint, sp double precision,"
    " pv double precision, op numeric);"
    "INSERT INTO control_tag SELECT DISTINCT loop * -7919, 'plc1', 'FIC' || loop FROM truth;"
    "INSERT INTO control SELECT time AT TIME ZONE 'UTC', loop * -7919, sp, pv, op FROM truth;"
    "CREATE INDEX ON control (tag_id, time)";

void telegraf_keys(HistorianSettings& historian) {
  historian.table = "public.control";
  historian.tag_column = "tag_id";
  historian.tag_table = "public.control_tag";
  historian.tag_name_column = "loop";
  historian.tag_id_column = "tag_id";
}

constexpr const char* kRapidScada =
    "CREATE SCHEMA mod_arc_postgre_sql;"
    "CREATE TABLE mod_arc_postgre_sql.min_historical (cnl_num integer NOT NULL,"
    " time_stamp timestamp with time zone NOT NULL, val double precision NOT NULL,"
    " stat integer NOT NULL, PRIMARY KEY (cnl_num, time_stamp)) PARTITION BY RANGE (time_stamp);"
    "CREATE TABLE mod_arc_postgre_sql.min_historical_20260201_20260301"
    " PARTITION OF mod_arc_postgre_sql.min_historical FOR VALUES FROM ('2026-02-01') TO"
    " ('2026-03-01');"
    "CREATE TABLE mod_arc_postgre_sql.min_historical_20260301_20260401"
    " PARTITION OF mod_arc_postgre_sql.min_historical FOR VALUES FROM ('2026-03-01') TO"
    " ('2026-04-01');"
    "INSERT INTO mod_arc_postgre_sql.min_historical SELECT loop * 10 + number, time, value,"
    " (ARRAY[1, 2, 11, 12, 13, 14, 15, 21, 22])[1 + k % 9] FROM " LOOPSCOPE_TAGGED " AS t";

constexpr const char* kScadaLts =
    "CREATE TABLE dataPoints (id serial PRIMARY KEY, xid varchar(50) NOT NULL, dataSourceId int);"
    "CREATE TABLE pointValues (id bigserial PRIMARY KEY, dataPointId int NOT NULL,"
    " dataType int NOT NULL, pointValue double precision, ts bigint NOT NULL);"
    "INSERT INTO dataPoints (id, xid) SELECT DISTINCT loop * 10 + number,"
    " 'DP_FIC' || loop || '_' || name FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "INSERT INTO pointValues (dataPointId, dataType, pointValue, ts) SELECT loop * 10 + number, 3,"
    " value, (extract(epoch FROM time) * 1000)::int8 FROM " LOOPSCOPE_TAGGED
    " AS t ORDER BY time;"
    "CREATE INDEX ON pointValues (dataPointId, ts)";

// The number of a severity is the site's own: OK is not the first here.
constexpr const char* kEpics =
    "CREATE TABLE channel (channel_id bigint PRIMARY KEY, name varchar(100) UNIQUE);"
    "CREATE TABLE severity (severity_id bigint PRIMARY KEY, name varchar(100));"
    "CREATE TABLE sample (channel_id bigint NOT NULL, smpl_time timestamp with time zone NOT NULL,"
    " nanosecs bigint NOT NULL, severity_id bigint NOT NULL, status_id bigint NOT NULL,"
    " num_val int, float_val double precision, str_val varchar(120), datatype char(1),"
    " array_val bytea);"
    "INSERT INTO severity VALUES (1, 'INVALID'), (2, 'MAJOR'), (3, 'MINOR'), (4, 'OK');"
    "INSERT INTO channel SELECT DISTINCT loop * 10 + number, 'FIC' || loop || ':' || name"
    " FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "INSERT INTO sample SELECT loop * 10 + number, date_trunc('second', time), 125000000,"
    " 2 + k % 3, 1, CASE WHEN name = 'op' THEN value::int END,"
    " CASE WHEN name <> 'op' THEN value END, NULL, ' ', NULL FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "CREATE INDEX ON sample (channel_id, smpl_time, nanosecs)";

constexpr const char* kHomeAssistant =
    "CREATE TABLE states_meta (metadata_id bigint PRIMARY KEY, entity_id varchar(255) UNIQUE);"
    "CREATE TABLE states (state_id bigserial PRIMARY KEY, metadata_id bigint, state varchar(255),"
    " last_updated_ts double precision, last_changed_ts double precision, attributes_id bigint,"
    " old_state_id bigint);"
    "INSERT INTO states_meta SELECT DISTINCT loop * 10 + number, 'sensor.fic' || loop || '_' ||"
    " name FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "INSERT INTO states (metadata_id, state, last_updated_ts) SELECT loop * 10 + number,"
    " value::text, extract(epoch FROM time)::float8 FROM " LOOPSCOPE_TAGGED
    " AS t;"
    "CREATE INDEX ON states (metadata_id, last_updated_ts)";

void nothing(HistorianSettings&) {}

constexpr std::array kVendors{
    Vendor{"narrow", "narrow", kNarrow, nothing, "FIC@LOOP@.@ROLE_UPPER@"},
    Vendor{"timescale_narrow", "narrow", kTimescaleNarrow, timescale_narrow, "FIC@LOOP@.@ROLE@"},
    Vendor{"loop_row", "loop_row", kLoopRow, loop_row, "FIC@LOOP@.@ROLE@"},
    Vendor{"wide", "wide", kWide, wide, "FIC@LOOP@.@ROLE@"},
    Vendor{"ignition", "ignition", kIgnition, nothing, "[default]Area/FIC@LOOP@/@ROLE@"},
    Vendor{"thingsboard", "thingsboard", kThingsboard, nothing, "FIC@LOOP@/@ROLE@"},
    Vendor{"telegraf", "telegraf", kTelegraf, telegraf, "FIC@LOOP@.@ROLE@"},
    Vendor{"telegraf_keys", "telegraf", kTelegrafKeys, telegraf_keys, "FIC@LOOP@.@ROLE@"},
    Vendor{"rapid_scada", "rapid_scada", kRapidScada, nothing, "@NUMBER@"},
    Vendor{"scada_lts", "scada_lts", kScadaLts, nothing, "DP_FIC@LOOP@_@ROLE@"},
    Vendor{"epics", "epics", kEpics, nothing, "FIC@LOOP@:@ROLE@"},
    Vendor{"home_assistant", "home_assistant", kHomeAssistant, nothing, "sensor.fic@LOOP@_@ROLE@"},
};

void replace(std::string& text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  if (at != std::string::npos) text.replace(at, what.size(), with);
}

}  // namespace

std::span<const Vendor> vendors() {
  return kVendors;
}

const Vendor& vendor(const std::string& name) {
  for (const Vendor& known : kVendors) {
    if (name == known.name) return known;
  }
  throw std::invalid_argument("no vendor is called " + name);
}

HistorianSettings settings_of(const Vendor& vendor, const std::string& connection) {
  HistorianSettings historian = config::historian_preset(vendor.preset);
  historian.name = vendor.name;
  historian.connection = connection;
  vendor.site(historian);
  return historian;
}

std::string tag_of(const Vendor& vendor, int loop, const std::string& role) {
  std::string tag = vendor.tag;
  const int number = role == "sp" ? 1 : role == "pv" ? 2 : 3;
  replace(tag, "@LOOP@", std::to_string(loop));
  replace(tag, "@ROLE@", role);
  replace(tag, "@ROLE_UPPER@", role == "sp" ? "SP" : role == "pv" ? "PV" : "OP");
  replace(tag, "@NUMBER@", std::to_string(10 * loop + number));
  return tag;
}

}  // namespace loopscope::tests
