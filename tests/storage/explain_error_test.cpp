#include "storage/explain_error.hpp"

#include <gmock/gmock.h>

namespace loopscope::storage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

DatabaseError explained(const std::string& sqlstate, const std::string& message,
                        DatabaseKind kind = DatabaseKind::results) {
  return explain({message, sqlstate, false}, {kind, "T database", "anna", "claim_due"});
}

DatabaseError connecting(const std::string& message) {
  return explain({message, "", true}, {DatabaseKind::results, "T database", "", ""});
}

TEST(ExplainError, SaysWhatAndWhere) {
  const DatabaseError error =
      explained("23505", "ERROR:  duplicate key\nDETAIL:  Key (name)=(a) already exists.\n");
  EXPECT_STREQ(error.what(),
               "duplicate key (Key (name)=(a) already exists.), statement claim_due, T database");
  EXPECT_EQ(error.sqlstate(), "23505");
  EXPECT_EQ(error.remedy(), Remedy::give_up);
}

TEST(ExplainError, RemedyFollowsTheState) {
  const auto remedy = [](const char* state) { return explained(state, "ERROR:  x").remedy(); };
  for (const char* state : {"40001", "40P01", "55P03", "57014", "53200"}) {
    EXPECT_EQ(remedy(state), Remedy::retry) << state;
  }
  for (const char* state : {"08006", "57P01", "57P02", "57P03", "25006", "53300", "25P03"}) {
    EXPECT_EQ(remedy(state), Remedy::reconnect) << state;
  }
  for (const char* state :
       {"42501", "42P01", "42703", "53100", "28P01", "57P04", "XX000", "22P02", "3D000", "99999"}) {
    EXPECT_EQ(remedy(state), Remedy::give_up) << state;
  }
}

TEST(ExplainError, ACommitInDoubtIsTold) {
  const DatabaseError error = explain({"the server did not answer in time", kOutcomeUnknown, true},
                                      {DatabaseKind::results, "T database", "anna", "commit"});
  EXPECT_EQ(error.sqlstate(), "08007");
  EXPECT_EQ(error.remedy(), Remedy::reconnect);
}

TEST(ExplainError, HintsNameTheCommandOrTheSetting) {
  EXPECT_THAT(explained("42P01", "ERROR:  relation \"loopscope.loop\" does not exist").hint(),
              HasSubstr("`loopscope migrate --config F`"));
  EXPECT_THAT(explained("42P01", "ERROR:  x", DatabaseKind::historian).hint(),
              HasSubstr("`table`"));
  EXPECT_THAT(explained("42703", "ERROR:  x", DatabaseKind::historian).hint(), HasSubstr("column"));
  EXPECT_THAT(explained("22P02", "ERROR:  x", DatabaseKind::historian).hint(),
              HasSubstr("`time_kind`"));
  EXPECT_THAT(explained("53100", "ERROR:  could not extend file").hint(), HasSubstr("free space"));
  EXPECT_THAT(explained("55P03", "ERROR:  x").hint(), HasSubstr("pg_locks"));
}

TEST(ExplainError, WaitingForALockIsNotTakenForAMissingIndex) {
  const DatabaseError announcing =
      explain({"ERROR:  canceling statement due to statement timeout", "57014", false},
              {DatabaseKind::results, "T database", "anna", "lock_flags"});
  EXPECT_EQ(announcing.remedy(), Remedy::retry);
  EXPECT_THAT(announcing.hint(), AllOf(HasSubstr("pg_locks"), Not(HasSubstr("index"))));
  // The server says where it stood when the time was over.
  EXPECT_THAT(explained("57014",
                        "ERROR:  canceling statement due to statement timeout\n"
                        "CONTEXT:  while updating tuple (0,1) in relation \"loop\"")
                  .hint(),
              HasSubstr("pg_locks"));
  EXPECT_THAT(explained("57014", "ERROR:  canceling statement due to statement timeout").hint(),
              HasSubstr("missing index"));
}

