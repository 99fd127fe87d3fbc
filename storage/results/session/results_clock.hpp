#pragma once

#include "storage/results/session/session.hpp"
#include "storage/server_clock.hpp"

namespace loopscope::storage {

/// The server's clock at the beginning of the transaction: what now() gives in it.
[[nodiscard]] ServerClock transaction_clock(Transaction& transaction);

/// The same, once `check` has let it pass; an empty one lets everything pass. Throws what it
/// throws.
ServerClock checked_clock(Transaction& transaction, const ClockCheck& check);

/// As Session::transact(), once `check` has let the transaction's now() pass.
template <typename Work>
auto transact_in_time(Session& session, const ClockCheck& check, Work&& work) {
  return session.transact([&](Transaction& transaction) {
    if (check) checked_clock(transaction, check);
    return work(transaction);
  });
}

/// ResultsDatabase::accepted_clocks(). One transaction; throws DatabaseError.
[[nodiscard]] AcceptedClocks accepted_clocks(Session& session);

}  // namespace loopscope::storage
