#include "storage/results/schema/brief_locks.hpp"

namespace loopscope::storage {
namespace {

// A moment that nobody at a page minds, and many times what taking a free lock needs.
const Statement kBriefLocks{"brief_locks", "SET LOCAL lock_timeout = '200ms'", Rows::none};

}  // namespace

bool lock_was_taken(const DatabaseError& error) {
  return error.sqlstate() == "55P03" || error.sqlstate() == "40P01";
}

void wait_briefly_for_locks(Transaction& transaction) {
  transaction.run(kBriefLocks);
}

}  // namespace loopscope::storage
