#pragma once

#include <string>

#include "storage/results/session/session.hpp"

namespace loopscope::storage {

/// Who a session is and whose the schema `loopscope` is, by PostgreSQL's catalogue alone: nothing
/// of the schema is executed to find it out.
struct SchemaOwner {
  std::string login;  ///< who connected
  /// What that login, or the role that the session has now, is or can become by SET ROLE; empty =
  /// no superuser.
  std::string superuser;
  std::string owner;  ///< of the schema; empty = there is none yet
  /// loopscope_owner, a member of it, the session's own role, the owner of the database or a
  /// superuser; true where there is no schema.
  bool owner_trusted = false;
};

[[nodiscard]] SchemaOwner find_schema_owner(Transaction& transaction);

/// Before a session executes anything of the schema. Whoever may create schemas in a database that
/// is shared can have made one of this name, with functions and views of his own, which would run
/// with the session's rights: a schema whose owner is not to be trusted is refused. So is a session
/// of a superuser, or of a member of one: whoever may make functions in the schema could make
/// himself one. Throws DatabaseError (give_up).
void enter_schema(Transaction& transaction);

}  // namespace loopscope::storage
