#pragma once

#include <span>

namespace loopscope::storage {

/// One file of storage/migrations/, compiled in.
struct Migration {
  int number;          ///< 101, 102, 103, ... without gaps
  const char* name;    ///< file name without its ending
  const char* sha256;  ///< of its text, 64 hexadecimal digits
  const char* sql;
};

/// Every migration in the order of its number; written by embed_migrations.cmake.
[[nodiscard]] std::span<const Migration> embedded_migrations();

}  // namespace loopscope::storage
