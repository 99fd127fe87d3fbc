#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loopscope::daemon {

/// Words for the roles of a loop that belong together: a vendor's, a language's. A loop's tags are
/// taken by the words of one convention.
struct NamingConvention {
  /// A role's words, plain_word(), by rank, the preferred ones first.
  using Ranks = std::vector<std::vector<std::string>>;

  std::string name;                                      ///< as a report says it: "X/W/Y"
  std::map<std::string, Ranks, std::less<>> words = {};  ///< by role
  /// Everyday words (X, Ist, actual value), which other things than controllers have as well: they
  /// count where sp, pv and op stand together, or two of them under the name of a controller.
  bool everyday = false;

  /// `list`: commas between ranks, bars between words of one rank: "SP,SPProg|SPOper".
  void set(std::string_view role, std::string_view list);
  /// Rank of a plain word among those of a role, 0 = preferred; nullopt = it is none of them.
  [[nodiscard]] std::optional<std::size_t> rank(std::string_view role, std::string_view word) const;

  /// By role, every word in lower case as it was set: "sp_wrk".
  std::map<std::string, std::vector<std::string>, std::less<>> spelled = {};
};

/// Conventions beside that of the settings, in the order in which they are preferred where two
/// fill the same roles.
[[nodiscard]] std::vector<NamingConvention> vendor_conventions();

}  // namespace loopscope::daemon
