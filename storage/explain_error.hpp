#pragma once

#include <string>

#include "storage/error.hpp"

namespace loopscope::storage {

/// Which database a connection is for: it decides what a hint tells the operator to do.
enum class DatabaseKind { results, historian };

/// SQLSTATE of a commit that was sent and not answered: whether it counts is not known.
inline constexpr const char* kOutcomeUnknown = "08007";

/// Where an error happened.
struct ErrorPlace {
  DatabaseKind kind = DatabaseKind::results;
  std::string target;     ///< "results database (host=... dbname=... user=...)"
  std::string user;       ///< database user; empty = unknown
  std::string statement;  ///< name of the statement; empty = connecting
};

/// An error as libpq or libpqxx reports it.
struct RawError {
  std::string message;   ///< "ERROR:  what\nDETAIL:  ..." or libpq's own words
  std::string sqlstate;  ///< empty = the server gave none
  bool connection_lost = false;
};

/// The error in words for an operator, with what to do about it.
[[nodiscard]] DatabaseError explain(const RawError& error, const ErrorPlace& place);

}  // namespace loopscope::storage
