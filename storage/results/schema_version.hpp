#pragma once

#include "storage/results/session.hpp"

namespace loopscope::storage {

/// The version of the schema `loopscope`; 0 = there is none.
[[nodiscard]] int schema_version(Transaction& transaction);

/// What to do with a schema that a newer program has migrated.
enum class Newer {
  if_compatible,  ///< take it if it still serves this program: loopscope.oldest_program()
  refused,
};

/// Throws DatabaseError (give_up) unless the schema is the one that this program was built for, or
/// a newer one that was only added to since.
void require_schema_version(Session& session, Newer newer = Newer::if_compatible);

}  // namespace loopscope::storage
