#pragma once

#include <filesystem>
#include <string>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests {

/// A PostgreSQL server of its own with TLS on a loopback port (tests/support/tls_postgres), gone at
/// the end. Throws std::runtime_error when it cannot be made.
class TlsServer {
 public:
  TlsServer();
  ~TlsServer();
  TlsServer(const TlsServer&) = delete;
  TlsServer& operator=(const TlsServer&) = delete;

  [[nodiscard]] int port() const { return port_; }
  /// "authority", "other": the certificate of an authority, for sslrootcert.
  [[nodiscard]] std::string certificate(const std::string& name) const;
  /// Connection string of the superuser by unix socket.
  [[nodiscard]] std::string superuser() const;
  /// Runs commands as the superuser.
  void execute(const std::string& sql) const;

  /// From now on the server shows this certificate: "localhost", "elsewhere" or "expired".
  void show_certificate(const std::string& name) const;
  void switch_tls(bool on) const;

 private:
  void reload(const std::string& setting) const;

  TemporaryFolder parent_;
  std::filesystem::path folder_;
  int port_ = 0;
};

}  // namespace loopscope::tests
