#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/run_program.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::tests {

/// What a test says when it is skipped for want of PgBouncer.
inline constexpr const char* kNoPooler =
    "no pgbouncer on the PATH or in build/tools (deploy/test takes it from the package pgbouncer)";

/// Whether there is a PgBouncer to start.
[[nodiscard]] bool has_pooler();

/// A PgBouncer of its own on a unix socket before the throw-away server, gone at the end. Throws
/// std::runtime_error when it does not start.
class Pooler {
 public:
  /// `mode` is its pool_mode; `users` may log in, without a password; `more` are lines of
  /// pgbouncer.ini.
  Pooler(const std::string& mode, const std::vector<std::string>& users,
         const std::string& more = "");
  ~Pooler();
  Pooler(const Pooler&) = delete;
  Pooler& operator=(const Pooler&) = delete;

  /// The connection string `conninfo` by way of the pooler.
  [[nodiscard]] std::string conninfo(const std::string& conninfo) const;

 private:
  void write_files(const std::string& mode, const std::vector<std::string>& users,
                   const std::string& more) const;

  TemporaryFolder folder_;
  std::optional<BackgroundProgram> program_;
};

}  // namespace loopscope::tests
