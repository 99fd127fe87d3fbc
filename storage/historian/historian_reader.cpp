#include "storage/historian/historian_reader.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "storage/array_literal.hpp"
#include "storage/error.hpp"
#include "storage/historian/find_partitions.hpp"
#include "storage/historian/find_tags.hpp"
#include "storage/historian/foreign_plan.hpp"
#include "storage/historian/merge_series.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/scan.hpp"
#include "storage/historian/scan_reader.hpp"
#include "storage/historian/scan_rows.hpp"
#include "storage/historian/scan_statements.hpp"
#include "storage/historian/statements.hpp"
#include "storage/historian/tag_value.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using core::signal::RawSeries;
using Places = std::vector<std::vector<TagPlace>>;

// newest() returns one value per key.
constexpr std::size_t kMaxNewestKeys = 1024;
// How far back the newest row of a tag is looked for: archives of old recordings are analysed too,
// and the bound only keeps the planner from giving up the index.
constexpr std::int64_t kNewestReachUs = 30 * kReachBefore_us;
constexpr auto kNewestSpans_us = [] {
  std::array<std::int64_t, kGrowingSpans_us.size() + 1> spans{};
  std::ranges::copy(kGrowingSpans_us, spans.begin());
  spans.back() = kNewestReachUs;
  return spans;
}();

ConnectionSettings as_reader(ConnectionSettings settings) {
  settings.read_only = true;
  return settings;
}

// SQLSTATE of a data exception: other windows can be read.
constexpr const char* kOneWindow = "22000";

/// While the table is being written, no loop of the historian can be judged.
[[noreturn]] void refuse_missing(const ResolvedLayout& layout, const Partitions::Missing& missing) {
  throw DatabaseError("no foreign table " + make_storable(missing.name) + ", which " +
                          layout.layout.partitions->relation + " lists, historian " +
                          layout.layout.source,
                      "import it: loopscope check-config prints the statement", Remedy::give_up,
                      missing.last ? "" : kOneWindow);
}

/// The spans in which newest rows are looked for, shortest first. Where one look tells, however far
/// back, the longest will do; but each table of a list is a look of its own.
std::span<const std::int64_t> newest_spans(const ResolvedLayout& layout) {
  const bool at_once =
      layout.largest_elsewhere && !layout.partitions && layout.layout.shape == Shape::narrow;
  return std::span(kNewestSpans_us).last(at_once ? 1 : kNewestSpans_us.size());
}

/// The parts that were read of every request, one a place.
std::vector<std::vector<RawSeries>> empty_parts(const Places& places) {
  std::vector<std::vector<RawSeries>> parts;
  for (const auto& of_tag : places) parts.emplace_back(of_tag.size());
  return parts;
}

/// A key and the tags whose rows stand under it.
struct KeyOfTags {
  std::vector<std::string> key;
  std::vector<std::size_t> tags;
};

/// By the column of their values (empty in narrow tables): a column may be dead while its row
/// lives.
using KeysByColumn = std::map<std::string, std::vector<KeyOfTags>>;

KeysByColumn keys_by_column(const Places& places) {
  std::map<std::pair<std::string, std::vector<std::string>>, std::vector<std::size_t>> tags_of;
  for (std::size_t tag = 0; tag < places.size(); ++tag) {
    for (const TagPlace& place : places[tag]) tags_of[{place.column, place.key}].push_back(tag);
  }
  KeysByColumn keys;
  for (auto& [place, tags] : tags_of) {
    keys[place.first].push_back({place.second, std::move(tags)});
  }
  return keys;
}

/// Keys all of whose tags have a row already: what other ids of a tag have is older.
void forget_found(KeysByColumn& keys, const std::vector<std::optional<std::int64_t>>& newest) {
  for (auto& [column, of_column] : keys) {
    std::erase_if(of_column, [&newest](const KeyOfTags& key) {
      return std::ranges::all_of(key.tags,
                                 [&newest](std::size_t tag) { return newest[tag].has_value(); });
    });
  }
  std::erase_if(keys, [](const auto& of_column) { return of_column.second.empty(); });
}

std::vector<std::string> newest_parameters(std::span<const KeyOfTags> batch,
                                           const ResolvedLayout& layout, std::int64_t earliest_us,
                                           std::int64_t latest_us) {
  std::vector<std::string> parameters;
  if (layout.foreign) parameters = batch.front().key;
  for (std::size_t part = 0; !layout.foreign && part < layout.key.size(); ++part) {
    ArrayLiteral keys;
    for (const KeyOfTags& tagged : batch) keys.add_text(tagged.key[part]);
    parameters.push_back(keys.text());
  }
  const TimeKind kind = layout.layout.time_kind;
  parameters.push_back(native_bound(kind, earliest_us, Bound::lower));
  parameters.push_back(native_bound(kind, latest_us, Bound::upper));
  return parameters;
}

}  // namespace

struct HistorianReader::Impl {
  Impl(const ConnectionSettings& settings, const SourceLayout& source)
      : connection(as_reader(settings)),
        layout(resolve_layout(connection, source)),
        scans(connection, layout) {
    if (layout.partitions) partitions.emplace(connection, layout);
    if (source.shape == Shape::narrow)
      connection.run(
          historian_statements::try_read(layout, value_of(connection, layout, "").value()));
    layout.largest_elsewhere = asks_for_largest(connection, layout);
  }

  std::vector<std::string> relations(std::int64_t from_us, std::int64_t to_us) {
    return partitions ? partitions->within(from_us, to_us) : std::vector{layout.data.sql};
  }

