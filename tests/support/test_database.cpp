#include "tests/support/test_database.hpp"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

#include "tests/support/source_dir.hpp"

namespace loopscope::tests {
namespace {

std::string server() {
  const std::optional<std::string> found = test_server();
  if (!found) throw std::runtime_error(kNoServer);
  return *found;
}

const ReusedConnection& administration() {
  static const ReusedConnection connection(server());
  return connection;
}

/// Tests run side by side in processes of their own.
std::string unique_name() {
  static std::atomic<int> count{0};
  return "test_" + std::to_string(getpid()) + "_" + std::to_string(++count);
}

}  // namespace

std::optional<std::string> test_server() {
  std::ifstream file(binary_dir() / "postgres.env");
  const std::string key = "LOOPSCOPE_TEST_DATABASE=";
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key)) return line.substr(key.size());
  }
  return std::nullopt;
}

std::string roles_script() {
  const std::ifstream file(source_dir() / "deploy" / "roles.sql");
  std::ostringstream script;
  script << file.rdbuf();
  return script.str();
}

std::string make_owner(const std::string& conninfo) {
  const std::string login = "loopscope_test_owner";
  const SqlConnection database(conninfo);
  database.run(roles_script());
  // Others may make it in this moment.
  database.run("DO $$ BEGIN IF to_regrole('" + login + "') IS NULL THEN CREATE ROLE " + login +
               " LOGIN IN ROLE loopscope_owner; END IF;"
               " EXCEPTION WHEN duplicate_object OR unique_violation THEN NULL; END $$");
  return login;
}

TestDatabase::TestDatabase(const std::string& encoding)
    : name_(unique_name()), connection_(with_key(server(), "dbname", name_)) {
  administration().run("CREATE DATABASE " + name_ + " TEMPLATE template0 ENCODING '" + encoding +
                       "'" + copy_strategy(administration()));
}

TestDatabase::TestDatabase(const TemplateDatabase& filled)
    : name_(unique_name()), connection_(with_key(server(), "dbname", name_)) {
  copy_template(administration(), server(), filled, name_);
}

TestDatabase::~TestDatabase() {
  try {
    connection_.close();
    administration().run("DROP DATABASE " + name_ + " WITH (FORCE)");
    for (const std::string& login : logins_) administration().run("DROP ROLE " + login);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
}

std::string TestDatabase::conninfo() const {
  return with_key(server(), "dbname", name_);
}

std::string TestDatabase::conninfo(const std::string& user) const {
  return with_key(conninfo(), "user", user);
}

void TestDatabase::make_roles() const {
  execute(roles_script());
}

std::string TestDatabase::owner() const {
  std::call_once(roles_, [this] { owner_ = make_owner(conninfo()); });
  return owner_;
}

std::string TestDatabase::make_login(const std::string& group) {
  const std::string login = name_ + "_login" + std::to_string(logins_.size());
  execute("CREATE ROLE " + login + " LOGIN" + (group.empty() ? "" : " IN ROLE " + group));
  logins_.push_back(login);
  return login;
}

void TestDatabase::execute(const std::string& sql) const {
  connection_.run(sql);
}

TextRows TestDatabase::rows(const std::string& sql, const std::string& null_text) const {
  return connection_.run(sql, null_text);
}

std::string TestDatabase::value(const std::string& sql) const {
  const TextRows table = rows(sql);
  if (table.size() != 1 || table[0].empty()) {
    throw std::runtime_error(std::to_string(table.size()) + " rows instead of one in: " + sql);
  }
  return table[0][0];
}

}  // namespace loopscope::tests

// libpqxx 6.4.5 does not free the result of a statement whose connection breaks meanwhile: some 2
// kB each time, which only a build with LeakSanitizer would report.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming): LeakSanitizer's name
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libpqxx\n";
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
