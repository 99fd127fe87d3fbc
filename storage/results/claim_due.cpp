#include "storage/results/claim_due.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "storage/array_literal.hpp"
#include "storage/results/loop_row.hpp"
#include "storage/results/results_clock.hpp"
#include "storage/results/schedule_statements.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

using Clock = std::chrono::steady_clock;

/// With nothing dead in the way all of time takes milliseconds.
constexpr std::chrono::milliseconds kPatience{30};
/// After a stand of days the loops of all of them are due: the first claim is to find the oldest.
constexpr std::chrono::milliseconds kFirstPatience{1000};

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

/// Seconds that the slice took.
double look_through(Transaction& transaction, const std::string& but_of, ClaimFloor& floor,
                    const ClaimFloor::Slice& slice, bool& found) {
  const Clock::time_point began = Clock::now();
  const pqxx::result rows = transaction.run(
      statements::kOldestDue, {std::to_string(slice.from_us), std::to_string(slice.to.due_us),
                               std::to_string(slice.to.loop_id), but_of});
  if (!rows.empty()) {
    floor.lower(read_place(rows[0]));
    found = true;
  }
  return std::chrono::duration<double>(Clock::now() - began).count();
}

}  // namespace

ClaimedLoop read_claim(const pqxx::row& row) {
  return {read_loop(row),
          row["fence"].as<std::int64_t>(),
          row["attempts"].as<int>(),
          row["now_us"].as<std::int64_t>(),
          read_integer(row["last_slot_end_us"]),
          read_last_verdict(row)};
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
  const Clock::time_point began = Clock::now();
  const auto patience = floor.place() ? kPatience : kFirstPatience;
  const std::string sources = text_of(but_of);
  bool found = false;
  session.transact([&](Transaction& transaction) {
    static_cast<void>(floor.start(transaction_clock(transaction).now_us));
    look_through(transaction, sources, floor, floor.nearest(), found);
    for (bool at_end = false; !at_end && Clock::now() - began < patience;) {
      const ClaimFloor::Slice slice = floor.next();
      at_end = floor.looked(slice, look_through(transaction, sources, floor, slice, found));
    }
  });
  return found;
}

}  // namespace loopscope::storage
