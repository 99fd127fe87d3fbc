#include "storage/historian/statements.hpp"

#include "storage/historian/native_time.hpp"

namespace loopscope::storage::historian_statements {
namespace {

/// Names to ids; several of a name in the order in which they were made.
std::string ids_sql(const ResolvedNames& names, const std::string& condition) {
  const std::string hold = names.hold.empty() ? "NULL" : "n." + names.hold + "::text";
  const std::string order = names.order.empty() ? "" : ", n." + names.order;
  return "SELECT request.name, n." + names.id + "::text, " + hold +
         " FROM unnest($1::text[]) AS request (name) JOIN " + names.relation + " AS n ON " +
         condition + " AND n." + names.id + " IS NOT NULL ORDER BY request.name" + order + ", n." +
         names.id;
}

/// What list_keys() is made of: one entry a part of the key, comma-separated.
struct Keys {
  std::string columns;  ///< h."a" AS k0, h."b" AS k1
  std::string order;    ///< h."a", h."b"
  std::string found;    ///< found.k0, found.k1
  std::string present;  ///< h."a" IS NOT NULL AND ...
  std::string texts;    ///< n0."name"::text, key.k1::text
  std::string joins;    ///< " JOIN names AS n0 ON n0."id" = key.k0"
};

Keys keys_of(const ResolvedLayout& layout) {
  Keys keys;
  for (std::size_t part = 0; part < layout.key.size(); ++part) {
    const ResolvedKey& key = layout.key[part];
    const std::string number = std::to_string(part);
    const std::string comma = part == 0 ? "" : ", ";
    keys.columns += comma + key.column + " AS k" + number;
    keys.order += comma + key.column;
    keys.found += comma + "found.k" + number;
    keys.present += (part == 0 ? "" : " AND ") + key.column + " IS NOT NULL";
    keys.texts += comma + (key.names ? "n" + number + "." + key.names->name + "::text"
                                     : "key.k" + number + "::text");
    if (key.names) {
      keys.joins += " JOIN " + key.names->relation + " AS n" + number + " ON n" + number + "." +
                    key.names->id + " = key.k" + number;
    }
  }
  return keys;
}

/// WHERE for one tag in a span given by parameters $1 (tag), $2 and $3.
std::string span_of_tag(const PlainTable& table, const std::string& tag_type) {
  const std::string type = native_type(table.time_kind);
  return " WHERE " + table.tag + " = $1::" + tag_type + " AND " + table.time + " >= $2::" + type +
         " AND " + table.time + " <= $3::" + type;
}

}  // namespace

const Statement kFindRelation{"find_relation", R"(
    SELECT c.oid, n.nspname, c.relname, c.relkind IN ('r', 'p', 'm')
    FROM pg_catalog.pg_class AS c JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    LEFT JOIN unnest($3::name[]) WITH ORDINALITY AS own (schema, place) ON own.schema = n.nspname
    WHERE c.relname = $2::name AND c.relkind IN ('r', 'p', 'v', 'm', 'f')
      AND CASE WHEN $1::name = '' THEN own.place IS NOT NULL ELSE n.nspname = $1::name END
    ORDER BY own.place LIMIT 1)"};

const Statement kStillThere{"still_there",
                            "SELECT oid FROM pg_catalog.pg_class WHERE oid = ANY ($1::oid[])"};

const Statement kElsewhere{"elsewhere", R"(
    WITH RECURSIVE below (oid) AS (
      SELECT $1::oid
      UNION
      SELECT next.oid FROM below CROSS JOIN LATERAL (
        SELECT i.inhrelid FROM pg_catalog.pg_inherits AS i WHERE i.inhparent = below.oid
        UNION ALL
        SELECT d.refobjid FROM pg_catalog.pg_rewrite AS r
        JOIN pg_catalog.pg_depend AS d
          ON d.classid = 'pg_catalog.pg_rewrite'::regclass AND d.objid = r.oid
        WHERE r.ev_class = below.oid AND d.refclassid = 'pg_catalog.pg_class'::regclass
      ) AS next (oid))
    SELECT count(*) > 0, max(w.fdwname) FILTER (WHERE t.ftrelid = $1::oid),
           coalesce(bool_or(w.fdwname = 'tds_fdw'), false)
    FROM below JOIN pg_catalog.pg_foreign_table AS t ON t.ftrelid = below.oid
    JOIN pg_catalog.pg_foreign_server AS s ON s.oid = t.ftserver
    JOIN pg_catalog.pg_foreign_data_wrapper AS w ON w.oid = s.srvfdw)",
                           Rows::one};

