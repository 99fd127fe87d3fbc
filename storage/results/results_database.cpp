#include "storage/results/results_database.hpp"

#include <algorithm>

#include "storage/array_literal.hpp"
#include "storage/results/leases/claim_loops.hpp"
#include "storage/results/leases/claim_past.hpp"
#include "storage/results/leases/finish_loops.hpp"
#include "storage/results/leases/held_loops.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/session.hpp"
#include "storage/timestamp.hpp"
#include "storage/utf8.hpp"

namespace loopscope::storage {
namespace {

// The bounds that all share are constants, so that other months are not even planned.
const Statement kStoredDigests{"stored_digests", R"(
    SELECT wanted.loop_id, (extract(epoch FROM wanted.slot_end) * 1000000)::bigint AS slot_end_us,
           analysis.input_digest, analysis.usable, analysis.same_settings,
           analysis.modelled
    FROM unnest($1::bigint[], $2::timestamptz[]) AS wanted (loop_id, slot_end)
    CROSS JOIN LATERAL (
      SELECT stored.input_digest, stored.settings = $4::jsonb AS same_settings,
             stored.model IS NOT NULL AS modelled,
             stored.usable OR 'pv_frozen' = ANY (stored.flags) AS usable
      FROM loopscope.analysis AS stored
      WHERE stored.loop_id = wanted.loop_id AND stored.slot_end = wanted.slot_end
        AND stored.algorithm_revision = $3::integer
        AND stored.slot_end BETWEEN $5::timestamptz AND $6::timestamptz
      LIMIT 1) AS analysis)",
                               Rows::any, Kept::text};

// A value that stands already is not written again: every new connection sets some, and would wait
// for whoever holds their rows.
const Statement kSetParameter{"set_parameter", R"(
    WITH changed AS (
      UPDATE loopscope.parameter SET value = $2::float8 WHERE name = $1 AND value <> $2::float8)
    SELECT name FROM loopscope.parameter WHERE name = $1)"};

const Statement kAddStageCost{"add_stage_cost", R"(
    INSERT INTO loopscope.stage_cost AS kept
      (hour, host, lane, loops, analysed, modelled, sample_values, claim_s, fetch_s, prepare_s,
       statistics_s, model_s, decide_s, write_s, wait_s)
    VALUES (date_trunc('hour', now()), $1, $2::integer, $3::bigint, $4::bigint, $5::bigint,
            $6::bigint, $7::float8, $8::float8, $9::float8, $10::float8, $11::float8, $12::float8,
            $13::float8, $14::float8)
    ON CONFLICT (hour, host, lane) DO UPDATE SET
      loops = kept.loops + EXCLUDED.loops, analysed = kept.analysed + EXCLUDED.analysed,
      modelled = kept.modelled + EXCLUDED.modelled,
      sample_values = kept.sample_values + EXCLUDED.sample_values,
      claim_s = kept.claim_s + EXCLUDED.claim_s, fetch_s = kept.fetch_s + EXCLUDED.fetch_s,
      prepare_s = kept.prepare_s + EXCLUDED.prepare_s,
      statistics_s = kept.statistics_s + EXCLUDED.statistics_s,
      model_s = kept.model_s + EXCLUDED.model_s, decide_s = kept.decide_s + EXCLUDED.decide_s,
      write_s = kept.write_s + EXCLUDED.write_s, wait_s = kept.wait_s + EXCLUDED.wait_s)",
                              Rows::none};

// Of enabled loops, held ones included: then their lease ends.
const Statement kNextDue{
    "next_due",
    "SELECT extract(epoch FROM visible_at - now())::float8 AS due_in_s FROM loopscope.schedule "
    "WHERE enabled AND visible_at >= (timestamptz 'epoch' + $1::bigint * interval '1 microsecond')"
    "  AND (visible_at, loop_id) > ((timestamptz 'epoch' + $1::bigint * interval '1 microsecond'), "
    "$2::bigint)"
    "  AND visible_at <= now() + $3::float8 * interval '1 second' "
    "ORDER BY visible_at, loop_id LIMIT 1",
    Rows::any, Kept::text};

