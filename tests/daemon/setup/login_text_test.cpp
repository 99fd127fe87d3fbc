#include "daemon/setup/login_text.hpp"

#include <gtest/gtest.h>

namespace loopscope::daemon {
namespace {

using Refusal = storage::LoginTrial::Refusal;
using State = storage::LoginTrial::State;

SiteLogin refused(Refusal refusal) {
  SiteLogin login{"worker", "--results", {"db1", "5432", "loopscope", "w", "/home/x/.pgpass"}, {}};
  login.trial = {State::refused, "what the server says", "its hint", refusal};
  return login;
}

/// Behind who it is.
std::string said_of(const SiteLogin& login) {
  const std::string whom = "not yet  worker: w, database loopscope at db1:5432: ";
  const std::string text = login_text(login);
  EXPECT_EQ(text.substr(0, whom.size()), whom);
  return text.substr(whom.size());
}

TEST(LoginText, ThatItWorksIsOneLine) {
  SiteLogin login = refused(Refusal::other);
  login.trial = {};
  EXPECT_EQ(login_text(login), "ok       worker: w, database loopscope at db1:5432\n");
}

TEST(LoginText, AMissingPasswordMayBeKeptForAnotherDatabase) {
  SiteLogin login = refused(Refusal::no_password);
  EXPECT_EQ(said_of(login), "no password for it is known here\n");
  EXPECT_FALSE(login.exists());
  login.near = {"dbname", "loopscop"};
  EXPECT_EQ(said_of(login),
            "no password for it is known here\n"
            "         HINT: /home/x/.pgpass has one for dbname=loopscop: is dbname in --results "
            "spelt right? If so, add the line below\n");
  EXPECT_TRUE(login.exists());
  login.password_sources = {{true, "the password file x is open to others", "chmod 0600 x", true}};
  EXPECT_EQ(said_of(login),
            "no password for it is known here\n"
            "         HINT: the password file x is open to others: chmod 0600 x\n");
}

TEST(LoginText, AWrongPasswordIsToldFromAMissingLoginWhereSomebodyHasSeenIt) {
  SiteLogin login = refused(Refusal::password_or_login);
  EXPECT_EQ(said_of(login),
            "the password is wrong, or there is no such login: the server does not tell which\n"
            "         HINT: if the login is there, correct its line in /home/x/.pgpass, of which "
            "the first that fits counts; the SQL that this hands out is for a login that is not "
            "there yet, and sets a new password\n");
  login.seen = true;
  EXPECT_EQ(said_of(login),
            "the password is wrong, the login is there\n"
            "         HINT: correct its line in /home/x/.pgpass, of which the first that fits "
            "counts; a superuser sets a new one in psql: \\password w\n");
}

TEST(LoginText, WhatIsNotThereIsNamed) {
  EXPECT_EQ(said_of(refused(Refusal::no_login)), "there is no such login\n");
  EXPECT_EQ(said_of(refused(Refusal::no_database)),
            "the login works, but the server has no such database\n"
            "         HINT: is dbname=loopscope in --results spelt right?\n");
  EXPECT_EQ(said_of(refused(Refusal::no_right)),
            "the login is there, but may not connect to the database\n"
            "         HINT: as its owner: GRANT CONNECT ON DATABASE \"loopscope\" TO \"w\"\n");
  EXPECT_EQ(said_of(refused(Refusal::other)), "what the server says\n         HINT: its hint\n");
}

}  // namespace
}  // namespace loopscope::daemon
