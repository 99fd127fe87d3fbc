#include "storage/transport_security.hpp"

#include <chrono>
#include <fstream>
#include <gmock/gmock.h>

#include "storage/error.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::Not;
using tests::EnvironmentVariable;

std::optional<Finding> found(const std::string& conninfo) {
  ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = "results";
  return check_transport(settings);
}

TEST(TransportSecurity, LocalConnectionsNeedNoEncryption) {
  for (const char* conninfo :
       {"", "dbname=plant", "host=/run/postgresql", "host=@abstract", "host=localhost",
        "host=127.0.0.1", "host=127.8.9.10", "host=::1", "hostaddr=127.0.0.1 host=db1",
        "host=localhost,/run/postgresql,::1", "host=::ffff:127.0.0.1", "postgresql://localhost/x",
        "postgresql://%2Frun%2Fpostgresql/x", "postgresql://[::1]:5433/x"}) {
    EXPECT_FALSE(found(conninfo)) << conninfo;
  }
}

TEST(TransportSecurity, RemoteConnectionsNeedTheServersName) {
  for (const char* host :
       {"host=db1.example.com", "host=192.0.2.7", "host=2001:db8::7", "hostaddr=192.0.2.7",
        "host=localhost hostaddr=192.0.2.7", "host=localhost,db2.example.com",
        "host=,db2.example.com", "hostaddr=127.0.0.1,192.0.2.7", "host=127.example.com",
        "host=localhost.example.com", "user=u host=db1"}) {
    for (const char* mode : {"disable", "allow", "prefer", "require", "verify-ca"}) {
      const auto finding = found(std::string(host) + " sslmode=" + mode);
      ASSERT_TRUE(finding) << host << ' ' << mode;
      EXPECT_TRUE(finding->ok && finding->warning);
      EXPECT_THAT(finding->what, HasSubstr(std::string("sslmode=") + mode));
      EXPECT_THAT(finding->hint, HasSubstr("sslmode=verify-full"));
    }
    EXPECT_FALSE(found(std::string(host) + " sslmode=verify-full")) << host;
    EXPECT_FALSE(found(std::string(host) + " gssencmode=require")) << host;
  }
  EXPECT_THAT(found("host=db1 user=u password=geheim")->what,
              testing::AllOf(HasSubstr("sslmode=prefer: anybody on the way can read along"),
                             Not(HasSubstr("geheim"))));
  EXPECT_TRUE(found("postgresql://u@db1,db2/x?sslmode=require"));
  EXPECT_FALSE(found("postgresql://u@db1,db2/x?sslmode=verify-full"));
}

TEST(TransportSecurity, TheEnvironmentCounts) {
  const EnvironmentVariable host("PGHOST", "db1.example.com");
  EXPECT_TRUE(found("dbname=plant"));
  EXPECT_FALSE(found("dbname=plant host=localhost"));
  const EnvironmentVariable mode("PGSSLMODE", "verify-full");
  EXPECT_FALSE(found("dbname=plant"));
  EXPECT_TRUE(found("dbname=plant sslmode=require")) << "the settings go before the environment";
  const EnvironmentVariable address("PGHOSTADDR", "192.0.2.9");
  EXPECT_TRUE(found("host=localhost sslmode=require"));
}

TEST(TransportSecurity, ServiceFilesCount) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder.path() / "service.conf")
      << "[far]\nhost=db1.example.com\nuser=u\npassword=geheim\n"
         "[safe]\nhost=db1.example.com\nsslmode=verify-full\n[near]\nhost=/run/postgresql\n";
  const EnvironmentVariable file("PGSERVICEFILE", folder.path() / "service.conf");
  ASSERT_TRUE(found("service=far"));
  EXPECT_THAT(found("service=far")->what, HasSubstr("remote host db1.example.com"));
  EXPECT_THAT(found("service=far")->what, Not(HasSubstr("geheim")));
  EXPECT_FALSE(found("service=safe"));
  EXPECT_FALSE(found("service=near"));
  EXPECT_TRUE(found("service=safe sslmode=require"));
  const EnvironmentVariable service("PGSERVICE", "far");
  EXPECT_TRUE(found("dbname=plant"));
}

TEST(TransportSecurity, NoNameIsLookedUpAndNothingIsConnected) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(found("host=no-such-host.invalid,192.0.2.1"));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(500));
}

TEST(TransportSecurity, WhatCannotBeReadIsRefused) {
  EXPECT_THROW(static_cast<void>(found("host")), DatabaseError);
}

}  // namespace
}  // namespace loopscope::storage
