#include "storage/misplaced_options.hpp"

#include <gmock/gmock.h>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What a message would show of a connection.
std::string shown(const std::string& conninfo) {
  ConnectionSettings settings;
  settings.conninfo = conninfo;
  settings.purpose = "results";
  try {
    return describe_target(settings);
  } catch (const DatabaseError& error) {
    EXPECT_EQ(error.remedy(), Remedy::give_up);
    EXPECT_FALSE(error.hint().empty());
    return std::string(error.what()) + " HINT: " + error.hint();
  }
}

TEST(MisplacedOptions, APasswordInAnotherPlaceIsRefusedAndNotShown) {
  for (const char* conninfo : {"dbname='postgresql://u:geheim@h/db'",
                               "dbname='host=h password=geheim'",
                               "user='u:geheim'",
                               "host=u:geheim@db1",
                               "host=db1,u:geheim@db2",
                               "host=geheim@db1",
                               "host=u:geheim",
                               "hostaddr=u:geheim@10.0.0.1",
                               "postgresql://db/r?host=u:geheim@db1",
                               "dbname=u:geheim@h/db",
                               "service=u:geheim@h",
                               "postgresql://h/u:geheim@db",
                               "postgresql:///r?service=u:geheim@h",
                               "host=h port=5432:geheim",
                               "host=h;user=u;password=geheim",
                               "host=h,user=u,password=geheim",
                               "host=h&pwd=geheim",
                               "user=u;geheim",
                               "service=x;password=geheim",
                               "sslmode=require;password=geheim",
                               "dbname=x,pwd:geheim"}) {
    EXPECT_THAT(shown(conninfo), HasSubstr("not shown, it may hold a password")) << conninfo;
    EXPECT_THAT(shown(conninfo), Not(HasSubstr("geheim"))) << conninfo;
  }
}

TEST(MisplacedOptions, EachRefusalSaysWhereAndWhatToWrite) {
  struct Case {
    const char* conninfo;
    const char* holds;
    const char* hint;
  };
  for (const Case& one :
       {Case{"dbname='postgresql://u:geheim@h/db'", "dbname= holds a whole connection string",
             "give that string alone, without dbname="},
        Case{"dbname='host=h password=geheim'", "dbname= holds more options than one",
             "put spaces between options, and none into one"},
        Case{"dbname=u:geheim@h/db", "dbname= holds more than a name",
             "write host=NAME dbname=NAME user=NAME, and the password into ~/.pgpass"},
        Case{"user='u:geheim'", "user= holds more than a name",
             "write user=NAME, and the password into ~/.pgpass"},
        Case{"host=u:geheim@db1", "host= holds more than a host",
             "write host=NAME port=NUMBER user=NAME"},
        Case{"host=h port=5432:geheim", "port= holds more than a number", "write port=NUMBER"}})
    EXPECT_EQ(shown(one.conninfo),
              std::string("the connection string: ") + one.holds +
                  " (not shown, it may hold a password), results HINT: " + one.hint);
}

TEST(MisplacedOptions, WhatNamesAHostAUserOrADatabaseIsTaken) {
  for (const char* conninfo :
       {"host=db1,db2 port=5432,5433", "host=::1", "host=fe80::1%eth0", "host=db1,2001:db8::7",
        "host=/run/a:b@c", "host=@socket", "user=anna@plant.example", "dbname='a=b'",
        "dbname=plant@north", "dbname=plant:2026", "dbname=r@h:1", "service=plant@north",
        "postgresql://u@[::1]:5432/r", "hostaddr=::1", "host=db1 user=u dbname=plant"}) {
    EXPECT_THAT(shown(conninfo), HasSubstr("results database (")) << conninfo;
  }
}

}  // namespace
}  // namespace loopscope::storage
