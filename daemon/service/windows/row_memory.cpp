#include "daemon/service/windows/row_memory.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "storage/timestamp.hpp"

namespace loopscope::daemon {
namespace {

using core::signal::Hold;
using core::signal::RawSeries;
using storage::RowBefore;
using storage::TagRequest;

/// Place of the first row that is not before `time_us`.
std::size_t first_from(const RawSeries& rows, std::int64_t time_us) {
  return static_cast<std::size_t>(std::ranges::lower_bound(rows.time_us, time_us) -
                                  rows.time_us.begin());
}

void append(const RawSeries& more, std::size_t first, std::size_t last, RawSeries& rows) {
  const auto part = [&](const auto& from, auto& to) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first),
              from.begin() + static_cast<std::ptrdiff_t>(last));
  };
  part(more.time_us, rows.time_us);
  part(more.value, rows.value);
}

void append_within(const RawSeries& more, std::int64_t from_us, std::int64_t to_us,
                   RawSeries& rows) {
  if (from_us > to_us) return;
  append(more, first_from(more, from_us), first_from(more, to_us + 1), rows);
}

void append_all(const RawSeries& more, RawSeries& rows) {
  append(more, 0, more.time_us.size(), rows);
}

bool wants_before(const TagRequest& request, Hold hold) {
  return request.before == RowBefore::yes ||
         (request.before == RowBefore::if_held && hold != Hold::sample);
}

/// Whether what is known tells which row comes before `from_us`, which lies in its span or at the
/// end of it.
bool tells_before(const KnownRows& known, std::int64_t from_us) {
  return known.before_known ||
         first_from(known.rows, from_us) > first_from(known.rows, known.from_us);
}

/// Appends the newest row before the request's span, unless it lies further back than one is looked
/// for.
void append_before(const KnownRows& known, const TagRequest& request, RawSeries& rows) {
  const std::size_t inside = first_from(known.rows, request.from_us);
  const std::int64_t reach_us = storage::clamp_time(request.from_us) - storage::kReachBefore_us;
  if (inside == 0 || known.rows.time_us[inside - 1] < reach_us) return;
  append(known.rows, inside - 1, inside, rows);
}

std::int64_t count_inside(const RawSeries& rows, const TagRequest& request) {
  return static_cast<std::int64_t>(rows.time_us.size() - first_from(rows, request.from_us));
}

/// Whether all rows of the request's span are there and none depends on rows beyond it: they were
/// not cut off by their number, do not compete with those of another id, and have no codes of
/// unknown quality, which are counted for a span as a whole.
bool is_whole(const RawSeries& rows, const TagRequest& request) {
  return !rows.merged && rows.unknown_quality == 0 &&
         count_inside(rows, request) < request.max_rows;
}

KnownRows known_by(const TagRequest& request, const RawSeries& rows) {
  return {request.from_us, request.to_us, wants_before(request, rows.hold), rows};
}

bool meet(const KnownRows& a, const KnownRows& b) {
  return a.from_us <= b.to_us + 1 && b.from_us <= a.to_us + 1;
}

/// Of spans that meet.
KnownRows united(const KnownRows& known, const KnownRows& more) {
  KnownRows all{
      std::min(known.from_us, more.from_us), std::max(known.to_us, more.to_us), false, {}};
  const bool begins_earlier =
      more.from_us < known.from_us || (more.from_us == known.from_us && more.before_known);
  const KnownRows& earlier = begins_earlier ? more : known;
  const KnownRows& other = &earlier == &more ? known : more;
  all.before_known = earlier.before_known;
  all.rows = earlier.rows;
  append_within(other.rows, earlier.to_us + 1, other.to_us, all.rows);
  return all;
}

}  // namespace

/// What a request is put together of: rows read before what is known, those known, rows read after
/// it.
struct RowMemory::Pieces {
  const KnownRows* known = nullptr;  ///< nullptr = nothing that can be used: all is read
  std::optional<TagRequest> head, tail;
  RawSeries head_rows = {}, tail_rows = {};

  [[nodiscard]] RawSeries joined(const TagRequest& request) const {
    RawSeries rows;
    rows.hold = known->rows.hold;
    if (head) {
      rows = head_rows;
    } else if (wants_before(request, rows.hold)) {
      append_before(*known, request, rows);
    }
    append_within(known->rows, std::max(request.from_us, known->from_us),
                  std::min(request.to_us, known->to_us), rows);
    append_all(tail_rows, rows);
    return rows;
  }

  /// Whether what was read fits to what is known: a tag may have become another one.
  [[nodiscard]] bool fit() const {
    const auto fits = [this](const std::optional<TagRequest>& part, const RawSeries& rows) {
      return !part || (is_whole(rows, *part) && rows.hold == known->rows.hold);
    };
    return fits(head, head_rows) && fits(tail, tail_rows);
  }
};

