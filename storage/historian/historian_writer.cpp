#include "storage/historian/historian_writer.hpp"

#include <algorithm>
#include <cmath>

#include "storage/array_literal.hpp"
#include "storage/historian/native_key.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/refuse.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using historian_statements::PlainTable;

// Large enough that sending costs nothing beside formatting, small enough for the cache.
constexpr std::size_t kChunkBytes = std::size_t{256} * 1024;

/// A field of COPY's text format: backslash, tab and line ends would end it too early.
std::string copy_field(const std::string& text) {
  std::string field;
  for (const char character : text) {
    if (character == '\\' || character == '\t' || character == '\n' || character == '\r') {
      field += '\\';
      field += character == '\t' ? 't' : character == '\n' ? 'n' : character == '\r' ? 'r' : '\\';
    } else {
      field += character;
    }
  }
  return field;
}

/// Codes that a later reading under the same rule takes for good and bad.
const char* quality_code(QualityRule rule, bool good) {
  if (rule == QualityRule::zero) return good ? "\t0" : "\t1";
  return good ? "\t192" : "\t0";
}

void require_plain(const SourceLayout& layout) {
  const bool plain = layout.shape == Shape::narrow && !layout.partitions &&
                     layout.key.size() == 1 && !layout.key.front().names &&
                     layout.value_columns.size() == 1 && layout.nanos_column.empty() &&
                     layout.time_kind != TimeKind::timestamp_local;
  const QualityRule rule = layout.quality.rule;
  const bool known_codes = rule == QualityRule::none || rule == QualityRule::zero ||
                           rule == QualityRule::opcda || rule == QualityRule::opcda_exact;
  if (plain && known_codes) return;
  refuse(layout, "recordings are loaded into plain narrow tables only",
         "import into a historian with the preset narrow; vendors' tables are theirs to write");
}

PlainTable plain_table(const PqConnection& connection, const SourceLayout& layout,
                       const std::string& relation) {
  PlainTable table{relation,
                   connection.quote(layout.key.front().column),
                   connection.quote(layout.time_column),
                   connection.quote(layout.value_columns.front()),
                   "",
                   layout.time_kind};
  if (has_quality(layout)) table.quality = connection.quote(layout.quality_column);
  return table;
}

/// Where the rows go, and how its tags are compared.
struct Target {
  PlainTable table;
  std::string tag_type;
  const SourceLayout& layout;
};

void append_row(std::string& chunk, const std::string& tag_field, std::int64_t time_us,
                double value, const SourceLayout& layout) {
  const bool good = std::isfinite(value);
  chunk += tag_field + '\t' + native_text(layout.time_kind, time_us) + '\t';
  chunk += good ? number_text(value) : "\\N";
  if (has_quality(layout)) chunk += quality_code(layout.quality.rule, good);
  chunk += '\n';
}

/// Parameters of the statements on one tag's span.
std::vector<std::string> span_of(const TagRows& tag, TimeKind kind) {
  const auto [first, last] = std::minmax_element(tag.rows.time_us.begin(), tag.rows.time_us.end());
  return {tag.tag, native_text(kind, *first), native_text(kind, *last)};
}

void make_room(PqConnection& connection, const Target& target, const TagRows& tag, bool replace) {
  if (tag.rows.empty()) return;
  const std::vector<std::string> span = span_of(tag, target.layout.time_kind);
  if (replace) {
    connection.run(historian_statements::delete_rows(target.table, target.tag_type), span);
    return;
  }
  const Statement has_rows = historian_statements::has_rows(target.table, target.tag_type);
  if (connection.run(has_rows, span).text(0, 0) == "t") {
    throw DatabaseError("the tag has rows in that span already, tag " + tag.tag + ", " +
                            target.layout.relation + ", " + connection.target(),
                        "import with --replace to delete them first", Remedy::give_up);
  }
}

void check_tags(std::span<const TagRows> tags, const Target& target) {
  for (const TagRows& tag : tags) {
    if (!native_key(tag.tag, target.tag_type)) {
      throw DatabaseError("the tag does not fit the column's type " + target.tag_type + ", tag " +
                              make_storable(tag.tag) + ", " + target.layout.relation,
                          "give the loop tags of that type", Remedy::give_up);
    }
  }
}

std::size_t copy_tags(PqConnection& connection, const Target& target,
                      std::span<const TagRows> tags) {
  auto tag = tags.begin();
  std::size_t row = 0;
  return connection.copy_in(historian_statements::copy_rows(target.table), [&](std::string& chunk) {
    for (; tag != tags.end() && chunk.size() < kChunkBytes; ++tag, row = 0) {
      const std::string field = copy_field(tag->tag);
      for (; row < tag->rows.time_us.size(); ++row) {
        append_row(chunk, field, tag->rows.time_us[row], tag->rows.value[row], target.layout);
      }
    }
    return !chunk.empty();
  });
}

}  // namespace

std::size_t import_rows(const ConnectionSettings& settings, const SourceLayout& layout,
                        std::span<const TagRows> tags, bool replace) {
  require_plain(layout);
  PqConnection connection(settings);
  const ResolvedLayout resolved = resolve_layout(connection, layout);
  const Target target{plain_table(connection, layout, resolved.data.sql), resolved.key.front().type,
                      layout};
  check_tags(tags, target);
  connection.run(historian_statements::kBegin);
  for (const TagRows& tag : tags) make_room(connection, target, tag, replace);
  const std::size_t written = copy_tags(connection, target, tags);
  connection.run(historian_statements::kCommit);
  return written;
}

bool create_historian_table(const ConnectionSettings& settings, const SourceLayout& layout) {
  require_plain(layout);
  PqConnection connection(settings);
  const RelationName name = split_relation(layout.relation);
  if (find_relation(connection, name)) return false;
  const PlainTable table =
      plain_table(connection, layout,
                  (name.schema.empty() ? "" : connection.quote(name.schema) + ".") +
                      connection.quote(name.table));
  connection.run(historian_statements::kBegin);
  connection.run(historian_statements::create_table(table));
  connection.run(historian_statements::create_index(table));
  connection.run(historian_statements::kCommit);
  return true;
}

}  // namespace loopscope::storage
