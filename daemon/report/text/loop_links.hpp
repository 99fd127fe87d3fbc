#pragma once

#include <cstdint>
#include <set>
#include <string>

namespace loopscope::daemon {

/// Where a loop's name leads on a page.
class LoopLinks {
 public:
  /// On a page of the daemon: to the loop's own.
  static LoopLinks pages();
  /// In a report: to its section where it has one, else to the daemon's page of it at
  /// `pages_address`, without a / at the end; empty = nowhere.
  static LoopLinks sections(std::set<std::int64_t> with_section, std::string pages_address = "");

  /// Ready for an attribute; empty = nowhere.
  [[nodiscard]] std::string to_loop(std::int64_t loop_id, const std::string& loop_name) const;
  /// The same for a loop that has no section.
  [[nodiscard]] std::string to_page(const std::string& loop_name) const;
  /// A list of all loops, `query` being what stands behind /loops; empty = nowhere.
  [[nodiscard]] std::string to_loops(const std::string& query) const;
  /// Whether the page is one of the daemon's.
  [[nodiscard]] bool is_live() const { return live_; }

 private:
  bool live_ = true;
  std::set<std::int64_t> with_section_;
  std::string pages_address_;
};

/// Where people say something of a loop's findings, ready for an attribute.
[[nodiscard]] std::string annotate_link(const std::string& loop_name);

}  // namespace loopscope::daemon