TEST(ExplainError, SiteOwnViewInTheWayIsTheSitesToDropAndRecreate) {
  const DatabaseError error = explained(
      "2BP01",
      "ERROR:  cannot drop view loopscope.flagged_loop because other objects depend on it\n"
      "DETAIL:  view public.mine depends on view loopscope.flagged_loop\n"
      "HINT:  Use DROP ... CASCADE to drop the dependent objects too.");
  EXPECT_EQ(error.remedy(), Remedy::give_up);
  EXPECT_THAT(error.what(), HasSubstr("view public.mine depends on"));
  EXPECT_THAT(error.hint(), AllOf(HasSubstr("drop it"), HasSubstr("create it again"),
                                  Not(HasSubstr("fault of the server"))));
}

TEST(ExplainError, SessionThatIsNotTheProgramsAnyMoreIsToldInAnyLanguage) {
  const DatabaseError lost =
      explained("22P02", "FEHLER:  ungültige Syntax: »loopscope session lost [statement_timeout]«");
  EXPECT_STREQ(lost.what(),
               "the session no longer has the program's setting statement_timeout, T database");
  const DatabaseError other =
      explained("26000", "FEHLER:  vorbereitete Anweisung »loopscope_check_42« existiert nicht");
  EXPECT_STREQ(other.what(), "the session is no longer the one that was set up, T database");
  for (const DatabaseError& error : {lost, other}) {
    EXPECT_EQ(error.remedy(), Remedy::reconnect);
    EXPECT_THAT(error.hint(), HasSubstr("pool_mode = session"));
  }
}

TEST(ExplainError, SettingThatIsRefusedIsLookedForInOptions) {
  const ErrorPlace place{DatabaseKind::results, "T database", "anna", "session_settings"};
  for (const char* state : {"22023", "42704", "42501", "55P02"}) {
    const DatabaseError error = explain({"ERROR:  x", state, false}, place);
    EXPECT_EQ(error.remedy(), Remedy::give_up);
    EXPECT_THAT(error.hint(), HasSubstr("options=")) << state;
  }
}

TEST(ExplainError, PoolerThatRefusesWhatIsSetAtTheStartIsNamed) {
  const DatabaseError error = connecting(
      "connection to server at \"db1\" (10.0.0.1), port 6432 failed: FATAL:  "
      "unsupported startup parameter: options");
  EXPECT_EQ(error.remedy(), Remedy::give_up);
  EXPECT_THAT(error.hint(), HasSubstr("PgBouncer"));
}

TEST(ExplainError, PrivilegeNamesTheGrant) {
  const std::string more =
      "; `loopscope check-config` prints every grant that is missing, with its schema";
  EXPECT_EQ(explained("42501", "ERROR:  permission denied for view seen\n", DatabaseKind::historian)
                .hint(),
            "as the owner: GRANT SELECT ON seen TO anna" + more);
  EXPECT_EQ(
      explained("42501", "ERROR:  permission denied for schema plant\n", DatabaseKind::historian)
          .hint(),
      "as the owner: GRANT USAGE ON SCHEMA plant TO anna" + more);
  EXPECT_THAT(explained("42501", "ERROR:  permission denied for table loop\n").hint(),
              HasSubstr("GRANT loopscope_worker TO anna"));
  EXPECT_THAT(explained("42501", "ERROR:  permission denied for database plant\n").hint(),
              HasSubstr("GRANT CREATE ON DATABASE plant TO anna"));
  const ErrorPlace copying{DatabaseKind::historian, "T database", "anna", "copy_rows"};
  EXPECT_EQ(explain({"ERROR:  permission denied for table h", "42501", false}, copying).hint(),
            "as the owner: GRANT SELECT, INSERT, DELETE ON h TO anna" + more);
  EXPECT_THAT(explained("42501", "FEHLER:  keine Berechtigung\n", DatabaseKind::historian).hint(),
              HasSubstr("anna"));
}

