#include "storage/connection_settings.hpp"

#include <gmock/gmock.h>
#include <libpq-fe.h>
#include <map>
#include <memory>
#include <unistd.h>

#include "storage/error.hpp"
#include "tests/support/hostile_names.hpp"

namespace loopscope::storage {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// What libpq makes of a completed connection string.
std::map<std::string, std::string> options_of(const ConnectionSettings& settings) {
  const std::unique_ptr<PQconninfoOption, decltype(&PQconninfoFree)> parsed(
      PQconninfoParse(complete_conninfo(settings).c_str(), nullptr), &PQconninfoFree);
  std::map<std::string, std::string> options;
  for (const PQconninfoOption* option = parsed.get(); option && option->keyword; ++option) {
    if (option->val != nullptr) options[option->keyword] = option->val;
  }
  return options;
}

ConnectionSettings settings(const std::string& conninfo) {
  ConnectionSettings result;
  result.conninfo = conninfo;
  result.purpose = "results";
  return result;
}

TEST(ConnectionSettings, AddsTimeoutsAndTheSession) {
  const auto options = options_of(settings("host=db1 dbname=plant"));
  EXPECT_EQ(options.at("host"), "db1");
  EXPECT_EQ(options.at("connect_timeout"), "5");
  EXPECT_EQ(options.at("keepalives_idle"), "10");
  EXPECT_EQ(options.at("tcp_user_timeout"), "20000");
  EXPECT_EQ(options.at("client_encoding"), "UTF8");
  EXPECT_EQ(options.at("target_session_attrs"), "read-write");
  EXPECT_THAT(options.at("application_name"), StartsWith("loopscope/results/"));
  EXPECT_EQ(options.at("options"), "") << "poolers refuse it, or drop it";
  const SessionSettings session = session_settings(settings("host=db1"));
  EXPECT_EQ(session.at("timezone"), "UTC");
  EXPECT_EQ(session.at("statement_timeout"), "60s");
  EXPECT_EQ(session.at("search_path"), "pg_catalog, pg_temp");
  EXPECT_FALSE(session.contains("default_transaction_read_only"));
}

TEST(ConnectionSettings, ReaderIsReadOnlyAndTakesAnyHost) {
  ConnectionSettings reader = settings("host=db1");
  reader.read_only = true;
  const auto options = options_of(reader);
  EXPECT_EQ(session_settings(reader).at("default_transaction_read_only"), "on");
  EXPECT_FALSE(options.contains("target_session_attrs"));
}

TEST(ConnectionSettings, LocksAreWaitedForLessThanTheStatement) {
  ConnectionSettings timed = settings("host=db1");
  for (const auto& [statement_s, lock_ms] :
       {std::pair(60, "5000"), std::pair(10, "5000"), std::pair(3, "1500"), std::pair(0, "5000")}) {
    timed.statement_timeout_s = statement_s;
    EXPECT_EQ(session_settings(timed).at("lock_timeout"), lock_ms) << statement_s;
  }
}

TEST(ConnectionSettings, LeavesWhatTheUserSays) {
  const ConnectionSettings own = settings(
      "connect_timeout=77 application_name='my name'"
      " options='-c statement_timeout=5s --TimeZone=Asia/Kathmandu -S 1000'");
  const auto options = options_of(own);
  EXPECT_EQ(options.at("connect_timeout"), "77");
  EXPECT_EQ(options.at("application_name"), "my name");
  EXPECT_EQ(options.at("client_encoding"), "UTF8") << "all text in the program is UTF-8";
  EXPECT_EQ(options.at("options"), "-S 1000");
  const SessionSettings session = session_settings(own);
  EXPECT_EQ(session.at("statement_timeout"), "5s");
  EXPECT_EQ(session.at("timezone"), "Asia/Kathmandu");
  EXPECT_EQ(session.at("jit"), "off");
  EXPECT_EQ(session.at("client_encoding"), "UTF8");
}

TEST(ConnectionSettings, NoNameHidesTheProcessOrGetsIntoTheOptions) {
  const std::string pid = "/" + std::to_string(getpid());
  for (const tests::HostileName& hostile : tests::hostile_names()) {
    ConnectionSettings named = settings("host=db1");
    named.purpose = "historian " + hostile.name;
    const auto options = options_of(named);
    const std::string& name = options.at("application_name");
    EXPECT_LE(name.size(), 63U) << name;
    EXPECT_THAT(name, EndsWith(pid));
    for (const char c : name) EXPECT_TRUE(c >= ' ' && c <= '~') << hostile.about;
    EXPECT_EQ(options.at("host"), "db1");
    EXPECT_EQ(options.at("options"), "");
    EXPECT_EQ(session_settings(named), session_settings(settings("host=db1")));
  }
}

TEST(ConnectionSettings, TakesUrisAndOddCharacters) {
  const auto options = options_of(settings("postgresql://us%27er:p%5Cw@db1:5433/pl%20ant"));
  EXPECT_EQ(options.at("user"), "us'er");
  EXPECT_EQ(options.at("password"), "p\\w");
  EXPECT_EQ(options.at("dbname"), "pl ant");
  EXPECT_EQ(options.at("port"), "5433");
}

TEST(ConnectionSettings, TargetNamesNoSecret) {
  EXPECT_EQ(describe_target(settings("host=db1 dbname=plant user=u password=geheim")),
            "results database (host=db1 dbname=plant user=u)");
  EXPECT_EQ(describe_target(settings("")), "results database");
}

TEST(ConnectionSettings, UnreadableStringIsRefusedWithoutShowingSecrets) {
  for (const char* bad : {"host", "postgresql://u:geheim@[::1", "password=geheim host"}) {
    try {
      static_cast<void>(complete_conninfo(settings(bad)));
      FAIL() << bad;
    } catch (const DatabaseError& error) {
      EXPECT_EQ(error.remedy(), Remedy::give_up);
      EXPECT_THAT(error.what(), Not(HasSubstr("geheim")));
      EXPECT_THAT(error.what(), HasSubstr("cannot be read"));
    }
  }
}

}  // namespace
}  // namespace loopscope::storage
