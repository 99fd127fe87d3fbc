#pragma once

#include <span>

namespace loopscope::storage {

/// One of the migrations, numbered from 1 without gaps, that made the schema up to version 27. They
/// became the five of today by subject; their files are data of the tests
/// (tests/storage/results/former_schema).
struct SupersededMigration {
  const char* name;
  const char* sha256;
};

/// All of them, in the order of their numbers.
[[nodiscard]] std::span<const SupersededMigration> superseded_migrations();

}  // namespace loopscope::storage
