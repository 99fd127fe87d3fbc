#include "storage/results/leases/claim_loops.hpp"

#include <algorithm>
#include <utility>

#include "storage/array_literal.hpp"
#include "storage/batch_share.hpp"
#include "storage/results/leases/claim_statement.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// A time in microseconds, exactly.
#define LOOPSCOPE_TIME(PARAMETER) \
  "(timestamptz 'epoch' + " PARAMETER "::bigint * interval '1 microsecond')"

// Behind the place that the watermark names (claim_watermark.hpp); said twice, because the planner
// expects a third of the table of a comparison of rows, and few of one of times.
#define LOOPSCOPE_CLAIM_DUE(AND_MORE) \
  LOOPSCOPE_CLAIM(                                                                              \
      "FROM loopscope.schedule AS due "                                                         \
      "WHERE due.enabled AND due.visible_at <= now()"                                           \
      "  AND due.visible_at >= " LOOPSCOPE_TIME("$4")                                            \
      "  AND (due.visible_at, due.loop_id) > (" LOOPSCOPE_TIME("$4") ", $5::bigint)"            \
      "  AND NOT (" LOOPSCOPE_SUSPECT ") " AND_MORE                                             \
      "ORDER BY due.visible_at, due.loop_id LIMIT $3::bigint")

// A subquery for each row that is looked at: joined, it would read both tables as a whole.
#define LOOPSCOPE_ELSEWHERE(SOURCES)     \
  "(SELECT away.source <> ALL (" SOURCES \
  "::text[]) FROM loopscope.loop AS away WHERE away.loop_id = due.loop_id) "

const Statement kClaimDue{"claim_due", LOOPSCOPE_CLAIM_DUE(""), Rows::any, Kept::text};

const Statement kClaimDueElsewhere{"claim_due_elsewhere",
                                   LOOPSCOPE_CLAIM_DUE("AND " LOOPSCOPE_ELSEWHERE("$6")), Rows::any,
                                   Kept::text};

// No more than what a batch's share has to be known of; sources that are away are counted too.
const Statement kCountDue{"count_due",
                          "SELECT count(*) AS due FROM (SELECT FROM loopscope.schedule AS due "
                          "WHERE due.enabled AND due.visible_at <= now()"
                          "  AND due.visible_at >= " LOOPSCOPE_TIME("$1")
                          "  AND (due.visible_at, due.loop_id) > (" LOOPSCOPE_TIME("$1") ", $2::bigint)"
                          "  AND NOT (" LOOPSCOPE_SUSPECT ") LIMIT $3::bigint) AS counted",
                          Rows::one, Kept::text};

// Seconds as the server counts them: what the way there takes says nothing of dead entries. What is
// locked is being claimed, or would not be claimed. One index serves it however many rows there
// are; a plan of an empty table ends with the next ANALYZE.
const Statement kOldestDue{
    "oldest_due",
    "SELECT oldest.due_us, oldest.loop_id,"
    "  extract(epoch FROM clock_timestamp() - statement_timestamp())::float8 AS took_s "
    "FROM (SELECT 1) AS always LEFT JOIN LATERAL ("
    "  SELECT (extract(epoch FROM due.visible_at) * 1000000)::bigint AS due_us, due.loop_id"
    "  FROM loopscope.schedule AS due "
    "  WHERE due.enabled AND due.visible_at >= " LOOPSCOPE_TIME("$1")
    "    AND due.visible_at <= least(" LOOPSCOPE_TIME("$2") ", now())"
    "    AND (due.visible_at, due.loop_id) <= (least(" LOOPSCOPE_TIME("$2") ", now()), $3::bigint)"
    "    AND NOT (" LOOPSCOPE_SUSPECT ") AND " LOOPSCOPE_ELSEWHERE("$4")
    "  ORDER BY due.visible_at, due.loop_id LIMIT 1 FOR UPDATE OF due SKIP LOCKED"
    ") AS oldest ON true",
    Rows::one, Kept::plan};

