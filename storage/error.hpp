#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace loopscope::storage {

/// What the caller can do about a database error.
enum class Remedy {
  retry,      ///< the same statement may succeed (serialisation, deadlock, lock timeout)
  reconnect,  ///< the connection is dead: throw the object away and make a new one
  give_up,    ///< needs a person (missing table, no privilege, wrong password, disk full)
};

/// A database error in words for an operator: what() is "what, where"; hint() how to mend it.
class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(const std::string& what_where, std::string hint, Remedy remedy,
                std::string sqlstate = {})
      : std::runtime_error(what_where),
        hint_(std::move(hint)),
        remedy_(remedy),
        sqlstate_(std::move(sqlstate)) {}

  [[nodiscard]] const std::string& hint() const { return hint_; }
  [[nodiscard]] Remedy remedy() const { return remedy_; }
  [[nodiscard]] const std::string& sqlstate() const { return sqlstate_; }  ///< empty = none

 private:
  std::string hint_;
  Remedy remedy_;
  std::string sqlstate_;
};

}  // namespace loopscope::storage