  /// A listed table that is not in PostgreSQL was dropped by the historian; but of another server
  /// it is mostly there and was not imported here, and its rows would be missing without a word.
  void require_imported(std::int64_t from_us, std::int64_t to_us) const {
    if (!layout.foreign || !partitions) return;
    const auto missing = partitions->missing(from_us, to_us);
    if (!missing.empty()) refuse_missing(layout, missing.front());
  }

  /// Historians add columns and tables while they run.
  void look_again(std::span<const std::vector<TagPlace>> places) {
    if (partitions) partitions->refresh();
    const bool all_known = std::all_of(places.begin(), places.end(), [this](const auto& of_tag) {
      return of_tag.empty() || of_tag.front().column.empty() ||
             layout.data.types.contains(of_tag.front().column);
    });
    if (all_known) return;
    const bool largest_elsewhere = layout.largest_elsewhere;
    layout = resolve_layout(connection, layout.layout);
    layout.largest_elsewhere = largest_elsewhere;
  }

  /// Raises the entries of `newest` that the batch's keys stand for.
  void newest_of(const Statement& statement, std::span<const KeyOfTags> batch,
                 std::int64_t earliest_us, std::int64_t latest_us,
                 std::vector<std::optional<std::int64_t>>& newest) {
    const TimeKind kind = layout.layout.time_kind;
    run_decoded(connection, statement, newest_parameters(batch, layout, earliest_us, latest_us),
                [&](const PqRows& rows) {
                  for (int row = 0; row < rows.size(); ++row) {
                    const std::int64_t time_us =
                        microseconds(kind, decode_value(rows.bytes(row, 1)));
                    for (const std::size_t tag : batch[slot_of(rows, row, batch.size())].tags) {
                      newest[tag] = std::max(newest[tag].value_or(kEarliestTimeUs), time_us);
                    }
                  }
                });
  }

  /// The same of all keys, within a span.
  void newest_within(std::int64_t earliest_us, std::int64_t latest_us, const KeysByColumn& keys,
                     std::vector<std::optional<std::int64_t>>& newest) {
    const std::vector<std::string> tables = relations(earliest_us, latest_us);
    if (tables.empty()) return;
    const std::size_t at_a_time = layout.foreign ? 1 : kMaxNewestKeys;
    for (const auto& [column, of_column] : keys) {
      if (!column.empty() && !layout.data.types.contains(column)) continue;
      const std::string quoted = column.empty() ? "" : "h." + connection.quote(column);
      const Statement statement = historian_statements::newest_rows(layout, tables, quoted);
      for (std::size_t done = 0; done < of_column.size(); done += at_a_time) {
        const std::size_t count = std::min(at_a_time, of_column.size() - done);
        newest_of(statement, std::span(of_column).subspan(done, count), earliest_us, latest_us,
                  newest);
      }
    }
  }

  PqConnection connection;
  ResolvedLayout layout;
  std::optional<Partitions> partitions;
  ScanReader scans;
};

HistorianReader::HistorianReader(const ConnectionSettings& settings, const SourceLayout& layout)
    : impl_(std::make_unique<Impl>(settings, layout)) {}
HistorianReader::~HistorianReader() = default;
HistorianReader::HistorianReader(HistorianReader&&) noexcept = default;
HistorianReader& HistorianReader::operator=(HistorianReader&&) noexcept = default;

std::vector<RawSeries> HistorianReader::read(std::span<const TagRequest> requests) {
  std::vector<std::string> tags;
  for (const TagRequest& request : requests) tags.push_back(request.tag);
  const Places places = find_tags(impl_->connection, impl_->layout, tags);
  impl_->look_again(places);
  for (const TagRequest& request : requests)
    impl_->require_imported(request.from_us, request.to_us);
  std::vector<std::vector<RawSeries>> parts = empty_parts(places);
  const auto tables_of = [this](std::int64_t from_us, std::int64_t to_us) {
    return impl_->relations(from_us, to_us);
  };
  for (const auto& batch : plan_scans(impl_->connection, impl_->layout, requests, places)) {
    impl_->scans.read(batch, tables_of, parts);
  }
  std::vector<RawSeries> series(requests.size());
  for (std::size_t k = 0; k < requests.size(); ++k) {
    series[k] = merge_series(std::move(parts[k]), requests[k]);
    if (!places[k].empty()) series[k].hold = places[k].back().hold;
    if (requests[k].mode) decode_modes(series[k], impl_->layout.layout.modes);
  }
  return series;
}

std::vector<std::optional<std::int64_t>> HistorianReader::newest(std::span<const std::string> tags,
                                                                 std::int64_t not_after_us) {
  const Places places = find_tags(impl_->connection, impl_->layout, tags);
  impl_->look_again(places);
  impl_->require_imported(not_after_us, not_after_us);
  std::vector<std::optional<std::int64_t>> newest(tags.size());
  auto keys = keys_by_column(places);
  for (const std::int64_t span_us : newest_spans(impl_->layout)) {
    impl_->newest_within(clamp_time(not_after_us) - span_us, not_after_us, keys, newest);
    forget_found(keys, newest);
    if (keys.empty()) break;
  }
  return newest;
}

void HistorianReader::on_statement(std::function<void()> told) {
  impl_->connection.on_statement(std::move(told));
}

ServerClock HistorianReader::clock() {
  ServerClock clock;
  run_decoded(impl_->connection, historian_statements::kNow, {}, [&](const PqRows& rows) {
    clock.now_us = static_cast<std::int64_t>(decode_value(rows.bytes(0, 0)));
    clock.started_us = static_cast<std::int64_t>(decode_value(rows.bytes(0, 1)));
  });
  return clock;
}

}  // namespace loopscope::storage