// Few loops have lost two leases, and they have an index of their own (schedule_suspect).
const Statement kClaimSuspect{
    "claim_suspect",
    LOOPSCOPE_CLAIM("FROM loopscope.schedule AS due "
                    "WHERE due.enabled AND due.lost_leases >= 2 AND due.visible_at <= now()"
                    "  AND " LOOPSCOPE_SUSPECT " ORDER BY due.visible_at LIMIT 1")};

// A suspect that was alone when its worker died is left alone for a minute, then two, up to six
// hours.
const Statement kRestSuspects{"rest_suspects", R"(
    UPDATE loopscope.schedule AS s SET
      owner = NULL, attempts = least(s.attempts + 1, 1000000),
      lost_leases = least(s.lost_leases + 1, 1000000),
      visible_at = now() + least(60 * 2 ^ least(s.lost_leases - 3, 9), 21600) * interval '1 second',
      last_error = 'the lease of ' || s.owner || ' ended without a result, alone'
    WHERE s.loop_id = ANY (ARRAY(
      SELECT due.loop_id FROM loopscope.schedule AS due
      WHERE due.enabled AND due.lost_leases >= 3 AND due.visible_at <= now()
        AND due.owner IS NOT NULL
      FOR UPDATE SKIP LOCKED)))",
                              Rows::none};

// What both statements of a claim of suspects look for, at the price of neither.
const Statement kSuspectsDue{"suspects_due",
                             "SELECT EXISTS (SELECT FROM loopscope.schedule AS due WHERE "
                             "due.enabled AND due.lost_leases >= 2 AND due.visible_at <= now())",
                             Rows::one};

const Statement kClaimNext{
    "claim_next",
    LOOPSCOPE_CLAIM("FROM loopscope.loop" LOOPSCOPE_NEWEST_SCHEDULE(
        "loop.loop_id") "WHERE due.enabled AND loop.loop_id > $4::bigint"
                        "  AND (due.owner IS NULL OR due.visible_at <= now())"
                        "  AND NOT (" LOOPSCOPE_SUSPECT ") "
                        "ORDER BY loop.loop_id LIMIT $3::bigint"),
    Rows::any, Kept::text};

/// Seconds of the server's. With nothing dead in the way all of time takes some milliseconds.
constexpr double kPatience_s = 0.03;
/// After a stand of days the loops of all of them are due: the first claim is to find the oldest.
constexpr double kFirstPatience_s = 1.0;
/// All of time takes sixteen where nothing is dead. Each is a way to the server and back.
constexpr int kMostSlices = 32;
constexpr int kMostSlicesFirst = 1000;

std::string text_of(const std::vector<std::string>& but_of) {
  ArrayLiteral sources;
  for (const std::string& source : but_of) sources.add_text(source);
  return sources.text();
}

DuePlace read_place(const pqxx::row& row) {
  return {row["due_us"].as<std::int64_t>(), row["loop_id"].as<std::int64_t>()};
}

/// What a claim has taken, and how far everything is taken now.
struct Found {
  ClaimWatermark::Start start;
  std::vector<ClaimedLoop> loops;
  DuePlace last;
};

/// How many loops the claim takes; 0 where none is due, so that a worker without work asks for no
/// more than their number.
int size_of(Transaction& transaction, const DueClaim& claim, const DuePlace& from) {
  if (claim.sharers <= 1) return claim.limit;
  const auto counted = static_cast<std::size_t>(claim.limit) * claim.sharers;
  const pqxx::row row = transaction.run(
      kCountDue,
      {std::to_string(from.due_us), std::to_string(from.loop_id), std::to_string(counted)})[0];
  const auto due = row["due"].as<std::size_t>();
  return due == 0 ? 0 : batch_share(due, claim.limit, claim.sharers);
}

