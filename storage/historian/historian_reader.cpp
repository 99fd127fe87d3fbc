#include "storage/historian/historian_reader.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/signal/loop_window.hpp"
#include "storage/array_literal.hpp"
#include "storage/historian/native_time.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/historian/resolve_layout.hpp"
#include "storage/historian/statements.hpp"
#include "storage/timestamp.hpp"

namespace loopscope::storage {
namespace {

using core::signal::kMissing;
using core::signal::RawSeries;

// 32 loops of three tags: larger batches read no faster and hold more memory.
constexpr std::size_t kMaxTags = 96;
// The rows that a batch may ask for: 96 windows of 4096 samples with some to spare, about 20 MB.
constexpr std::int64_t kMaxRows = 786'432;
// newest() returns one value per tag.
constexpr std::size_t kMaxNewestTags = 1024;
constexpr std::int64_t kYearUs = std::int64_t{366} * 86'400 * 1'000'000;
// How far back a row before the window is looked for: a setpoint may stand still for months.
constexpr std::int64_t kReachUs = kYearUs;
// How far back the newest row of a tag is looked for: archives of old recordings are analysed too,
// and the bound only keeps the planner from giving up the index.
constexpr std::int64_t kNewestReachUs = 30 * kYearUs;

constexpr std::uint64_t kMissingBits = std::bit_cast<std::uint64_t>(kMissing);

double finite_or_missing(std::uint64_t bits) {
  const auto value = std::bit_cast<double>(bits);
  return std::isfinite(value) ? value : kMissing;
}

/// How many of `requests` go into the next round trip: at least one.
std::size_t batch_size(std::span<const TagRequest> requests) {
  std::int64_t rows = 0;
  std::size_t count = 0;
  while (count < std::min(requests.size(), kMaxTags)) {
    rows += std::min(requests[count].max_rows, kMaxRows);
    if (count > 0 && rows > kMaxRows) break;
    ++count;
  }
  return count;
}

void add_tag(ArrayLiteral& array, const std::string& tag, const ResolvedLayout& layout) {
  const std::optional<std::string> native = native_tag(tag, layout.tag_type);
  native ? array.add_text(*native) : array.add_null();
}

std::vector<std::string> read_parameters(std::span<const TagRequest> requests,
                                         const ResolvedLayout& layout) {
  const TimeKind kind = layout.layout.time_kind;
  ArrayLiteral tag, from, to, max_rows, before;
  for (const TagRequest& request : requests) {
    add_tag(tag, request.tag, layout);
    from.add_text(native_bound(kind, request.from_us, Bound::lower));
    to.add_text(native_bound(kind, request.to_us, Bound::upper));
    max_rows.add_integer(std::max<std::int64_t>(request.max_rows, 0));
    if (request.before) {
      before.add_text(native_bound(kind, clamp_time(request.from_us) - kReachUs, Bound::lower));
    } else {
      before.add_null();
    }
  }
  return {tag.text(), from.text(), to.text(), max_rows.text(), before.text()};
}

/// The rows of one request: newest first on the wire, ascending in the series.
RawSeries read_series(const PqRows& rows, int row, TimeKind kind) {
  std::vector<std::uint64_t> times, values;
  if (!rows.is_null(row, 1)) {
    times = decode_array(rows.bytes(row, 1), native_element(kind), 0);
    values = decode_array(rows.bytes(row, 2), ElementType::float8, kMissingBits);
  }
  if (times.size() != values.size()) throw MalformedArray("times and values differ in number");
  if (!rows.is_null(row, 3)) {
    times.push_back(decode_value(rows.bytes(row, 3)));
    values.push_back(rows.is_null(row, 4) ? kMissingBits : decode_value(rows.bytes(row, 4)));
  }
  RawSeries series;
  series.time_us.resize(times.size());
  series.value.resize(values.size());
  std::transform(times.rbegin(), times.rend(), series.time_us.begin(),
                 [kind](std::uint64_t bits) { return microseconds(kind, bits); });
  std::transform(values.rbegin(), values.rend(), series.value.begin(), finite_or_missing);
  return series;
}

std::size_t slot_of(const PqRows& rows, int row, std::size_t slots) {
  const std::uint64_t slot = decode_value(rows.bytes(row, 0));
  if (slot < 1 || slot > slots) throw MalformedArray("a row of an unknown slot");
  return static_cast<std::size_t>(slot - 1);
}

ConnectionSettings as_reader(ConnectionSettings settings) {
  settings.read_only = true;
  return settings;
}

}  // namespace

struct HistorianReader::Impl {
  Impl(const ConnectionSettings& settings, const NarrowLayout& narrow)
      : connection(as_reader(settings)),
        layout(resolve_layout(connection, narrow)),
        read_rows(historian_statements::read_rows(layout)),
        newest_rows(historian_statements::newest_rows(layout)) {
    connection.run(historian_statements::try_read(layout));
  }

