#include "daemon/report/annotate/form_users.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace loopscope::daemon {
namespace {

constexpr std::size_t kTokenBytes = 32;

std::string random_token() {
  std::array<unsigned char, kTokenBytes> bytes{};
  if (getentropy(bytes.data(), bytes.size()) != 0)
    throw std::system_error(errno, std::generic_category(), "random numbers");
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 0xFU];
  }
  return token;
}

/// In a time that does not depend on where they differ.
bool are_equal(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  int difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= a[i] ^ b[i];
  return difference == 0;
}

}  // namespace

FormUsers::User& FormUsers::user_of(const std::string& name) {
  if (users_.size() >= kMostUsers && !users_.contains(name)) {
    users_.erase(std::ranges::min_element(users_, {},
                                          [](const auto& entry) { return entry.second.seen_at; }));
  }
  User& user = users_[name];
  user.seen_at = now_();
  std::erase_if(user.tokens,
                [&](const Token& token) { return user.seen_at - token.made_at > kTokenLife; });
  return user;
}

std::string FormUsers::new_token(const std::string& user, const std::string& loop) {
  User& who = user_of(user);
  if (who.tokens.size() >= kMostTokens) who.tokens.pop_front();
  who.tokens.push_back({random_token(), loop, who.seen_at});
  return who.tokens.back().text;
}

bool FormUsers::take_token(const std::string& user, const std::string& loop,
                           const std::string& token) {
  return std::erase_if(user_of(user).tokens, [&](const Token& one) {
           return are_equal(one.text, token) && one.loop == loop;
         }) > 0;
}

bool FormUsers::may_write(const std::string& user) {
  User& who = user_of(user);
  std::erase_if(who.writes, [&](Clock::time_point at) { return who.seen_at - at >= kWriteSpan; });
  if (who.writes.size() >= kMostWrites) return false;
  who.writes.push_back(who.seen_at);
  return true;
}

void FormUsers::tell(const std::string& user, const std::string& loop,
                     std::vector<std::string> sentences) {
  User& who = user_of(user);
  who.told_of = loop;
  who.sentences = std::move(sentences);
}

std::vector<std::string> FormUsers::told(const std::string& user, const std::string& loop) {
  User& who = user_of(user);
  if (who.told_of != loop) return {};
  return std::exchange(who.sentences, {});
}

}  // namespace loopscope::daemon