TEST(ExplainError, ConnectingIsToldApartByItsWords) {
  const std::string to = "connection to server at \"db1\", port 5432 failed: ";
  EXPECT_EQ(connecting(to + "Connection refused").remedy(), Remedy::reconnect);
  EXPECT_THAT(connecting(to + "Connection refused").hint(), HasSubstr("server runs"));
  EXPECT_EQ(connecting(to + "FATAL:  the database system is starting up").remedy(),
            Remedy::reconnect);
  EXPECT_EQ(connecting(to + "FATAL:  role \"x\" does not exist").remedy(), Remedy::give_up);
  EXPECT_THAT(connecting(to + "FATAL:  role \"x\" does not exist").hint(),
              HasSubstr("CREATE ROLE"));
  EXPECT_THAT(connecting(to + "FATAL:  database \"x\" does not exist").hint(), HasSubstr("dbname"));
  EXPECT_THAT(connecting(to + "FATAL:  password authentication failed for user \"x\"").hint(),
              HasSubstr(".pgpass"));
  EXPECT_THAT(connecting(to + "FATAL:  sorry, too many clients already").hint(),
              HasSubstr("max_connections"));
}

TEST(ExplainError, HandshakeThatBreaksIsTriedAgain) {
  const std::string to = "connection to server at \"db1\" (10.0.0.1), port 5432 failed: ";
  for (const char* words :
       {"SSL SYSCALL error: EOF detected", "SSL SYSCALL error: Connection reset by peer",
        "SSL error: unexpected eof while reading", "SSL connection has been closed unexpectedly",
        "could not send SSL negotiation packet: Broken pipe",
        "server closed the connection unexpectedly\n\tThis probably means the server terminated"
        " abnormally\n\tbefore or while processing the request.",
        "could not receive data from server: Connection reset by peer"}) {
    const DatabaseError error = connecting(to + words);
    EXPECT_EQ(error.remedy(), Remedy::reconnect) << words;
    EXPECT_THAT(error.hint(), HasSubstr("a worker tries again")) << words;
    EXPECT_THAT(error.what(), HasSubstr(std::string(words).substr(0, 20)));
  }
}

TEST(ExplainError, SettingsOfTlsAreNotTriedAgain) {
  const std::string to = "connection to server at \"db1\", port 5432 failed: ";
  const std::string broken = to + "SSL SYSCALL error: EOF detected\n";
  for (const char* words :
       {"SSL error: certificate verify failed", "SSL error: tlsv1 alert unknown ca",
        "server does not support SSL, but SSL was required",
        "server certificate for \"db2\" does not match host name \"db1\"",
        "FATAL:  password authentication failed for user \"x\""}) {
    EXPECT_EQ(connecting(to + words).remedy(), Remedy::give_up) << words;
  }
  // Of several hosts, or with TLS and without: a wrong password is one, whatever else broke.
  EXPECT_EQ(connecting(broken + to + "FATAL:  password authentication failed").remedy(),
            Remedy::give_up);
}

TEST(ExplainError, LostConnectionWinsOverItsState) {
  const DatabaseError error =
      explain({"", "42P01", true}, {DatabaseKind::results, "T database", "", "commit"});
  EXPECT_EQ(error.remedy(), Remedy::reconnect);
  EXPECT_THAT(error.what(), HasSubstr("the connection was lost"));
}

/// A view of the site's on one that a migration makes anew.
TEST(ExplainError, WhatStandsInTheWayIsNamed) {
  const DatabaseError error =
      explain({"ERROR:  cannot drop view loopscope.x because other objects depend on it\nDETAIL:  "
               "view report.mine depends on view loopscope.x",
               "2BP01", false},
              {DatabaseKind::results, "results database", "0013_repairs", ""});
  EXPECT_THAT(error.what(), HasSubstr("view report.mine depends on"));
  EXPECT_THAT(error.hint(), HasSubstr("drop it"));
}

}  // namespace
}  // namespace loopscope::storage
