#include "storage/results/session/results_clock.hpp"

namespace loopscope::storage {
namespace {

const Statement kTransactionClock{"transaction_clock", R"(
    SELECT (extract(epoch FROM now()) * 1000000)::bigint AS now_us,
           (extract(epoch FROM pg_postmaster_start_time()) * 1000000)::bigint AS started_us)",
                                  Rows::one, Kept::text};

const Statement kAcceptedClocks{"accepted_clocks",
                                "SELECT clock, ahead_s FROM loopscope.accepted_clock"};

}  // namespace

ServerClock transaction_clock(Transaction& transaction) {
  const pqxx::result rows = transaction.run(kTransactionClock);
  return {rows[0]["now_us"].as<std::int64_t>(), rows[0]["started_us"].as<std::int64_t>()};
}

ServerClock checked_clock(Transaction& transaction, const ClockCheck& check) {
  const ServerClock clock = transaction_clock(transaction);
  if (check) check(clock);
  return clock;
}

AcceptedClocks accepted_clocks(Session& session) {
  AcceptedClocks accepted;
  for (const pqxx::row& row : session.transact(
           [](Transaction& transaction) { return transaction.run(kAcceptedClocks); })) {
    accepted[row["clock"].c_str()] = row["ahead_s"].as<double>();
  }
  return accepted;
}

}  // namespace loopscope::storage
