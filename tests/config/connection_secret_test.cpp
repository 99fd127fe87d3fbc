#include "config/connection_secret.hpp"

#include <gtest/gtest.h>

namespace loopscope::config::tests {
namespace {

TEST(ConnectionSecret, KeywordFormWithout) {
  for (const char* connection :
       {"", "service=plant", "host=db user=worker dbname=results", "passfile=/etc/loopscope/pgpass",
        "dbname='password=x'", "dbname = 'a\\' password=x'", "dbname=a\\ password=x", "user",
        "host=", "= =", "application_name=password"})
    EXPECT_FALSE(holds_secret(connection)) << connection;
}

TEST(ConnectionSecret, KeywordFormWith) {
  for (const char* connection :
       {"password=x", "host=db password=x", "host = db  password = 'x y'", "dbname='a' password=x",
        "sslpassword=x", "PassWord=x", "host=db\tpassword\n=x", "password", "host password=x"})
    EXPECT_TRUE(holds_secret(connection)) << connection;
}

TEST(ConnectionSecret, UriWithout) {
  for (const char* connection :
       {"postgresql://", "postgresql://db/results", "postgres://worker@db:5432/results",
        "postgresql://db1:5432,db2:5433/results?target_session_attrs=read-write",
        "postgresql:///results?host=/run/postgresql&user=worker", "postgresql://db/a:b@c",
        "postgresql://db/results?passfile=x&application_name=password"})
    EXPECT_FALSE(holds_secret(connection)) << connection;
}

TEST(ConnectionSecret, UriWith) {
  for (const char* connection :
       {"postgresql://worker:x@db/results", "postgres://:x@db", "postgresql://u:x@h1:1,h2:2/r",
        "postgresql://db/results?password=x", "postgresql://db?user=u&password=x",
        "postgresql://db/r?p%61ssword=x", "postgresql://db/r?sslpassword=x"})
    EXPECT_TRUE(holds_secret(connection)) << connection;
}

}  // namespace
}  // namespace loopscope::config::tests
