#include "storage/results/plant/plant_rounds.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/rows/loop_row.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/session.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// By the database's clock alone. A lease that ends later than it was given for comes of a clock
// that was ahead, and does not hold; the minute is for one that was put back a little meanwhile.
const Statement kTakeRound{"take_round", R"(
    UPDATE loopscope.task_lease SET
      owner = $1, until = now() + $2::float8 * interval '1 second', hold_s = $2::float8
    WHERE task = 'plant_round'
      AND (owner IS NULL OR owner = $1 OR until <= now()
           OR until > now() + hold_s * interval '1 second' + interval '1 minute')
    RETURNING owner)"};

const Statement kGiveRoundBack{"give_round_back", R"(
    UPDATE loopscope.task_lease SET owner = NULL, until = NULL, hold_s = NULL
    WHERE task = 'plant_round' AND owner = $1)",
                               Rows::none};

const Statement kRoundHolder{"round_holder", R"(
    SELECT coalesce(owner, '') AS owner FROM loopscope.task_lease WHERE task = 'plant_round')",
                             Rows::one};

const Statement kTakeTurn{"take_plant_turn", R"(
    SELECT greatest(0, coalesce($1::float8 - extract(epoch FROM now()
             - max(found_at) FILTER (WHERE found_at <= now())), 0))::float8 AS wait_s,
           EXISTS (SELECT FROM loopscope.schedule WHERE enabled AND result_slot_end IS NOT NULL)
             AS analysed
    FROM loopscope.plant_round)",
                          Rows::one};
const Statement kNewestSlot{"newest_slot", R"(
    SELECT (extract(epoch FROM max(result_slot_end)) * 1000000)::bigint AS slot_end_us
    FROM loopscope.schedule WHERE enabled AND result_slot_end <= now())",
                            Rows::one};

}  // namespace

struct PlantRounds::Impl {
  Impl(const ConnectionSettings& settings, ClockCheck clock_check)
      : session(settings), check(std::move(clock_check)) {
    require_schema_version(session);
  }
  void give_back(Transaction& transaction) {
    if (!owner.empty()) transaction.run(kGiveRoundBack, {owner});
    owner.clear();
  }
  Session session;
  ClockCheck check;
  std::string owner;  ///< who has the turn by this object; empty = nobody
};

PlantRounds::PlantRounds(const ConnectionSettings& settings, ClockCheck check)
    : impl_(std::make_unique<Impl>(settings, std::move(check))) {}

PlantRounds::~PlantRounds() {
  give_turn_back();
}

void PlantRounds::give_turn_back() noexcept {
  if (impl_->owner.empty()) return;
  try {
    impl_->session.transact([this](Transaction& transaction) { impl_->give_back(transaction); });
  } catch (const std::exception&) {
    // The lease ends by itself.
  }
}

bool PlantRounds::answers() {
  try {
    impl_->session.transact(transaction_clock);
    return true;
  } catch (const DatabaseError& error) {
    if (error.remedy() != Remedy::reconnect) throw;
    return false;
  }
}

PlantTurn PlantRounds::take_turn(double every_s, const std::string& owner, double hold_s) {
  return transact_in_time(impl_->session, impl_->check, [&](Transaction& transaction) -> PlantTurn {
    // The turn comes first: whoever waited for it would see the round of the one before.
    if (transaction.run(kTakeRound, {make_storable(owner), number_text(hold_s)}).empty())
      return {std::nullopt, transaction.run(kRoundHolder)[0]["owner"].c_str()};
    impl_->owner = make_storable(owner);
    const pqxx::row row = transaction.run(kTakeTurn, {number_text(every_s)})[0];
    PlantTurn turn;
    if (row["analysed"].as<bool>()) turn.wait_s = row["wait_s"].as<double>();
    if (turn.wait_s != 0.0) impl_->give_back(transaction);
    return turn;
  });
}

std::optional<std::int64_t> PlantRounds::newest_slot_us() {
  return impl_->session.transact([](Transaction& transaction) {
    return read_integer(transaction.run(kNewestSlot)[0]["slot_end_us"]);
  });
}

std::vector<PlantCandidate> PlantRounds::candidates(std::int64_t slot_end_us, std::int64_t limit) {
  return plant_candidates(impl_->session, slot_end_us, limit);
}

void PlantRounds::store(const PlantRoundRecord& round) {
  transact_in_time(impl_->session, impl_->check, [&](Transaction& transaction) {
    write_plant_round(transaction, round);
    impl_->give_back(transaction);
  });
}

FlagAnnouncement PlantRounds::announce_flags() {
  return storage::announce_flags(impl_->session, impl_->check);
}

}  // namespace loopscope::storage
