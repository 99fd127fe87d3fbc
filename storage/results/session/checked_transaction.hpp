#pragma once

#include <pqxx/pqxx>
#include <string>
#include <utility>

namespace loopscope::storage {

inline constexpr const char* kReadWrite = "BEGIN";
inline constexpr const char* kOneMoment = "BEGIN ISOLATION LEVEL REPEATABLE READ, READ ONLY";

/// A transaction that begins, in the same message, with the check of its session: where that fails,
/// nothing else is done in it. Commits as pqxx::work does.
class CheckedTransaction : public pqxx::internal::basic_transaction {
 public:
  CheckedTransaction(pqxx::connection_base& connection, const char* begin,
                     const std::string& check_sql)
      : pqxx::internal::namedclass("transaction"),
        basic_transaction(connection, "READ COMMITTED", pqxx::read_write),
        begin_(std::string(begin) + "; " + check_sql) {
    Begin();
  }
  ~CheckedTransaction() override { End(); }
  CheckedTransaction(const CheckedTransaction&) = delete;
  CheckedTransaction& operator=(const CheckedTransaction&) = delete;

 private:
  void do_begin() override { direct_exec(begin_.c_str()); }

  std::string begin_;
};

}  // namespace loopscope::storage
