#include <gtest/gtest.h>
#include <string>

#include "storage/explain_error.hpp"

namespace loopscope::storage {
namespace {

const std::string kTryAgain = "a worker tries again by itself, a command has to be run again";
const std::string kMigrate = "run `loopscope migrate --config F` as the owner";

std::string hint(const std::string& sqlstate, DatabaseKind kind = DatabaseKind::results,
                 const std::string& message = "ERROR:  x") {
  return explain({message, sqlstate, false}, {kind, "T database", "anna", "claim_due"}).hint();
}

TEST(ExplainErrorHints, OfAStatementByItsState) {
  struct Case {
    const char* sqlstate;
    std::string hint;
  };
  for (const Case& one :
       {Case{"08006", "the server ended the connection: " + kTryAgain},
        Case{"57P01", "the server ended the connection: " + kTryAgain},
        Case{"57P04", "check dbname in the connection string, or create the database"},
        Case{"57014",
             "the server was too slow: look for a missing index with `loopscope "
             "check-config`"},
        Case{"25006",
             "the server is a standby or read-only: name the primary, or all hosts, in "
             "the connection string"},
        Case{"40001", "other sessions were in the way: " + kTryAgain},
        Case{"55P03",
             "another session holds a lock: see pg_locks and pg_stat_activity; " + kTryAgain},
        Case{"53100", "free space on the database server's disk"},
        Case{"53200", "the server is out of memory: lower schedule.batch_loops"},
        Case{"53300",
             "raise max_connections on the server or lower daemon.workers in the "
             "settings"},
        Case{"54000",
             "a limit of the server was reached; of too many notifications: a listening "
             "session has an open transaction, the server's log names its process"},
        Case{"42P01", kMigrate},
        Case{"42703", "the schema is not the one of this program: " + kMigrate},
        Case{"22P02", "the stored value does not fit: report this as a fault of the program"},
        Case{"23505", "the value breaks a rule of the schema: see the detail above"},
        Case{"28P01", "check the user in the connection string and ~/.pgpass (mode 0600)"},
        Case{"2BP01",
             "an object of the site's own depends on what changes (the detail names it): "
             "let its owner drop it, repeat this, and create it again"},
        Case{"HV00N",
             "the server behind a foreign table does not answer, or not as PostgreSQL asks: try it "
             "from the machine of PostgreSQL, and look at CREATE SERVER, CREATE USER MAPPING and "
             "the columns of the foreign table"},
        Case{"XX000", "a fault of the server: read its log"},
        Case{"99999", "a fault of the server: read its log"}})
    EXPECT_EQ(hint(one.sqlstate), one.hint) << one.sqlstate;
}

TEST(ExplainErrorHints, OfAHistorianTheyNameItsSettings) {
  const DatabaseKind historian = DatabaseKind::historian;
  EXPECT_EQ(hint("42P01", historian),
            "check `table` of this historian in the settings (schema.table)");
  EXPECT_EQ(hint("42703", historian), "check the column names of this historian in the settings");
  EXPECT_EQ(hint("22P02", historian),
            "check `time_kind`, `quality_rule` and the columns' types of this historian; a view "
            "can convert what does not fit");
}

TEST(ExplainErrorHints, OfAMissingRightTheyNameTheGrant) {
  EXPECT_EQ(hint("42501", DatabaseKind::results, "ERROR:  permission denied for table loop\n"),
            "run `loopscope migrate --config F` as the owner, which grants the rights of the group "
            "roles, and make the user a member: GRANT loopscope_worker TO anna (loopscope_owner to "
            "change the catalogue or the schema, loopscope_engineer to annotate)");
  EXPECT_EQ(
      hint("42501", DatabaseKind::results, "ERROR:  permission denied for database plant\n"),
      "as a superuser: psql -d plant -f deploy/roles.sql, or GRANT CREATE ON DATABASE plant TO "
      "anna");
  EXPECT_EQ(hint("42501", DatabaseKind::historian, "FEHLER:  keine Berechtigung\n"),
            "let the table's owner grant the right to anna");
}

TEST(ExplainErrorHints, OfConnectingByTheServersWords) {
  const std::string broken =
      "the connection broke while it was made: " + kTryAgain +
      "; if that goes on, see the server's log, and whether something between ends or answers "
      "connections";
  struct Case {
    const char* words;
    std::string hint;
  };
  for (const Case& one :
       {Case{"server certificate for \"db2\" does not match host name \"db1\"",
             "connect by a name that stands in the server's certificate (host=NAME, hostaddr= for "
             "the address beside it), or have a certificate made for this one"},
        Case{"SSL error: certificate verify failed",
             "the certificate in sslrootcert is not of the authority that signed the server's, or "
             "one of the two has expired: `openssl s_client -starttls postgres -connect HOST:PORT "
             "-CAfile SSLROOTCERT` says which"},
        Case{"server does not support SSL, but SSL was required",
             "let the server's administrator set ssl = on: with less than sslmode=verify-full "
             "anybody on the way could read along"},
        Case{"root certificate file \"x\" does not exist",
             "name the certificate of the authority that signed the server's: sslrootcert=FILE"},
        Case{"private key file \"x\" has group access",
             "chmod 0600 the file of sslkey=, and let this user own it"},
        Case{"FATAL:  unsupported startup parameter: options",
             "PgBouncer refuses it at the start of a connection: leave it out of the connection "
             "string and of the environment (PGGEQO); settings as -c NAME=VALUE in options= are "
             "sent later"},
        Case{"fe_sendauth: no password supplied",
             "put HOST:PORT:DATABASE:USER:PASSWORD into ~/.pgpass (or the file that passfile= or "
             "PGPASSFILE names) and chmod 0600 it: one that others may read is ignored"},
        Case{"FATAL:  role \"x\" does not exist",
             "check user= in the connection string, or create the login: CREATE ROLE name LOGIN IN "
             "ROLE loopscope_worker (deploy/roles.sql makes the group roles)"},
        Case{"FATAL:  password authentication failed for user \"x\"",
             "check the user in the connection string and ~/.pgpass (mode 0600)"},
        Case{"FATAL:  Peer authentication failed for user \"x\"",
             "run as the system user of that name, or set up another method in pg_hba.conf"},
        Case{"FATAL:  no pg_hba.conf entry for host",
             "let the database's administrator add a line to pg_hba.conf"},
        Case{"SSL SYSCALL error: EOF detected", broken},
        Case{"SSL error: tlsv1 alert unknown ca",
             "check sslmode and sslrootcert in the connection string"},
        Case{"could not read certificate file", "check sslrootcert in the connection string"},
        Case{"definition of service \"x\" not found", "check service= and pg_service.conf"},
        Case{"FATAL:  permission denied for database \"x\"",
             "GRANT CONNECT ON DATABASE to the user"},
        Case{"FATAL:  sorry, too many clients already",
             "raise max_connections on the server or lower daemon.workers in the settings"},
        Case{"could not translate host name \"x\" to address",
             "check host= in the connection string, and the name server"},
        Case{"FATAL:  the database system is starting up", "wait until the server has started"},
        Case{"FATAL:  database \"x\" does not exist",
             "check dbname in the connection string, or create the database"},
        Case{"Connection refused",
             "check that the server runs and that host= and port= in the "
             "connection string are right"}}) {
    const DatabaseError error = explain({std::string("connection failed: ") + one.words, "", true},
                                        {DatabaseKind::results, "T database", "", ""});
    EXPECT_EQ(error.hint(), one.hint) << one.words;
    EXPECT_EQ(error.what(), std::string("connection failed: ") + one.words + ", T database");
  }
}

}  // namespace
}  // namespace loopscope::storage
