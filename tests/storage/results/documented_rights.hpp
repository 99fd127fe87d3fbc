#pragma once

#include <set>
#include <string>

namespace loopscope::storage {

/// The rights that the table of storage/README.md ("Roles") gives to one of its roles, e.g.
/// "worker". Throws std::runtime_error when the table is not there or a row cannot be read.
class DocumentedRights {
 public:
  explicit DocumentedRights(const std::string& role);

  /// `privilege` is SELECT, INSERT, ...; UPDATE is given by columns alone.
  [[nodiscard]] bool on_table(const std::string& privilege, const std::string& table) const;
  [[nodiscard]] bool update_of(const std::string& table, const std::string& column) const;
  [[nodiscard]] bool insert_of(const std::string& table, const std::string& column) const;
  /// To look at every sequence, as pg_dump does.
  [[nodiscard]] bool reads_sequences() const { return read_sequences_; }
  /// To take numbers from it.
  [[nodiscard]] bool on_sequence(const std::string& sequence) const;
  [[nodiscard]] bool on_function(const std::string& function) const;
  [[nodiscard]] bool on_schema() const { return schema_; }

 private:
  void read_row(const std::string& privilege, const std::string& objects);

  bool schema_ = false;
  bool select_all_ = false;
  bool read_sequences_ = false;
  std::set<std::string> tables_;     ///< "INSERT verdict"
  std::set<std::string> columns_;    ///< "parameter.value"
  std::set<std::string> partly_;     ///< tables of which only some columns may be inserted ...
  std::set<std::string> inserted_;   ///< ... these: "annotation.reason"
  std::set<std::string> all_but_;    ///< tables of which every column may be updated ...
  std::set<std::string> exempt_;     ///< ... but these: "analysis.loop_id"
  std::set<std::string> sequences_;  ///< names
  std::set<std::string> functions_;
};

}  // namespace loopscope::storage
