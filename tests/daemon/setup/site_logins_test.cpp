#include "daemon/setup/site_logins.hpp"

#include <gmock/gmock.h>

#include "daemon/setup/next_commands.hpp"
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

TEST(SiteLogins, SqlIsForWhatIsNotThere) {
  SiteLogins logins;
  logins.worker.trial = {LoginTrial::State::refused, "", "", LoginTrial::Refusal::no_password};
  logins.owner.trial = logins.worker.trial;
  EXPECT_TRUE(logins.results_need_sql());
  logins.worker.near = logins.owner.near = {"dbname", "loopscope"};
  EXPECT_FALSE(logins.results_need_sql()) << "the name is wrong";
  logins.worker.near = logins.owner.near = {"host", "db1"};
  EXPECT_TRUE(logins.results_need_sql());
  logins.owner.trial = {};
  EXPECT_TRUE(logins.results_need_sql());
  logins.worker.seen = true;
  EXPECT_FALSE(logins.results_need_sql()) << "its password is all that is missing";
}

TEST(SiteLogins, TheHistoriansReaderSeesADatabaseOfBoth) {
  SiteLogins logins;
  logins.worker.trial.state = logins.owner.trial.state = LoginTrial::State::refused;
  logins.worker.target = {"db1", "5432", "plant", "w"};
  logins.reader.target = {"db1", "5432", "plant", "r"};
  EXPECT_TRUE(logins.database_is_there());
  logins.reader.target.database = "other";
  EXPECT_FALSE(logins.database_is_there());
}

TEST(Scripts, OfGrantsAlonePsqlAsksForNothing) {
  const storage::ConnectionTarget target{"db1", "5432", "", ""};
  const auto printed = [&](const Script& script) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(hand_out(script, target, ""), "the SQL above");
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed({"the historian", "historian.sql", "plant", "GRANT x;\n", true}),
            "\n-- Loopscope, for the historian. As a superuser of it or as the owner of the "
            "tables,\n-- on its own host, where postgres can read the file, or over the network "
            "with a password:\n"
            "--   sudo -u postgres psql -p 5432 -d plant -f historian.sql\n"
            "--   psql -h db1 -p 5432 -U postgres -d plant -f historian.sql\nGRANT x;\n");
  EXPECT_THAT(
      printed({"the historian", "historian.sql", "plant", "\\password x\n"}),
      HasSubstr("As a superuser of it (from the file: psql asks for the new passwords),\n"));
}

TEST(NextCommands, GoOnAsTheReadmeDoes) {
  EXPECT_EQ(next_commands("a.json", "2026-11-22"),
            "Review a.json, then:\n"
            "  loopscope migrate --config a.json\n"
            "  loopscope loops --config a.json discover --out loops.csv   (review it)\n"
            "  loopscope loops --config a.json load loops.csv\n"
            "  loopscope once --config a.json\n"
            "The past week, so that the list knows since when:\n"
            "  loopscope maintain --config a.json --since 2026-11-22\n"
            "  loopscope backfill --config a.json --since 2026-11-22 --every 6h\n"
            "What people read, and the service that goes on judging:\n"
            "  loopscope report --config a.json --out report\n"
            "  loopscope run --config a.json\n");
}

TEST(NextCommands, AnIndexComesFirstReadyToBeCopied) {
  storage::Finding index;
  index.index_sql = R"(CREATE INDEX ON "t" ("id");)";
  index.table_owner = "telegraf";
  EXPECT_EQ(index_command(index, {"db2", "5433", "plant", "r"}),
            "First the index of the historian: without it all works, but slowly. As telegraf, who "
            "owns the table,\nor on its own host with `sudo -u postgres psql -p 5433 -d plant`:\n"
            "psql -h db2 -p 5433 -U telegraf -d plant <<'SQL'\n"
            "CREATE INDEX ON \"t\" (\"id\");\nSQL\n");
}

TEST(Scripts, TheCommandIsOneThatAShellTakes) {
  EXPECT_EQ(psql_as("a b", {"db1", "5432", "", ""}, "my 'plant'"),
            R"(psql -h db1 -p 5432 -U 'a b' -d 'my '\''plant'\''')");
  EXPECT_EQ(psql_as("u", {"", "5432", "", ""}, "x"), "psql -p 5432 -U u -d x");
  EXPECT_EQ(psql_on_its_host({"db1", "5432", "", ""}, "x"), "sudo -u postgres psql -p 5432 -d x");
  EXPECT_EQ(psql_on_its_host({"/srv/my pg", "5432", "", ""}, "x"),
            "sudo -u postgres psql -h '/srv/my pg' -p 5432 -d x")
      << "never another server of that port";
}

}  // namespace
}  // namespace loopscope::daemon
