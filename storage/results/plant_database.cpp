#include "storage/results/plant_database.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/loop_row.hpp"
#include "storage/results/plant_statements.hpp"
#include "storage/results/schema_version.hpp"
#include "storage/results/session.hpp"

namespace loopscope::storage {
namespace {

OscillatingLoop read_oscillating(const pqxx::row& row) {
  return {read_loop(row),
          row["slot_end_us"].as<std::int64_t>(),
          row["window_start_us"].as<std::int64_t>(),
          row["window_end_us"].as<std::int64_t>(),
          row["code"].c_str(),
          row["confidence"].as<double>(),
          row["oscillation_period_s"].as<double>(),
          read_number(row["nonlinear_p"])};
}

}  // namespace

struct PlantDatabase::Impl {
  explicit Impl(const ConnectionSettings& settings) : session(settings) {
    require_schema_version(session);
  }
  Session session;
};

PlantDatabase::PlantDatabase(const ConnectionSettings& settings)
    : impl_(std::make_unique<Impl>(settings)) {}
PlantDatabase::~PlantDatabase() = default;

bool PlantDatabase::claim_round(double every_s) {
  return impl_->session.transact([&](Transaction& transaction) {
    return transaction.run(statements::kClaimRound, {number_text(every_s)})[0][0].as<bool>();
  });
}

std::vector<OscillatingLoop> PlantDatabase::oscillating_loops() {
  return impl_->session.transact([](Transaction& transaction) {
    std::vector<OscillatingLoop> loops;
    for (const pqxx::row& row : transaction.run(statements::kOscillatingLoops)) {
      loops.push_back(read_oscillating(row));
    }
    return loops;
  });
}

void PlantDatabase::write_round(const PlantRoundRecord& round) {
  impl_->session.transact([&](Transaction& transaction) { write_plant_round(transaction, round); });
}

FlagAnnouncement PlantDatabase::announce_flags() {
  return impl_->session.transact(
      [](Transaction& transaction) { return storage::announce_flags(transaction); });
}

}  // namespace loopscope::storage
