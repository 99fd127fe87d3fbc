#include "storage/check_connection.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include "storage/error.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::EnvironmentVariable;

class PasswordSources : public testing::Test {
 protected:
  PasswordSources() : file_(folder_.path() / "pgpass") {
    std::ofstream(file_) << "*:*:*:*:geheim\n";
    permit(std::filesystem::perms::owner_read);
  }

  void permit(std::filesystem::perms permissions) const {
    std::filesystem::permissions(file_, permissions);
  }

  [[nodiscard]] static std::vector<Finding> found(const std::string& conninfo = "host=localhost") {
    ConnectionSettings settings;
    settings.conninfo = conninfo;
    settings.purpose = "results";
    std::vector<Finding> findings = check_password_sources(settings);
    for (const Finding& finding : findings) {
      EXPECT_TRUE(finding.ok && finding.warning);
      EXPECT_THAT(finding.what + finding.hint, Not(HasSubstr("geheim")));
    }
    return findings;
  }

  tests::TemporaryFolder folder_;
  std::string file_;
};

TEST_F(PasswordSources, AFileOfOnesOwnIsFine) {
  const EnvironmentVariable named("PGPASSFILE", file_);
  EXPECT_THAT(found(), IsEmpty());
  permit(std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(PasswordSources, AFileThatOthersMayReadIsIgnoredByLibpqAndThatIsSaid) {
  for (const auto other : {std::filesystem::perms::group_read, std::filesystem::perms::others_read,
                           std::filesystem::perms::group_write}) {
    permit(std::filesystem::perms::owner_read | other);
    const auto findings = found("host=localhost passfile=" + file_);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].what,
              "the password file " + file_ + " is open to others, so it is ignored");
    EXPECT_EQ(findings[0].hint, "chmod 0600 " + file_);
  }
}

TEST_F(PasswordSources, AFileThatIsNamedAndNotThere) {
  EXPECT_EQ(found("passfile=/nowhere/pgpass").at(0).what,
            "the password file /nowhere/pgpass does not exist or cannot be reached");
  EXPECT_EQ(found("passfile=/nowhere/pgpass").at(0).hint, "check passfile= and PGPASSFILE");
  EXPECT_EQ(
      found("passfile=" + folder_.path().string()).at(0).what,
      "the password file " + folder_.path().string() + " is not a plain file, so it is ignored");
  const EnvironmentVariable home("HOME", folder_.path());
  EXPECT_THAT(found(), IsEmpty()) << "nobody has to have a ~/.pgpass";
  const EnvironmentVariable named("PGPASSFILE", "/nowhere/else");
  EXPECT_THAT(found().at(0).what, HasSubstr("/nowhere/else does not"));
}

TEST_F(PasswordSources, AServiceFileWithAPasswordIsItsReadersAlone) {
  const std::string services = folder_.path() / "services";
  std::ofstream(services) << "[plant]\nhost=localhost\npassword=geheim\n[other]\nhost=db2\n";
  const EnvironmentVariable named("PGSERVICEFILE", services);
  const EnvironmentVariable passwords("PGPASSFILE", file_);
  std::filesystem::permissions(services, std::filesystem::perms(0640));
  ASSERT_EQ(found("service=plant").size(), 1U);
  EXPECT_EQ(found("service=plant")[0].what,
            "the service file " + services + " holds a password and is open to others");
  EXPECT_EQ(found("service=plant")[0].hint,
            "put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600) instead, or chmod "
            "0600 " +
                services);
  EXPECT_THAT(found("host=localhost"), IsEmpty()) << "nobody asks for a service";
  std::filesystem::permissions(services, std::filesystem::perms(0600));
  EXPECT_THAT(found("service=plant"), IsEmpty());
  std::ofstream(services) << "[plant]\nhost=localhost\n";
  std::filesystem::permissions(services, std::filesystem::perms(0644));
  EXPECT_THAT(found("service=plant"), IsEmpty()) << "no secret in it";
}

TEST_F(PasswordSources, APasswordInTheEnvironmentWorksAndIsAdvisedAgainst) {
  const EnvironmentVariable named("PGPASSFILE", file_);
  const EnvironmentVariable password("PGPASSWORD", "geheim");
  EXPECT_EQ(found().at(0).what,
            "PGPASSWORD is set: a password in the environment is passed on to every child process, "
            "shown by systemctl, and used for every database");
  EXPECT_EQ(found().at(0).hint,
            "unset it and put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (mode 0600)");
}

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

TEST(TransportSecurity, TheSentenceSaysWhatAnAttackerCanDo) {
  const auto said = [](const std::string& mode) {
    return found("host=db1 dbname=plant user=u sslmode=" + mode)->what;
  };
  const std::string start = "the connection to the remote host db1 has sslmode=";
  const std::string target = ", results database (";
  EXPECT_THAT(said("prefer"), testing::StartsWith(start +
                                                  "prefer: anybody on the way can read along "
                                                  "or pose as the server" +
                                                  target));
  EXPECT_THAT(said("require"), testing::StartsWith(start +
                                                   "require: anybody on the way can pose as "
                                                   "the server" +
                                                   target));
  EXPECT_THAT(said("verify-ca"),
              testing::StartsWith(start +
                                  "verify-ca: whoever has a certificate of the same authority "
                                  "can pose as the server" +
                                  target));
  EXPECT_EQ(found("host=db1 sslmode=require")->hint,
            "add sslmode=verify-full and sslrootcert=FILE, the certificate of the authority that "
            "signed the server's, to the connection string or its service");
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
