#include "storage/results/schema/accept_clocks.hpp"

#include "storage/array_literal.hpp"
#include "storage/results/schema/schema_version.hpp"
#include "storage/results/session/results_clock.hpp"
#include "storage/results/session/schema_statements.hpp"
#include "storage/results/session/session.hpp"

namespace loopscope::storage {
namespace {

const Statement kForgetAccepted{"forget_accepted_clocks", "DELETE FROM loopscope.accepted_clock",
                                Rows::none};

const Statement kAcceptClocks{"accept_clocks", R"(
    INSERT INTO loopscope.accepted_clock (clock, ahead_s)
    SELECT * FROM unnest($1::text[], $2::float8[]))",
                              Rows::none};

}  // namespace

ResultsTime results_time(const ConnectionSettings& owner) {
  Session session(owner);
  require_schema_version(session);
  return {session.transact(transaction_clock), accepted_clocks(session)};
}

void accept_clocks(const ConnectionSettings& owner, const AcceptedClocks& clocks) {
  ArrayLiteral names, ahead_s;
  for (const auto& [clock, seconds] : clocks) {
    names.add_text(clock);
    ahead_s.add_number(seconds);
  }
  Session session(owner);
  session.transact([&](Transaction& transaction) {
    transaction.run(statements::kBecomeOwner);
    transaction.run(kForgetAccepted);
    transaction.run(kAcceptClocks, {names.text(), ahead_s.text()});
  });
}

}  // namespace loopscope::storage
