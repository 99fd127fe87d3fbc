#pragma once

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// The version of the schema `loopscope`; 0 = there is none.
[[nodiscard]] int schema_version(Transaction& transaction);

/// Throws DatabaseError (give_up) unless the schema is the one that this program was built for, or
/// a newer one that was only added to since: loopscope.oldest_program(). One or two transactions.
void require_schema_version(Session& session);

}  // namespace loopscope::storage