RowMemory::Pieces RowMemory::pieces_of(const TagRequest& request) const {
  const KnownRows* known = find(request.tag, request.mode);
  if (known == nullptr || !meet(*known, {request.from_us, request.to_us, false, {}})) return {};
  const bool begins_inside = request.from_us >= known->from_us;
  if (begins_inside && wants_before(request, known->rows.hold) &&
      !tells_before(*known, request.from_us))
    return {};
  Pieces pieces{known, std::nullopt, std::nullopt};
  if (!begins_inside) {
    pieces.head = request;
    pieces.head->to_us = known->from_us - 1;
  }
  if (request.to_us > known->to_us) {
    pieces.tail = request;
    pieces.tail->from_us = known->to_us + 1;
    pieces.tail->before = RowBefore::no;
  }
  return pieces;
}

std::vector<RawSeries> RowMemory::read_pieces(std::span<const TagRequest> requests,
                                              std::vector<Pieces>& pieces, const Read& read) {
  std::vector<TagRequest> missing;
  std::vector<RawSeries*> places;
  std::vector<RawSeries> series(requests.size());
  const auto want = [&](const TagRequest& request, RawSeries& place) {
    missing.push_back(request);
    places.push_back(&place);
  };
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (pieces[k].known == nullptr) want(requests[k], series[k]);
    if (pieces[k].head) want(*pieces[k].head, pieces[k].head_rows);
    if (pieces[k].tail) want(*pieces[k].tail, pieces[k].tail_rows);
  }
  if (missing.empty()) return series;
  std::vector<RawSeries> found = read(missing);
  for (std::size_t k = 0; k < found.size(); ++k) *places[k] = std::move(found[k]);
  return series;
}

void RowMemory::remember(const TagRequest& request, const RawSeries& rows) {
  KnownRows more = known_by(request, rows);
  // Moved only where the key is new.
  const auto [place, is_new] = known_.try_emplace({request.tag, request.mode}, std::move(more));
  if (!is_new && meet(place->second, more)) place->second = united(place->second, more);
}

std::vector<RawSeries> RowMemory::read(std::span<const TagRequest> requests, const Read& read) {
  std::vector<Pieces> pieces;
  for (const TagRequest& request : requests) pieces.push_back(pieces_of(request));
  std::vector<RawSeries> series = read_pieces(requests, pieces, read);
  std::vector<std::size_t> anew;
  std::vector<TagRequest> whole;
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (pieces[k].known == nullptr) continue;
    if (pieces[k].fit()) series[k] = pieces[k].joined(requests[k]);
    if (pieces[k].fit() && is_whole(series[k], requests[k])) continue;
    anew.push_back(k);
    whole.push_back(requests[k]);
  }
  if (!whole.empty()) {
    std::vector<RawSeries> found = read(whole);
    for (std::size_t k = 0; k < anew.size(); ++k) {
      series[anew[k]] = std::move(found[k]);
      known_.erase({whole[k].tag, whole[k].mode});
    }
  }
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (is_whole(series[k], requests[k])) remember(requests[k], series[k]);
  }
  return series;
}

void RowMemory::know(const std::string& tag, bool mode, KnownRows rows) {
  const auto place = known_.try_emplace({tag, mode}, rows).first;
  const std::int64_t to_us = std::min(place->second.to_us, rows.to_us);
  KnownRows& longer = rows.from_us < place->second.from_us ? rows : place->second;
  if (longer.from_us > to_us) {
    known_.erase(place);
    return;
  }
  longer.rows = rows_within(longer.rows, kBeforeAll_us, to_us);
  longer.to_us = to_us;
  if (&longer == &rows) place->second = std::move(rows);
}

const KnownRows* RowMemory::find(const std::string& tag, bool mode) const {
  const auto found = known_.find({tag, mode});
  return found == known_.end() ? nullptr : &found->second;
}

RawSeries rows_within(const RawSeries& rows, std::int64_t from_us, std::int64_t to_us) {
  RawSeries part;
  part.hold = rows.hold;
  append_within(rows, from_us, to_us, part);
  return part;
}

KnownRows later_part(const KnownRows& known, std::int64_t from_us, std::int64_t to_us) {
  KnownRows later{std::max(known.from_us, from_us),
                  std::min(known.to_us, to_us),
                  tells_before(known, from_us),
                  {}};
  later.rows.hold = known.rows.hold;
  std::size_t first = first_from(known.rows, later.from_us);
  if (first > 0) --first;
  append(known.rows, first, first_from(known.rows, later.to_us + 1), later.rows);
  return later;
}

}  // namespace loopscope::daemon