const Statement kSeeWorker{"see_worker", R"(
    INSERT INTO loopscope.worker AS kept (worker, program_version, algorithm_revision, held_loops,
                                          lost_leases)
    VALUES ($1, $2, $3::integer, $4::integer, $5::bigint)
    ON CONFLICT (worker) DO UPDATE SET
      program_version = EXCLUDED.program_version,
      algorithm_revision = EXCLUDED.algorithm_revision, last_seen = now(), left_at = NULL,
      held_loops = EXCLUDED.held_loops, lost_leases = EXCLUDED.lost_leases)",
                           Rows::none};

const Statement kLeaveWorker{"leave_worker", R"(
    UPDATE loopscope.worker SET left_at = now(), held_loops = 0 WHERE worker = $1)",
                             Rows::none};

const Statement kCountEnabled{"count_enabled_loops",
                              "SELECT count(*) FROM loopscope.loop WHERE enabled", Rows::one};

const Statement kEnabledOf{
    "enabled_of",
    "SELECT loop_id FROM loopscope.loop WHERE loop_id = ANY ($1::bigint[]) AND enabled"};

}  // namespace

struct ResultsDatabase::Impl {
  Impl(const ConnectionSettings& settings, ClockCheck clock_check,
       std::shared_ptr<ClaimWatermarks> shared_watermarks)
      : session(settings), check(std::move(clock_check)), watermarks(std::move(shared_watermarks)) {
    require_schema_version(session);
  }
  template <typename Work>
  auto transact_in_time(Work&& work) {
    return storage::transact_in_time(session, check, std::forward<Work>(work));
  }
  Session session;
  ClockCheck check;
  std::shared_ptr<ClaimWatermarks> watermarks;
};

ResultsDatabase::ResultsDatabase(const ConnectionSettings& settings, ClockCheck check,
                                 std::shared_ptr<ClaimWatermarks> watermarks)
    : impl_(std::make_unique<Impl>(settings, std::move(check), std::move(watermarks))) {}
ResultsDatabase::~ResultsDatabase() = default;
ResultsDatabase::ResultsDatabase(ResultsDatabase&&) noexcept = default;
ResultsDatabase& ResultsDatabase::operator=(ResultsDatabase&&) noexcept = default;

std::vector<ClaimedLoop> ResultsDatabase::claim_due(const std::string& owner, double lease_s,
                                                    int limit,
                                                    const std::vector<std::string>& but_of,
                                                    std::size_t sharers) {
  return storage::claim_due(impl_->session, impl_->check, {owner, lease_s, limit, but_of, sharers},
                            impl_->watermarks->of(but_of));
}

void ResultsDatabase::look_back(const std::vector<std::string>& but_of) {
  storage::look_back(impl_->session, but_of, impl_->watermarks->of(but_of));
}

std::vector<ClaimedLoop> ResultsDatabase::claim_suspect(const std::string& owner, double lease_s) {
  return storage::claim_suspect(impl_->session, impl_->check, owner, lease_s);
}

std::vector<ClaimedLoop> ResultsDatabase::claim_next(const std::string& owner, double lease_s,
                                                     int limit, std::int64_t after) {
  return storage::claim_next(impl_->session, impl_->check, {owner, lease_s, limit, after});
}

std::vector<ClaimedLoop> ResultsDatabase::claim_past(
    const std::string& owner, double lease_s, double reserve_s,
    std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot) {
  return storage::claim_past(
      impl_->session, impl_->check,
      {owner, lease_s, reserve_s, {loop_and_slot.begin(), loop_and_slot.end()}});
}

