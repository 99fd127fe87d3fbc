#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// What somebody says of a loop's verdict; while it holds, the loop is not in flagged_loop.
struct Annotation {
  std::string loop_name;
  std::string kind;                      ///< acknowledged, suppressed or false_positive
  std::optional<std::string> code;       ///< the verdict that it is about; nullopt = whatever
  std::optional<std::int64_t> until_us;  ///< nullopt = until it is withdrawn; suppressed has one
  std::string reason;                    ///< may be empty, but where it is suppressed
  // As the server notes it; add() takes neither.
  std::string author;              ///< the login
  std::int64_t entered_at_us = 0;  ///< microseconds UTC since 1970, as until_us
  /// In whose name, as the login says; nullopt = in its own. What may stand there:
  /// kLongestOnBehalfOf.
  std::optional<std::string> on_behalf_of = std::nullopt;
  std::int64_t annotation_id = 0;  ///< the server's number of it; add() takes none
};

/// Characters of the name of those for whom something is entered; one line of printable text
/// without blanks around it. The database refuses another.
inline constexpr std::size_t kLongestOnBehalfOf = 200;

/// What holds of a loop besides what was just said of it.
struct OthersInForce {
  std::vector<Annotation> replaced;  ///< held until now, and are withdrawn
  std::vector<Annotation> beside;    ///< hold on: of another kind, or about another verdict
};

/// What people say about findings. The rights of loopscope_engineer are enough; who said it is the
/// login of the connection. Every function is one transaction and throws DatabaseError. Not shared
/// between threads.
class Annotations {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit Annotations(const ConnectionSettings& settings);
  ~Annotations();

  /// Those that hold now, by loop.
  [[nodiscard]] std::vector<Annotation> in_force();
  /// Those of one loop, oldest first; empty for an unknown loop too.
  [[nodiscard]] std::vector<Annotation> in_force(const std::string& loop_name);
  /// Adds it and withdraws, in the same name, those of its kind about the same verdict of the same
  /// loop that it takes the place of. Returns these and what stands beside it, each oldest first;
  /// nullopt = there is no such loop.
  std::optional<OthersInForce> add(const Annotation& annotation);
  /// Withdraws what holds of the loop: all, or what is about `code`. Returns how many; 0 for an
  /// unknown loop too.
  std::size_t withdraw(const std::string& loop_name, const std::optional<std::string>& code,
                       const std::optional<std::string>& on_behalf_of = std::nullopt);
  /// Withdraws one that holds of the loop and returns it; nullopt = it does not hold, or is of
  /// another loop.
  std::optional<Annotation> withdraw_one(const std::string& loop_name, std::int64_t annotation_id,
                                         const std::optional<std::string>& on_behalf_of);
  /// The newest verdict of the loop; nullopt = it was never analysed, or there is none.
  [[nodiscard]] std::optional<std::string> newest_code(const std::string& loop_name);
  /// Every verdict that somebody should act on, by code.
  [[nodiscard]] std::vector<std::string> fault_codes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
