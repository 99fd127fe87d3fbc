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
        "sslpassword=x", "PassWord=x", "user = u\vpassword=x", "host='a b' password='x'",
        "host='it\\'s' password=x", "host=a\\ b password=x", "scram_client_key=x",
        "oauth_client_secret=x", "passfile=/x password=y", "host=db\tpassword\n=x", "password",
        "host password=x"})
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
        "postgresql://db/r?p%61ssword=x", "postgresql://db/r?sslpassword=x",
        "postgresql://u:p%40ss@db/r", "postgresql://u%3Ax@db/r", "postgres://u:@db",
        "postgresql://u:a?b@db/r", "postgresql://db/r?host=x&%70%61%73%73%77%6f%72%64=x"})
    EXPECT_TRUE(holds_secret(connection)) << connection;
}

TEST(ConnectionSecret, TextForAPort) {
  for (const char* connection :
       {"postgresql://u:geheim/db", "postgresql://u:geheim", "postgresql://u:geheim?x=y",
        "postgresql://u:geheim%40db/r", "postgresql://h1:5432,u:geheim/r",
        "postgresql://u@h1:5432,h2:x@h3/r", "postgresql://[::1]:x/r"})
    EXPECT_TRUE(has_text_for_port(connection)) << connection;
  for (const char* connection :
       {"postgresql://db/r", "postgresql://u@h1:5432,h2:/r", "postgresql://[::1]:5432/r",
        "postgresql://[fe80::a]/r", "postgresql:///r?host=a:b", "host=a:b port=x", "",
        "postgresql://[unclosed"})
    EXPECT_FALSE(has_text_for_port(connection)) << connection;
}

}  // namespace
}  // namespace loopscope::config::tests