Found claim_from_watermark(Transaction& transaction, std::int64_t now_us, const DueClaim& claim,
                           ClaimWatermark& watermark) {
  const ClaimWatermark::Start start = watermark.start(now_us);
  Found found{start, {}, start.place};
  const int size = size_of(transaction, claim, start.place);
  if (size == 0) {
    found.last = behind(now_us);
    return found;
  }
  std::vector<std::string> parameters{
      make_storable(claim.owner), number_text(claim.lease_s), std::to_string(size),
      std::to_string(found.start.place.due_us), std::to_string(found.start.place.loop_id)};
  if (!claim.but_of.empty()) parameters.push_back(text_of(claim.but_of));
  const pqxx::result rows =
      transaction.run(claim.but_of.empty() ? kClaimDue : kClaimDueElsewhere, parameters);
  found.loops.reserve(rows.size());
  for (const pqxx::row& row : rows) {
    found.loops.push_back(read_claim(row));
    found.last = std::max(found.last, read_place(row));
  }
  if (std::cmp_less(found.loops.size(), size)) found.last = behind(now_us);
  return found;
}

/// A look back: what it has spent, by the server's clock, and whether it found anything.
struct Look {
  double spent_s = 0.0;
  bool found = false;
};

/// Seconds that the slice took.
double look_through(Transaction& transaction, const std::string& but_of, ClaimWatermark& watermark,
                    const ClaimWatermark::Slice& slice, Look& look) {
  const pqxx::row row =
      transaction.run(kOldestDue, {std::to_string(slice.from_us), std::to_string(slice.to.due_us),
                                   std::to_string(slice.to.loop_id), but_of})[0];
  if (!row["loop_id"].is_null()) {
    watermark.lower(read_place(row));
    look.found = true;
  }
  const auto took_s = row["took_s"].as<double>();
  look.spent_s += took_s;
  return took_s;
}

}  // namespace

std::vector<ClaimedLoop> claim_due(Session& session, const ClockCheck& check, const DueClaim& claim,
                                   ClaimWatermark& watermark) {
  const auto once = [&] {
    Found found = session.transact([&](Transaction& transaction) {
      const std::int64_t now_us = checked_clock(transaction, check).now_us;
      return claim_from_watermark(transaction, now_us, claim, watermark);
    });
    watermark.passed(found.start, found.last);  // not before the claim is committed
    return std::move(found.loops);
  };
  if (!watermark.place()) look_back(session, claim.but_of, watermark);
  std::vector<ClaimedLoop> claimed = once();
  if (claimed.empty() && look_back(session, claim.but_of, watermark)) claimed = once();
  return claimed;
}

std::vector<ClaimedLoop> claim_suspect(Session& session, const ClockCheck& check,
                                       const std::string& owner, double lease_s) {
  return read_claims(transact_in_time(session, check, [&](Transaction& transaction) {
    if (!transaction.run(kSuspectsDue)[0][0].as<bool>()) return pqxx::result();
    transaction.run(kRestSuspects);
    return transaction.run(kClaimSuspect, {make_storable(owner), number_text(lease_s)});
  }));
}

std::vector<ClaimedLoop> claim_next(Session& session, const ClockCheck& check,
                                    const NextClaim& claim) {
  const std::vector<std::string> parameters{make_storable(claim.owner), number_text(claim.lease_s),
                                            std::to_string(claim.limit),
                                            std::to_string(claim.after)};
  return read_claims(transact_in_time(session, check, [&](Transaction& transaction) {
    return transaction.run(kClaimNext, parameters);
  }));
}

bool look_back(Session& session, const std::vector<std::string>& but_of,
               ClaimWatermark& watermark) {
  const bool is_first = !watermark.place();
  const double patience_s = is_first ? kFirstPatience_s : kPatience_s;
  const std::string sources = text_of(but_of);
  Look look;
  session.transact([&](Transaction& transaction) {
    static_cast<void>(watermark.start(transaction_clock(transaction).now_us));
    const ClaimWatermark::Slice nearest = watermark.nearest();
    look_through(transaction, sources, watermark, nearest, look);
    watermark.looked_nearest(nearest);
    for (int slices = is_first ? kMostSlicesFirst : kMostSlices;
         slices > 0 && look.spent_s < patience_s; --slices) {
      const ClaimWatermark::Slice slice = watermark.next();
      if (watermark.looked(slice, look_through(transaction, sources, watermark, slice, look)))
        break;
    }
  });
  return look.found;
}

}  // namespace loopscope::storage
