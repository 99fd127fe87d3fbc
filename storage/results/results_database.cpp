#include "storage/results/results_database.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/leases/claim_due.hpp"
#include "storage/results/leases/finish_loops.hpp"
#include "storage/results/leases/recall_stray.hpp"
#include "storage/results/rows/schedule_statements.hpp"
#include "storage/results/rows/statements.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/session.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

std::vector<ClaimedLoop> read_claims(const pqxx::result& rows) {
  std::vector<ClaimedLoop> claimed;
  claimed.reserve(rows.size());
  for (const pqxx::row& row : rows) claimed.push_back(read_claim(row));
  return claimed;
}

/// The two arrays that name claims.
std::vector<std::string> claim_keys(std::span<const ClaimedLoop> claimed) {
  ArrayLiteral loop_id, fence;
  for (const ClaimedLoop& claim : claimed) {
    loop_id.add_integer(claim.loop.loop_id);
    fence.add_integer(claim.fence);
  }
  return {loop_id.text(), fence.text()};
}

}  // namespace

struct ResultsDatabase::Impl {
  Impl(const ConnectionSettings& settings, ClockCheck clock_check,
       std::shared_ptr<ClaimFloors> shared_floors)
      : session(settings), check(std::move(clock_check)), floors(std::move(shared_floors)) {
    require_schema_version(session);
  }
  template <typename Work>
  auto transact_in_time(Work&& work) {
    return storage::transact_in_time(session, check, std::forward<Work>(work));
  }
  std::vector<ClaimedLoop> claim(const Statement& statement,
                                 const std::vector<std::string>& parameters) {
    return read_claims(transact_in_time(
        [&](Transaction& transaction) { return transaction.run(statement, parameters); }));
  }
  Session session;
  ClockCheck check;
  std::shared_ptr<ClaimFloors> floors;
};

ResultsDatabase::ResultsDatabase(const ConnectionSettings& settings, ClockCheck check,
                                 std::shared_ptr<ClaimFloors> floors)
    : impl_(std::make_unique<Impl>(settings, std::move(check), std::move(floors))) {}
ResultsDatabase::~ResultsDatabase() = default;
ResultsDatabase::ResultsDatabase(ResultsDatabase&&) noexcept = default;
ResultsDatabase& ResultsDatabase::operator=(ResultsDatabase&&) noexcept = default;

std::vector<ClaimedLoop> ResultsDatabase::claim_due(const std::string& owner, double lease_s,
                                                    int limit,
                                                    const std::vector<std::string>& but_of) {
  return storage::claim_due(impl_->session, impl_->check, {owner, lease_s, limit, but_of},
                            impl_->floors->of(but_of));
}

void ResultsDatabase::look_back(const std::vector<std::string>& but_of) {
  storage::look_back(impl_->session, but_of, impl_->floors->of(but_of));
}

std::vector<ClaimedLoop> ResultsDatabase::claim_suspect(const std::string& owner, double lease_s) {
  const std::vector<std::string> parameters{make_storable(owner), number_text(lease_s)};
  return read_claims(impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(statements::kRestSuspects);
    return transaction.run(statements::kClaimSuspect, parameters);
  }));
}

std::vector<ClaimedLoop> ResultsDatabase::claim_next(const std::string& owner, double lease_s,
                                                     int limit, std::int64_t after) {
  return impl_->claim(statements::kClaimNext, {make_storable(owner), number_text(lease_s),
                                               std::to_string(limit), std::to_string(after)});
}

std::vector<StoredDigest> ResultsDatabase::stored_digests(
    std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot, int algorithm_revision,
    const std::string& settings_json) {
  ArrayLiteral loop_id, slot_end;
  for (const auto& [loop, slot] : loop_and_slot) {
    loop_id.add_integer(loop);
    slot_end.add_time(slot);
  }
  const pqxx::result rows = impl_->session.transact([&](Transaction& transaction) {
    return transaction.run(
        statements::kStoredDigests,
        {loop_id.text(), slot_end.text(), std::to_string(algorithm_revision), settings_json});
  });
  std::vector<StoredDigest> digests;
  for (const pqxx::row& row : rows) {
    digests.push_back({row["loop_id"].as<std::int64_t>(), row["slot_end_us"].as<std::int64_t>(),
                       row["input_digest"].c_str(), row["usable"].as<bool>(),
                       row["same_settings"].as<bool>(), row["modelled"].as<bool>()});
  }
  return digests;
}