const Statement kForeignTable{"foreign_table", R"(
    WITH given (server, wrapper, name, value, ours) AS (
      SELECT s.srvname, w.fdwname, o.option_name, o.option_value, o.ours
      FROM pg_catalog.pg_foreign_table AS t
      JOIN pg_catalog.pg_foreign_server AS s ON s.oid = t.ftserver
      JOIN pg_catalog.pg_foreign_data_wrapper AS w ON w.oid = s.srvfdw
      LEFT JOIN LATERAL (
        SELECT *, true FROM pg_catalog.pg_options_to_table(t.ftoptions)
        UNION ALL SELECT *, false FROM pg_catalog.pg_options_to_table(s.srvoptions)
      ) AS o (option_name, option_value, ours) ON true
      WHERE t.ftrelid = $1::oid)
    SELECT server, wrapper, max(value) FILTER (WHERE name = 'dbname'),
           coalesce(max(value) FILTER (WHERE name = 'fetch_size' AND ours),
                    max(value) FILTER (WHERE name = 'fetch_size')),
           coalesce(bool_or(name = 'fetch_size' AND NOT ours), false)
    FROM given GROUP BY server, wrapper)"};

const Statement kColumns{"columns", R"(
    SELECT a.attname, CASE WHEN t.typtype = 'd' THEN base.typname ELSE t.typname END
    FROM pg_catalog.pg_attribute AS a
    JOIN pg_catalog.pg_type AS t ON t.oid = a.atttypid
    LEFT JOIN pg_catalog.pg_type AS base ON base.oid = t.typbasetype
    WHERE a.attrelid = $1::oid AND a.attnum > 0 AND NOT a.attisdropped)"};

const Statement kIndexes{"indexes", R"(
    SELECT (SELECT string_agg(encode(convert_to(a.attname, 'UTF8'), 'hex'), ',' ORDER BY place)
            FROM unnest(i.indkey) WITH ORDINALITY AS k (number, place)
            JOIN pg_catalog.pg_attribute AS a ON a.attrelid = i.indrelid AND a.attnum = k.number
            WHERE place <= i.indnkeyatts),
           (SELECT string_agg(encode(convert_to(a.attname, 'UTF8'), 'hex'), ',')
            FROM pg_catalog.pg_attribute AS a
            WHERE a.attrelid = i.indrelid AND a.attnum = ANY (i.indkey))
    FROM pg_catalog.pg_index AS i
    JOIN pg_catalog.pg_class AS c ON c.oid = i.indexrelid
    JOIN pg_catalog.pg_am AS method ON method.oid = c.relam AND method.amname = 'btree'
    WHERE i.indrelid = $1::oid AND i.indisvalid AND i.indpred IS NULL
      AND NOT (0 = ANY (i.indkey))
    ORDER BY i.indnatts DESC)"};

// TimescaleDB keeps the chunks of a hypertable in a schema of its own, as tables that inherit from
// it.
const Statement kTableKind{"table_kind", R"(
    SELECT c.relkind, EXISTS (
      SELECT FROM pg_catalog.pg_inherits AS i
      JOIN pg_catalog.pg_class AS chunk ON chunk.oid = i.inhrelid
      JOIN pg_catalog.pg_namespace AS n ON n.oid = chunk.relnamespace
      WHERE i.inhparent = c.oid AND n.nspname = '_timescaledb_internal'), home.nspname,
      pg_catalog.pg_get_userbyid(c.relowner)
    FROM pg_catalog.pg_class AS c
    JOIN pg_catalog.pg_namespace AS home ON home.oid = c.relnamespace WHERE c.oid = $1::oid)",
                           Rows::one};

const Statement kPartitions{"partitions", R"(
    SELECT c.oid, n.nspname, c.relname, c.relkind
    FROM pg_catalog.pg_inherits AS i
    JOIN pg_catalog.pg_class AS c ON c.oid = i.inhrelid
    JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    WHERE i.inhparent = $1::oid ORDER BY c.relname)"};

// A right to some of the columns may be enough: reading them says so.
const Statement kReadRights{"read_rights", R"(
    SELECT n.nspname, c.relname,
           has_schema_privilege(n.oid, 'USAGE') AND has_any_column_privilege(c.oid, 'SELECT'),
           current_user, pg_catalog.pg_get_userbyid(c.relowner)
    FROM pg_catalog.unnest($1::oid[]) WITH ORDINALITY AS wanted (oid, place)
    JOIN pg_catalog.pg_class AS c ON c.oid = wanted.oid
    JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace ORDER BY wanted.place)"};

const Statement kWriteRight{"write_right", R"(
    SELECT has_schema_privilege(n.oid, 'USAGE') AND has_table_privilege(c.oid, 'INSERT'),
           current_user
    FROM pg_catalog.pg_class AS c JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    WHERE c.oid = $1::oid)",
                            Rows::one};

