#include <gmock/gmock.h>
#include <optional>

#include "storage/error.hpp"
#include "storage/historian/pq_connection.hpp"
#include "storage/results/session/session.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/tls_server.hpp"

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kSecret = "Zq9-geheim-77";

/// Both kinds of connections, by libpqxx and by libpq, against a real certificate. One test: a
/// server takes seconds to make.
class TlsTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.execute(std::string("CREATE ROLE plant LOGIN PASSWORD '") + kSecret + "'");
    password_.emplace("PGPASSWORD", kSecret);
  }

  [[nodiscard]] ConnectionSettings settings(const std::string& more) const {
    ConnectionSettings settings;
    settings.conninfo =
        "port=" + std::to_string(server_.port()) + " user=plant dbname=postgres " + more;
    settings.purpose = "plant";
    return settings;
  }

  [[nodiscard]] std::string verified(const std::string& authority = "authority") const {
    return " sslmode=verify-full sslrootcert=" + server_.certificate(authority);
  }

  void expect_connected(const std::string& more) const {
    Session session(settings(more));
    const Statement encrypted{
        "encrypted", "SELECT ssl FROM pg_stat_ssl WHERE pid = pg_backend_pid()", Rows::one};
    EXPECT_TRUE(session.transact(
        [&](Transaction& transaction) { return transaction.run(encrypted)[0][0].as<bool>(); }));
    PqConnection connection(settings(more));
    EXPECT_EQ(connection.run(encrypted).text(0, 0), "t");
  }

  /// Both kinds of connections fail, with these words and this hint, and do not try again.
  void expect_refused(const std::string& more, const std::string& words,
                      const std::string& hint) const {
    SCOPED_TRACE(more);
    for (const bool by_libpqxx : {true, false}) {
      try {
        if (by_libpqxx) {
          const Session session(settings(more));
        } else {
          const PqConnection connection(settings(more));
        }
        ADD_FAILURE() << "connected";
      } catch (const DatabaseError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(words), Not(HasSubstr(kSecret))));
        EXPECT_THAT(error.hint(), AllOf(HasSubstr(hint), Not(HasSubstr(kSecret))));
        EXPECT_EQ(error.remedy(), Remedy::give_up);
      }
    }
  }

  tests::TlsServer server_;
  std::optional<tests::EnvironmentVariable> password_;
};

TEST_F(TlsTest, VerifyFullAcceptsTheRightCertificateAndNothingElse) {
  expect_connected("host=localhost" + verified());
  expect_connected("host=localhost hostaddr=127.0.0.1" + verified());
  expect_connected("host=localhost channel_binding=require" + verified());

  expect_refused("host=127.0.0.1" + verified(), "does not match host name \"127.0.0.1\"",
                 "connect by a name that stands in the server's certificate");
  expect_refused("host=db1.example.com hostaddr=127.0.0.1" + verified(),
                 "does not match host name \"db1.example.com\"", "stands in the server's");
  expect_refused("host=localhost" + verified("other"), "certificate verify failed",
                 "authority that signed the server's");
  expect_refused("host=localhost sslmode=verify-full sslrootcert=/nowhere/ca.crt",
                 "root certificate file \"/nowhere/ca.crt\" does not exist", "sslrootcert=FILE");
  expect_refused("host=localhost sslmode=disable", "no encryption", "pg_hba.conf");

  server_.show_certificate("expired");
  expect_refused("host=localhost" + verified(), "certificate verify failed", "has expired");
  server_.show_certificate("elsewhere");
  expect_refused("host=localhost" + verified(), "does not match host name \"localhost\"",
                 "stands in the server's certificate");
  // Less than verify-full takes it all the same: what the warning is about.
  expect_connected("host=localhost sslmode=verify-ca sslrootcert=" +
                   server_.certificate("authority"));
  server_.switch_tls(false);
  expect_refused("host=localhost" + verified(), "server does not support SSL", "set ssl = on");
  expect_refused("host=localhost,127.0.0.1" + verified(), "server does not support SSL",
                 "set ssl = on");
}

}  // namespace
}  // namespace loopscope::storage
