#include "storage/historian/historian_writer.hpp"

#include <algorithm>
#include <cmath>

#include "storage/array_literal.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// Large enough that sending costs nothing beside formatting, small enough for the cache.
constexpr std::size_t kChunkBytes = 256 * 1024;

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

void append_row(std::string& chunk, const std::string& tag_field, std::int64_t time_us,
                double value, const ResolvedLayout& layout) {
  const bool good = std::isfinite(value);
  chunk += tag_field + '\t' + native_text(layout.layout.time_kind, time_us) + '\t';
  chunk += good ? number_text(value) : "\\N";
  if (!layout.quality.empty()) chunk += quality_code(layout.layout.quality_rule, good);
  chunk += '\n';
}

/// Parameters of the statements on one tag's span.
std::vector<std::string> span_of(const TagRows& tag, TimeKind kind) {
  const auto [first, last] = std::minmax_element(tag.rows.time_us.begin(), tag.rows.time_us.end());
  return {tag.tag, native_text(kind, *first), native_text(kind, *last)};
}

void make_room(PqConnection& connection, const ResolvedLayout& layout, const TagRows& tag,
               bool replace) {
  if (tag.rows.empty()) return;
  const std::vector<std::string> span = span_of(tag, layout.layout.time_kind);
  if (replace) {
    connection.run(historian_statements::delete_rows(layout), span);
    return;
  }
  if (connection.run(historian_statements::has_rows(layout), span).text(0, 0) == "t") {
    throw DatabaseError("the tag has rows in that span already, tag " + tag.tag + ", " +
                            layout.layout.relation + ", " + connection.target(),
                        "import with --replace to delete them first", Remedy::give_up);
  }
}

void check_tags(std::span<const TagRows> tags, const ResolvedLayout& layout) {
  for (const TagRows& tag : tags) {
    if (!native_tag(tag.tag, layout.tag_type)) {
      throw DatabaseError("the tag does not fit the column's type " + layout.tag_type + ", tag " +
                              make_storable(tag.tag) + ", " + layout.layout.relation,
                          "give the loop tags of that type", Remedy::give_up);
    }
  }
}

std::size_t copy_tags(PqConnection& connection, const ResolvedLayout& layout,
                      std::span<const TagRows> tags) {
  auto tag = tags.begin();
  std::size_t row = 0;
  return connection.copy_in(historian_statements::copy_rows(layout), [&](std::string& chunk) {
    for (; tag != tags.end() && chunk.size() < kChunkBytes; ++tag, row = 0) {
      const std::string field = copy_field(tag->tag);
      for (; row < tag->rows.time_us.size(); ++row) {
        append_row(chunk, field, tag->rows.time_us[row], tag->rows.value[row], layout);
      }
    }
    return !chunk.empty();
  });
}

}  // namespace

std::size_t import_rows(const ConnectionSettings& settings, const NarrowLayout& layout,
                        std::span<const TagRows> tags, bool replace) {
  PqConnection connection(settings);
  const ResolvedLayout resolved = resolve_layout(connection, layout);
  check_tags(tags, resolved);
  connection.run(historian_statements::kBegin);
  for (const TagRows& tag : tags) make_room(connection, resolved, tag, replace);
  const std::size_t written = copy_tags(connection, resolved, tags);
  connection.run(historian_statements::kCommit);
  return written;
}

bool create_historian_table(const ConnectionSettings& settings, const NarrowLayout& layout) {
  PqConnection connection(settings);
  const RelationName name = split_relation(layout.relation);
  if (connection.run(historian_statements::kFindRelation, {name.schema, name.table}).size() > 0) {
    return false;
  }
  historian_statements::NewTable table;
  table.relation = (name.schema.empty() ? "" : connection.quote(name.schema) + ".") +
                   connection.quote(name.table);
  table.tag = connection.quote(layout.tag_column);
  table.time = connection.quote(layout.time_column);
  table.value = connection.quote(layout.value_column);
  if (has_quality(layout)) table.quality = connection.quote(layout.quality_column);
  table.time_kind = layout.time_kind;
  connection.run(historian_statements::kBegin);
  connection.run(historian_statements::create_table(table));
  connection.run(historian_statements::create_index(table));
  connection.run(historian_statements::kCommit);
  return true;
}

}  // namespace loopscope::storage
