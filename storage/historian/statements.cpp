#include "storage/historian/statements.hpp"

#include "storage/historian/native_time.hpp"

namespace loopscope::storage::historian_statements {
namespace {

/// "row"."tag" = requested: the requested value is cast to the column's own kind of type.
std::string tag_is(const ResolvedLayout& layout, const std::string& requested) {
  return "h." + layout.tag + " = " + requested;
}

std::string type_of(const ResolvedLayout& layout) {
  return native_type(layout.layout.time_kind);
}

/// The time as the eight-byte type that native_time reads.
std::string time_column(const ResolvedLayout& layout) {
  return "h." + layout.time + "::" + type_of(layout);
}

/// The value as a double, NULL where the quality is not good. An unknown quality (NULL) is bad.
std::string value_column(const ResolvedLayout& layout) {
  const std::string value = "h." + layout.value + layout.value_cast;
  if (layout.quality.empty()) return value;
  const std::string quality = "h." + layout.quality;
  const std::string good = layout.layout.quality_rule == QualityRule::opcda
                               ? "(" + quality + " & 192) = 192"
                               : quality + " = 0";
  return "CASE WHEN " + good + " THEN " + value + " END";
}

/// WHERE for one tag in a span given by parameters $1 (tag), $2 and $3.
std::string span_of_tag(const ResolvedLayout& layout) {
  const std::string time = "h." + layout.time;
  return " WHERE " + tag_is(layout, "$1::" + layout.tag_type) + " AND " + time +
         " >= $2::" + type_of(layout) + " AND " + time + " <= $3::" + type_of(layout);
}

}  // namespace

const Statement kFindRelation{"find_relation", R"(
    SELECT c.oid, n.nspname, c.relname, c.relkind IN ('r', 'p', 'm')
    FROM pg_catalog.pg_class AS c JOIN pg_catalog.pg_namespace AS n ON n.oid = c.relnamespace
    WHERE c.relname = $2::name AND c.relkind IN ('r', 'p', 'v', 'm', 'f')
      AND CASE WHEN $1::name = '' THEN pg_catalog.pg_table_is_visible(c.oid)
               ELSE n.nspname = $1::name END)"};

const Statement kColumns{"columns", R"(
    SELECT a.attname, CASE WHEN t.typtype = 'd' THEN base.typname ELSE t.typname END
    FROM pg_catalog.pg_attribute AS a
    JOIN pg_catalog.pg_type AS t ON t.oid = a.atttypid
    LEFT JOIN pg_catalog.pg_type AS base ON base.oid = t.typbasetype
    WHERE a.attrelid = $1::oid AND a.attnum > 0 AND NOT a.attisdropped)"};

const Statement kIndexes{"indexes", R"(
    SELECT array_to_string(ARRAY(
             SELECT a.attname FROM pg_catalog.pg_attribute AS a
             WHERE a.attrelid = i.indrelid AND a.attnum = ANY (i.indkey)), ',')
    FROM pg_catalog.pg_index AS i
    JOIN pg_catalog.pg_attribute AS first
      ON first.attrelid = i.indrelid AND first.attnum = i.indkey[0]
    JOIN pg_catalog.pg_attribute AS second
      ON second.attrelid = i.indrelid AND second.attnum = i.indkey[1]
    WHERE i.indrelid = $1::oid AND i.indisvalid AND i.indpred IS NULL
      AND first.attname = $2::name AND second.attname = $3::name
    ORDER BY i.indnatts DESC)"};

const Statement kNow{"now", "SELECT (extract(epoch FROM clock_timestamp()) * 1000000)::int8",
                     Rows::one};
const Statement kBegin{"begin", "BEGIN", Rows::none};
const Statement kCommit{"commit", "COMMIT", Rows::none};

// One index scan per tag and one round trip per batch: arrays cost the client a sixth of what rows
// cost. Every scan has a lower bound: without one, a dead tag's scan would walk through the whole
// history. array_agg keeps the order of its subquery.
Statement read_rows(const ResolvedLayout& layout) {
  const std::string type = type_of(layout);
  const std::string time = "h." + layout.time;
  const std::string from =
      " FROM " + layout.relation + " AS h WHERE " + tag_is(layout, "request.tag") + " AND " + time;
  const std::string newest_first = " ORDER BY " + time + " DESC LIMIT ";
  return {
      "read_rows",
      "SELECT request.slot, span.times, span.\"values\", before.time, before.value"
      " FROM unnest($1::" +
          layout.tag_type + "[], $2::" + type + "[], $3::" + type + "[], $4::int8[], $5::" + type +
          "[])"
          " WITH ORDINALITY AS request (tag, from_time, to_time, max_rows, before_time, slot)"
          " CROSS JOIN LATERAL (SELECT array_agg(x.time) AS times, array_agg(x.value) AS \"values\""
          " FROM (SELECT " +
          time_column(layout) + " AS time, " + value_column(layout) + " AS value" + from +
          " >= request.from_time AND " + time + " <= request.to_time" + newest_first +
          "request.max_rows) AS x) AS span"
          " LEFT JOIN LATERAL (SELECT " +
          time_column(layout) + " AS time, " + value_column(layout) + " AS value" + from +
          " >= request.before_time AND " + time + " < request.from_time" + newest_first +
          "1) AS before ON true"};
}

Statement newest_rows(const ResolvedLayout& layout) {
  const std::string type = type_of(layout);
  const std::string time = "h." + layout.time;
  return {"newest_rows", "SELECT request.slot, newest.time FROM unnest($1::" + layout.tag_type +
                             "[]) WITH ORDINALITY AS request (tag, slot)"
                             " CROSS JOIN LATERAL (SELECT " +
                             time_column(layout) + " AS time FROM " + layout.relation +
                             " AS h WHERE " + tag_is(layout, "request.tag") + " AND " + time +
                             " >= $2::" + type + " AND " + time + " <= $3::" + type + " ORDER BY " +
                             time + " DESC LIMIT 1) AS newest"};
}

Statement newest_row(const ResolvedLayout& layout) {
  const std::string time = "h." + layout.time;
  return {"newest_row", "SELECT " + time_column(layout) + " FROM " + layout.relation +
                            " AS h WHERE " + time + " >= $1::" + type_of(layout) + " ORDER BY " +
                            time + " DESC LIMIT 1"};
}

// PostgreSQL has no skip scan: the recursion looks the next larger tag up in the index.
Statement list_tags(const ResolvedLayout& layout) {
  const std::string from = " FROM " + layout.relation + " AS h WHERE h." + layout.tag;
  const std::string first = " ORDER BY h." + layout.tag + " LIMIT 1)";
  return {"list_tags", "WITH RECURSIVE found AS ((SELECT h." + layout.tag + " AS tag" + from +
                           " IS NOT NULL" + first + " UNION ALL SELECT (SELECT h." + layout.tag +
                           from + " > found.tag" + first +
                           " FROM found WHERE found.tag IS NOT NULL)"
                           " SELECT found.tag::text FROM found WHERE found.tag IS NOT NULL"};
}

Statement distinct_tags(const ResolvedLayout& layout) {
  return {"distinct_tags", "SELECT DISTINCT h." + layout.tag + "::text FROM " + layout.relation +
                               " AS h WHERE h." + layout.tag + " IS NOT NULL"};
}

Statement try_read(const ResolvedLayout& layout) {
  return {"try_read",
          "SELECT h." + layout.tag + ", " + time_column(layout) + ", " + value_column(layout) +
              " FROM " + layout.relation + " AS h LIMIT 0",
          Rows::none};
}

Statement has_rows(const ResolvedLayout& layout) {
  return {"has_rows",
          "SELECT EXISTS (SELECT FROM " + layout.relation + " AS h" + span_of_tag(layout) + ")",
          Rows::one};
}

Statement delete_rows(const ResolvedLayout& layout) {
  return {"delete_rows", "DELETE FROM " + layout.relation + " AS h" + span_of_tag(layout),
          Rows::none};
}

Statement copy_rows(const ResolvedLayout& layout) {
  const std::string quality = layout.quality.empty() ? "" : ", " + layout.quality;
  return {"copy_rows",
          "COPY " + layout.relation + " (" + layout.tag + ", " + layout.time + ", " + layout.value +
              quality + ") FROM STDIN",
          Rows::none};
}

Statement create_table(const NewTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality + " smallint";
  return {"create_table",
          "CREATE TABLE " + table.relation + " (" + table.tag + " text NOT NULL, " + table.time +
              " " + native_type(table.time_kind) + " NOT NULL, " + table.value + " float8" +
              quality + ")",
          Rows::none};
}

// All columns in the index: a window is then read from some 30 pages instead of thousands.
Statement create_index(const NewTable& table) {
  const std::string quality = table.quality.empty() ? "" : ", " + table.quality;
  return {"create_index",
          "CREATE INDEX ON " + table.relation + " (" + table.tag + ", " + table.time +
              ") INCLUDE (" + table.value + quality + ")",
          Rows::none};
}

}  // namespace loopscope::storage::historian_statements
