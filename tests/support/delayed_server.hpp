#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests {

/// The throw-away server as behind a slow line: what either side sends arrives `delay` later.
/// Connections must be closed before it goes.
class DelayedServer {
 public:
  explicit DelayedServer(std::chrono::milliseconds delay);
  ~DelayedServer();
  DelayedServer(const DelayedServer&) = delete;
  DelayedServer& operator=(const DelayedServer&) = delete;

  /// The connection string `conninfo` by way of the slow line.
  [[nodiscard]] std::string conninfo(const std::string& conninfo) const;

 private:
  void serve();

  std::chrono::milliseconds delay_;
  TemporaryFolder folder_;
  std::filesystem::path server_;  ///< its socket
  int listener_;
  std::thread acceptor_;
};

}  // namespace loopscope::tests
