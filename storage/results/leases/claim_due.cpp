#include "storage/results/leases/claim_due.hpp"

#include <algorithm>
#include <utility>

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/rows/schedule_statements.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

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

std::optional<LastVerdict> read_last_verdict(const pqxx::row& row) {
  const auto code = core::diagnosis::verdict_code(read_text(row["last_code"]));
  if (!code) return std::nullopt;
  return LastVerdict{*code, row["last_confidence"].as<double>(), read_number(row["last_p"])};
}

DuePlace read_place(const pqxx::row& row) {
  return {row["due_us"].as<std::int64_t>(), row["loop_id"].as<std::int64_t>()};
}

/// What a claim has taken, and how far everything is taken now.
struct Found {
  ClaimFloor::Start start;
  std::vector<ClaimedLoop> loops;
  DuePlace last;
};

Found claim_from_floor(Transaction& transaction, std::int64_t now_us, const DueClaim& claim,
                       ClaimFloor& floor) {
  const ClaimFloor::Start start = floor.start(now_us);
  Found found{start, {}, start.place};
  std::vector<std::string> parameters{
      make_storable(claim.owner), number_text(claim.lease_s), std::to_string(claim.limit),
      std::to_string(found.start.place.due_us), std::to_string(found.start.place.loop_id)};
  if (!claim.but_of.empty()) parameters.push_back(text_of(claim.but_of));
  const pqxx::result rows = transaction.run(
      claim.but_of.empty() ? statements::kClaimDue : statements::kClaimDueElsewhere, parameters);
  found.loops.reserve(rows.size());
  for (const pqxx::row& row : rows) {
    found.loops.push_back(read_claim(row));
    found.last = std::max(found.last, read_place(row));
  }
  if (std::cmp_less(found.loops.size(), claim.limit)) found.last = behind(now_us);
  return found;
}

/// A look back: what it has spent, by the server's clock, and whether it found anything.
struct Look {
  double spent_s = 0.0;
  bool found = false;
};

/// Seconds that the slice took.
double look_through(Transaction& transaction, const std::string& but_of, ClaimFloor& floor,
                    const ClaimFloor::Slice& slice, Look& look) {
  const pqxx::row row = transaction.run(
      statements::kOldestDue, {std::to_string(slice.from_us), std::to_string(slice.to.due_us),
                               std::to_string(slice.to.loop_id), but_of})[0];
  if (!row["loop_id"].is_null()) {
    floor.lower(read_place(row));
    look.found = true;
  }
  const double took_s = row["took_s"].as<double>();
  look.spent_s += took_s;
  return took_s;
}

}  // namespace

ClaimedLoop read_claim(const pqxx::row& row) {
  return {read_loop(row),
          row["fence"].as<std::int64_t>(),
          row["attempts"].as<int>(),
          row["now_us"].as<std::int64_t>(),
          read_integer(row["last_slot_end_us"]),
          read_last_verdict(row),
          read_pv_past(row)};
}

std::vector<ClaimedLoop> claim_due(Session& session, const ClockCheck& check, const DueClaim& claim,
                                   ClaimFloor& floor) {
  const auto once = [&] {
    Found found = session.transact([&](Transaction& transaction) {
      const std::int64_t now_us = checked_clock(transaction, check).now_us;
      return claim_from_floor(transaction, now_us, claim, floor);
    });
    floor.passed(found.start, found.last);  // not before the claim is committed
    return std::move(found.loops);
  };
  if (!floor.place()) look_back(session, claim.but_of, floor);
  std::vector<ClaimedLoop> claimed = once();
  if (claimed.empty() && look_back(session, claim.but_of, floor)) claimed = once();
  return claimed;
}

bool look_back(Session& session, const std::vector<std::string>& but_of, ClaimFloor& floor) {
  const bool is_first = !floor.place();
  const double patience_s = is_first ? kFirstPatience_s : kPatience_s;
  const std::string sources = text_of(but_of);
  Look look;
  session.transact([&](Transaction& transaction) {
    static_cast<void>(floor.start(transaction_clock(transaction).now_us));
    const ClaimFloor::Slice nearest = floor.nearest();
    look_through(transaction, sources, floor, nearest, look);
    floor.looked_nearest(nearest);
    for (int slices = is_first ? kMostSlicesFirst : kMostSlices;
         slices > 0 && look.spent_s < patience_s; --slices) {
      const ClaimFloor::Slice slice = floor.next();
      if (floor.looked(slice, look_through(transaction, sources, floor, slice, look))) break;
    }
  });
  return look.found;
}

}  // namespace loopscope::storage
