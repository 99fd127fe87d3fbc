#include "daemon/catalogue/on_behalf_of.hpp"

#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "storage/results/catalogue/annotations.hpp"
#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

constexpr const char* kOption = "--on-behalf-of";
/// For the strings of an entry of the system's users; a directory service may send long ones.
constexpr std::size_t kRoomForUser = 65536;

std::optional<std::string> system_user() {
  passwd entry{};
  passwd* found = nullptr;
  std::string room(kRoomForUser, '\0');
  if (getpwuid_r(getuid(), &entry, room.data(), room.size(), &found) != 0 || found == nullptr)
    return std::nullopt;
  return std::string(found->pw_name);
}

/// Of valid UTF-8.
std::size_t count_characters(std::string_view text) {
  std::size_t count = 0;
  while (!text.empty()) {
    text.remove_prefix(storage::first_character(text).length);
    ++count;
  }
  return count;
}

void require_name(const std::string& of, const std::string& name, const char* hint) {
  const std::string wrong = name_complaint(name);
  if (!wrong.empty()) throw Failure(ExitCode::usage, of + " " + wrong, hint);
}

}  // namespace

std::string name_complaint(const std::string& name) {
  if (name.empty()) return "is empty";
  if (printable(name) != name) return fmt::format("\"{}\" is not one line of printable text", name);
  if (name.front() == ' ' || name.back() == ' ')
    return fmt::format("\"{}\" has blanks around the name", name);
  const std::size_t characters = count_characters(name);
  if (characters > storage::kLongestOnBehalfOf)
    return fmt::format("has {} characters, {} are the most", characters,
                       storage::kLongestOnBehalfOf);
  return "";
}

std::optional<std::string> on_behalf_of(const std::optional<std::string>& said) {
  if (said) {
    require_name(kOption, *said,
                 "write the person's name, or leave the option out: then it is the operating "
                 "system's user who runs the command");
    return said;
  }
  std::optional<std::string> user = system_user();
  if (user)
    require_name("the name of the operating system's user", *user,
                 "name the person: --on-behalf-of NAME");
  return user;
}

}  // namespace loopscope::daemon