const Statement kFindZone{"find_zone",
                          "SELECT 1 FROM pg_catalog.pg_timezone_names WHERE name = $1::text"};

const Statement kNow{"now", R"(
    SELECT (extract(epoch FROM clock_timestamp()) * 1000000)::int8,
           (extract(epoch FROM pg_postmaster_start_time()) * 1000000)::int8)",
                     Rows::one};
const Statement kBegin{"begin", "BEGIN", Rows::none};
const Statement kCommit{"commit", "COMMIT", Rows::none};

Statement find_ids(const ResolvedNames& names, bool lower_too) {
  const std::string wanted =
      lower_too ? "ANY (ARRAY[request.name, lower(request.name)])" : "request.name";
  return {"find_ids", ids_sql(names, "n." + names.name + " = " + wanted)};
}

Statement find_ids_in_any_case(const ResolvedNames& names) {
  return {"find_ids_in_any_case",
          ids_sql(names, "lower(n." + names.name + "::text) = lower(request.name)")};
}

Statement ids_of_names(const std::string& relation, const std::string& name,
                       const std::string& id) {
  return {"ids_of_names", "SELECT DISTINCT n." + id + "::text FROM " + relation +
                              " AS n JOIN unnest($1::text[]) AS wanted (name)"
                              " ON lower(n." +
                              name + "::text) = lower(wanted.name)"};
}

Statement list_partitions(const ResolvedPartitions& list, TimeKind kind) {
  const std::string type = native_type(kind);
  return {"list_partitions", "SELECT p." + list.name + "::text, p." + list.start + "::" + type +
                                 ", p." + list.end + "::" + type + " FROM " + list.relation +
                                 " AS p"};
}

Statement list_names(const ResolvedNames& names) {
  return {"list_names", "SELECT DISTINCT n." + names.name + "::text FROM " + names.relation +
                            " AS n WHERE n." + names.name + " IS NOT NULL"};
}

Statement list_keys(const ResolvedLayout& layout, const std::string& relation, bool loose_scan) {
  const Keys keys = keys_of(layout);
  std::string sql = "SELECT " + keys.columns + " FROM " + relation + " AS h WHERE " + keys.present +
                    " GROUP BY " + keys.order;  // DISTINCT would fetch every row of a foreign table
  if (loose_scan) {
    // PostgreSQL has no skip scan: the recursion looks the next larger key up in the index.
    const std::string first = "SELECT " + keys.columns + " FROM " + relation + " AS h WHERE ";
    const std::string one = " ORDER BY " + keys.order + " LIMIT 1";
    sql = "WITH RECURSIVE found AS ((" + first + keys.present + one + ") UNION ALL SELECT next.*" +
          " FROM found CROSS JOIN LATERAL (" + first + "(" + keys.order + ") > (" + keys.found +
          ")" + one + ") AS next) SELECT * FROM found";
  }
  return {"list_keys", "SELECT " + keys.texts + " FROM (" + sql + ") AS key" + keys.joins};
}

Statement explain(const Statement& statement, bool with_sent) {
  const std::string verbose = with_sent ? "VERBOSE, " : "";
  return {"explain", "EXPLAIN (" + verbose + "COSTS off) " + statement.sql};
}

Statement has_rows(const PlainTable& table, const std::string& tag_type) {
  return {"has_rows",
          "SELECT EXISTS (SELECT FROM " + table.relation + span_of_tag(table, tag_type) + ")",
          Rows::one};
}

Statement delete_rows(const PlainTable& table, const std::string& tag_type) {
  return {"delete_rows", "DELETE FROM " + table.relation + span_of_tag(table, tag_type),
          Rows::none};
}

Statement copy_rows(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality;
  return {"copy_rows",
          "COPY " + table.relation + " (" + table.tag + ", " + table.time + ", " + table.value +
              quality + ") FROM STDIN",
          Rows::none};
}

Statement create_table(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality + " smallint";
  return {"create_table",
          "CREATE TABLE " + table.relation + " (" + table.tag + " text NOT NULL, " + table.time +
              " " + native_type(table.time_kind) + " NOT NULL, " + table.value + " float8" +
              quality + ")",
          Rows::none};
}

// All columns in the index: a window is then read from some 30 pages instead of thousands.
Statement create_index(const PlainTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality;
  return {"create_index",
          "CREATE INDEX ON " + table.relation + " (" + table.tag + ", " + table.time +
              ") INCLUDE (" + table.value + quality + ")",
          Rows::none};
}

}  // namespace loopscope::storage::historian_statements