std::vector<StoredDigest> ResultsDatabase::stored_digests(
    std::span<const std::pair<std::int64_t, std::int64_t>> loop_and_slot, int algorithm_revision,
    const std::string& settings_json) {
  if (loop_and_slot.empty()) return {};
  ArrayLiteral loop_id, slot_end;
  std::int64_t first_us = loop_and_slot.front().second, last_us = first_us;
  for (const auto& [loop, slot] : loop_and_slot) {
    loop_id.add_integer(loop);
    slot_end.add_time(slot);
    first_us = std::min(first_us, slot);
    last_us = std::max(last_us, slot);
  }
  const pqxx::result rows = impl_->session.transact([&](Transaction& transaction) {
    return transaction.run(kStoredDigests,
                           {loop_id.text(), slot_end.text(), std::to_string(algorithm_revision),
                            settings_json, timestamp_text(first_us), timestamp_text(last_us)});
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
  impl_->transact_in_time(
      [&](Transaction& transaction) { storage::release(transaction, claimed); });
}

void ResultsDatabase::release_owned(const std::string& owner) {
  impl_->transact_in_time(
      [&](Transaction& transaction) { storage::release_owned(transaction, owner); });
}

std::size_t ResultsDatabase::recall_stray(double settle_s) {
  return impl_->transact_in_time(
      [&](Transaction& transaction) { return storage::recall_stray(transaction, settle_s); });
}

std::vector<ClaimKey> ResultsDatabase::extend(std::span<const ClaimedLoop> claimed,
                                              double lease_s) {
  return impl_->transact_in_time(
      [&](Transaction& transaction) { return storage::extend(transaction, claimed, lease_s); });
}

void ResultsDatabase::see_worker(const WorkerSign& sign) {
  impl_->transact_in_time([&](Transaction& transaction) {
    transaction.run(
        kSeeWorker,
        {make_storable(sign.worker), sign.program_version, std::to_string(sign.algorithm_revision),
         std::to_string(sign.held_loops), std::to_string(sign.lost_leases)});
  });
}

void ResultsDatabase::leave_worker(const std::string& worker) {
  impl_->transact_in_time(
      [&](Transaction& transaction) { transaction.run(kLeaveWorker, {make_storable(worker)}); });
}

std::optional<double> ResultsDatabase::next_due_in_s(double within_s) {
  const DuePlace watermark = impl_->watermarks->of({}).place().value_or(kBeforeAll);
  return impl_->session.transact([&](Transaction& transaction) -> std::optional<double> {
    const pqxx::result rows =
        transaction.run(kNextDue, {std::to_string(watermark.due_us),
                                   std::to_string(watermark.loop_id), number_text(within_s)});
    if (rows.empty()) return std::nullopt;
    return rows[0]["due_in_s"].as<double>();
  });
}

std::size_t ResultsDatabase::count_enabled_loops() {
  return impl_->session.transact([](Transaction& transaction) {
    return transaction.run(kCountEnabled)[0][0].as<std::size_t>();
  });
}

std::set<std::int64_t> ResultsDatabase::enabled_of(std::span<const std::int64_t> loop_ids) {
  ArrayLiteral wanted;
  for (const std::int64_t loop_id : loop_ids) wanted.add_integer(loop_id);
  return impl_->session.transact([&](Transaction& transaction) {
    std::set<std::int64_t> enabled;
    for (const pqxx::row& row : transaction.run(kEnabledOf, {wanted.text()}))
      enabled.insert(row[0].as<std::int64_t>());
    return enabled;
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
                                  impl_->watermarks->of({}).place().value_or(kBeforeAll));
}

PlantFigures ResultsDatabase::plant_figures() {
  return storage::plant_figures(impl_->session);
}

void ResultsDatabase::set_parameter(const std::string& name, double value) {
  impl_->session.transact([&](Transaction& transaction) {
    if (transaction.run(kSetParameter, {name, number_text(value)}).empty()) {
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
      [&](Transaction& transaction) { transaction.run(kAddStageCost, parameters); });
}

}  // namespace loopscope::storage
