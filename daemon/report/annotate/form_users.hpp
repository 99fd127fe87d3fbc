#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace loopscope::daemon {

/// What is kept in memory of those who fill in forms: the tokens of the pages that they have open,
/// how much they wrote lately, and what they are still to be told. Bounded, and each user has a
/// share of his own, so that none pushes out what belongs to another; of many users the one who was
/// away longest is forgotten. For one thread at a time.
class FormUsers {
 public:
  using Clock = std::chrono::steady_clock;

  static constexpr std::chrono::minutes kTokenLife{30};
  static constexpr std::size_t kMostTokens = 32;  ///< of a user: pages that he has open
  /// Entries of a user in kWriteSpan. A person reads, types a reason and presses a button: not
  /// thirty times a minute. A script behind the proxy adds 43 200 rows a day at most, each with a
  /// line of the log.
  static constexpr std::size_t kMostWrites = 30;
  static constexpr std::chrono::minutes kWriteSpan{1};
  static constexpr std::size_t kMostUsers = 256;

  explicit FormUsers(std::function<Clock::time_point()> now = Clock::now) : now_(std::move(now)) {}

  /// For one form of that user about that loop: 64 hexadecimal digits out of the system's random
  /// numbers. Throws std::system_error when it has none.
  [[nodiscard]] std::string new_token(const std::string& user, const std::string& loop);
  /// Whether it is one of that user and loop, not aged; it counts once.
  [[nodiscard]] bool take_token(const std::string& user, const std::string& loop,
                                const std::string& token);
  /// Whether he may write once more now, which counts.
  [[nodiscard]] bool may_write(const std::string& user);
  /// What is to be said on his next page of the loop, once.
  void tell(const std::string& user, const std::string& loop, std::vector<std::string> sentences);
  [[nodiscard]] std::vector<std::string> told(const std::string& user, const std::string& loop);

 private:
  struct Token {
    std::string text, loop;
    Clock::time_point made_at;
  };
  struct User {
    std::deque<Token> tokens;              ///< oldest first
    std::deque<Clock::time_point> writes;  ///< oldest first
    std::string told_of;                   ///< loop
    std::vector<std::string> sentences;
    Clock::time_point seen_at;
  };

  User& user_of(const std::string& name);

  std::function<Clock::time_point()> now_;
  std::map<std::string, User> users_;
};

}  // namespace loopscope::daemon