  /// Runs `read(rows)` on the answer and turns bytes that make no sense into a database error.
  template <typename Read>
  void query(const Statement& statement, const std::vector<std::string>& parameters, Read read) {
    const PqRows rows = connection.run(statement, parameters, ResultFormat::binary);
    try {
      read(rows);
    } catch (const MalformedArray& error) {
      throw DatabaseError(
          std::string(error.what()) + ", statement " + statement.name + ", " + connection.target(),
          "the server answered in a form that this program does not know: report "
          "this with the server's version",
          Remedy::give_up);
    }
  }

  PqConnection connection;
  ResolvedLayout layout;
  Statement read_rows;
  Statement newest_rows;
};

HistorianReader::HistorianReader(const ConnectionSettings& settings, const NarrowLayout& layout)
    : impl_(std::make_unique<Impl>(settings, layout)) {}
HistorianReader::~HistorianReader() = default;
HistorianReader::HistorianReader(HistorianReader&&) noexcept = default;
HistorianReader& HistorianReader::operator=(HistorianReader&&) noexcept = default;

std::vector<RawSeries> HistorianReader::read(std::span<const TagRequest> requests) {
  std::vector<RawSeries> series(requests.size());
  for (std::size_t done = 0; done < requests.size();) {
    const auto batch = requests.subspan(done, batch_size(requests.subspan(done)));
    impl_->query(impl_->read_rows, read_parameters(batch, impl_->layout), [&](const PqRows& rows) {
      for (int row = 0; row < rows.size(); ++row) {
        series[done + slot_of(rows, row, batch.size())] =
            read_series(rows, row, impl_->layout.layout.time_kind);
      }
    });
    done += batch.size();
  }
  return series;
}

std::vector<std::optional<std::int64_t>> HistorianReader::newest(std::span<const std::string> tags,
                                                                 std::int64_t not_after_us) {
  const TimeKind kind = impl_->layout.layout.time_kind;
  const std::string from =
      native_bound(kind, clamp_time(not_after_us) - kNewestReachUs, Bound::lower);
  const std::string to = native_bound(kind, not_after_us, Bound::upper);
  std::vector<std::optional<std::int64_t>> newest(tags.size());
  for (std::size_t done = 0; done < tags.size(); done += kMaxNewestTags) {
    const auto batch = tags.subspan(done, std::min(kMaxNewestTags, tags.size() - done));
    ArrayLiteral tag;
    for (const std::string& name : batch) add_tag(tag, name, impl_->layout);
    impl_->query(impl_->newest_rows, {tag.text(), from, to}, [&](const PqRows& rows) {
      for (int row = 0; row < rows.size(); ++row) {
        newest[done + slot_of(rows, row, batch.size())] =
            microseconds(kind, decode_value(rows.bytes(row, 1)));
      }
    });
  }
  return newest;
}

std::int64_t HistorianReader::now_us() {
  std::int64_t now = 0;
  impl_->query(historian_statements::kNow, {}, [&](const PqRows& rows) {
    now = static_cast<std::int64_t>(decode_value(rows.bytes(0, 0)));
  });
  return now;
}

}  // namespace loopscope::storage
