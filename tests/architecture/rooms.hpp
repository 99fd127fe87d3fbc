#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace loopscope::tests::architecture {

/// A room of the house and what it may use.
struct Room {
  std::string_view path;
  std::vector<std::string_view> rooms;      ///< besides itself: only rooms on lower floors
  std::vector<std::string_view> libraries;  ///< by the names of kLibraries
  /// No I/O, clock, log, thread or hidden randomness: of the standard library only what computes.
  bool pure = false;
  bool operating_system = false;  ///< POSIX headers
};

/// A header that one file may include against the rule, and why.
struct Exception {
  std::string_view file;
  std::string_view header;
  std::string_view reason;
};

/// Whether a path lies below a folder.
[[nodiscard]] bool lies_below(std::string_view path, std::string_view folder);

/// The room that a file or rooted header stands in; nullptr when it is in none.
[[nodiscard]] const Room* room_of(std::string_view path);

/// The third-party library that a header belongs to; empty when it belongs to none.
[[nodiscard]] std::string_view library_of(std::string_view header);

/// Whether a standard header only computes: no I/O, clock, thread, environment.
[[nodiscard]] bool is_pure_header(std::string_view header);

[[nodiscard]] std::span<const Exception> exceptions();

}  // namespace loopscope::tests::architecture