WriteCount ResultsDatabase::finish(std::span<const CompletedLoop> completed,
                                   std::span<const FailedLoop> failed) {
  return impl_->transact_in_time(
      [&](Transaction& transaction) { return finish_loops(transaction, completed, failed); });
}

void ResultsDatabase::release(std::span<const ClaimedLoop> claimed) {
  impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(statements::kRelease, claim_keys(claimed));
  });
}

void ResultsDatabase::release_owned(const std::string& owner) {
  impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(statements::kReleaseOwned, {make_storable(owner)});
  });
}

std::size_t ResultsDatabase::recall_stray(double settle_s) {
  return impl_->transact_in_time(
      [&](Transaction& transaction) { return storage::recall_stray(transaction, settle_s); });
}

std::vector<ClaimKey> ResultsDatabase::extend(std::span<const ClaimedLoop> claimed,
                                              double lease_s) {
  const std::vector<std::string> keys = claim_keys(claimed);
  const pqxx::result rows = impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(statements::kExtend, {keys[0], keys[1], number_text(lease_s)});
    return transaction.run(statements::kLostClaims, keys);
  });
  std::vector<ClaimKey> lost;
  for (const pqxx::row& row : rows)
    lost.push_back({row["loop_id"].as<std::int64_t>(), row["fence"].as<std::int64_t>()});
  return lost;
}

void ResultsDatabase::see_worker(const WorkerSign& sign) {
  impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(
        statements::kSeeWorker,
        {make_storable(sign.worker), sign.program_version, std::to_string(sign.algorithm_revision),
         std::to_string(sign.held_loops), std::to_string(sign.lost_leases)});
  });
}

std::optional<double> ResultsDatabase::next_due_in_s(double within_s) {
  const DuePlace floor = impl_->floors->of({}).place().value_or(kBeforeAll);
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<double> {
    const pqxx::result rows = transaction.run(
        statements::kNextDue,
        {std::to_string(floor.due_us), std::to_string(floor.loop_id), number_text(within_s)});
    if (rows.empty()) return std::nullopt;
    return rows[0]["due_in_s"].as<double>();
  });
}

std::size_t ResultsDatabase::count_enabled_loops() {
  return impl_->session.transact([](Transaction& transaction) {
    return transaction.run(statements::kCountEnabled)[0][0].as<std::size_t>();
  });
}

ServerClock ResultsDatabase::clock() {
  return impl_->session.transact(transaction_clock);
}

AcceptedClocks ResultsDatabase::accepted_clocks() {
  return storage::accepted_clocks(impl_->session);
}

ScheduleHealth ResultsDatabase::schedule_health() {
  return storage::schedule_health(impl_->session,
                                  impl_->floors->of({}).place().value_or(kBeforeAll));
}

void ResultsDatabase::set_parameter(const std::string& name, double value) {
  impl_->session.transact([&](Transaction& transaction) {
    if (transaction.run(statements::kSetParameter, {name, number_text(value)}).empty()) {
      throw DatabaseError("no such parameter, loopscope.parameter " + name,
                          "SELECT name, description FROM loopscope.parameter lists them",
                          Remedy::give_up);
    }
  });
}

void ResultsDatabase::add_stage_cost(const CostBearer& bearer, const StageCost& cost) {
  std::vector<std::string> parameters{make_storable(bearer.host), std::to_string(bearer.lane)};
  for (const std::size_t count : {cost.loops, cost.analysed, cost.modelled, cost.values}) {
    parameters.push_back(std::to_string(count));
  }
  for (const double seconds : {cost.claim_s, cost.fetch_s, cost.prepare_s, cost.statistics_s,
                               cost.model_s, cost.decide_s, cost.write_s, cost.wait_s}) {
    parameters.push_back(number_text(seconds));
  }
  impl_->transact_in_time(
      [&](Transaction& transaction) { transaction.run(statements::kAddStageCost, parameters); });
}

}  // namespace loopscope::storage
