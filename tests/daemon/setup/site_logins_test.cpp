#include "daemon/setup/site_logins.hpp"

#include <gmock/gmock.h>

#include "daemon/setup/scripts.hpp"
#include "daemon/text/failure.hpp"

namespace loopscope::daemon {
namespace {

using storage::LoginTrial;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

config::Settings completed(const std::string& results, const std::string& historian,
                           const std::string& owner = "") {
  config::Settings settings;
  settings.results.connection = results;
  settings.results.owner_connection = owner;
  settings.historians.emplace_back().connection = historian;
  complete_connections(settings);
  return settings;
}

TEST(SiteLogins, AreNamedWhereNobodyNamesThem) {
  const auto settings = completed("host=db1 dbname=loopscope", "postgresql://db2:5433/plant");
  EXPECT_EQ(settings.results.connection, "host=db1 dbname=loopscope user=loopscope_worker_1");
  EXPECT_EQ(settings.results.owner_connection, "host=db1 dbname=loopscope user=loopscope_owner_1");
  EXPECT_EQ(settings.historians[0].connection,
            "host=db2 port=5433 dbname=plant user=loopscope_historian_1");
}

TEST(SiteLogins, StayAsTheyWereNamed) {
  const auto settings =
      completed("service=worker", "host=db2 user=reader sslmode=verify-full", "service=own");
  EXPECT_EQ(settings.results.connection, "service=worker");
  EXPECT_EQ(settings.results.owner_connection, "service=own");
  EXPECT_EQ(settings.historians[0].connection, "host=db2 user=reader sslmode=verify-full");
  EXPECT_EQ(completed("service=worker", "dbname=x user=y").results.owner_connection,
            "service=worker user=loopscope_owner_1");
}

TEST(SiteLogins, APasswordIsRefusedUnseen) {
  for (const char* given : {"host=db1 password=geheim", "postgresql://u:geheim@db1/x"}) {
    try {
      completed(given, "dbname=x");
      FAIL();
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::usage);
      EXPECT_THAT(failure.what() + failure.hint(), Not(HasSubstr("geheim")));
      EXPECT_THAT(failure.hint(), HasSubstr("~/.pgpass"));
    }
  }
}

TEST(SiteLogins, LinesOfThePasswordFileAreEscaped) {
  SiteLogins logins;
  logins.worker.target = {"::1", "5432,5433", "loopscope", "a:b"};
  logins.worker.trial.state = LoginTrial::State::refused;
  logins.owner.target = {"", "5432", "loopscope", "own"};
  logins.owner.trial.state = LoginTrial::State::refused;
  logins.reader.trial.state = LoginTrial::State::works;
  EXPECT_THAT(
      password_lines(logins),
      ElementsAre(R"(\:\:1:5432:loopscope:a\:b:PASSWORD)", "localhost:5432:loopscope:own:PASSWORD",
                  R"(\:\:1:5432:loopscope:loopscope_reader_1:PASSWORD)",
                  R"(\:\:1:5432:loopscope:loopscope_engineer_1:PASSWORD)"));
  logins.owner.trial.state = LoginTrial::State::works;
  EXPECT_THAT(password_lines(logins), SizeIs(1)) << "the database is there";
}

TEST(Scripts, TheCommandIsOneThatAShellTakes) {
  const Script script{"the historian", "historian.sql", "my 'plant'", ""};
  EXPECT_EQ(psql_command(script, {"db1", "5432", "", ""}, "a b/historian.sql"),
            R"(psql -h db1 -p 5432 -U postgres -d 'my '\''plant'\''' -f 'a b/historian.sql')");
  EXPECT_EQ(psql_command({"", "", "x", ""}, {"", "5432", "", ""}, "f"),
            "psql -p 5432 -U postgres -d x -f f");
}

}  // namespace
}  // namespace loopscope::daemon
