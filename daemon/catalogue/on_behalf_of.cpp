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

/// Blanks of Unicode, and what shows nothing: a name with one would pass for another name.
constexpr std::u32string_view kBlanks =
    U" \u00A0\u1680\u2000\u2001\u2002\u2003\u2004\u2005\u2006\u2007\u2008\u2009\u200A\u202F\u205F"
    U"\u3000";
constexpr std::u32string_view kFillers = U"\u00AD\u034F\u115F\u1160\u17B4\u17B5\u2800\u3164\uFFA0";

std::u32string characters_of(std::string_view text) {
  std::u32string characters;
  while (!text.empty()) {
    const storage::Character first = storage::first_character(text);
    characters += first.code;
    text.remove_prefix(first.length);
  }
  return characters;
}

void require_name(const std::string& of, const std::string& name, const char* hint) {
  const std::string wrong = name_complaint(name);
  if (!wrong.empty()) throw Failure(ExitCode::usage, of + " " + wrong, hint);
}

}  // namespace

std::string name_complaint(const std::string& name) {
  if (name.empty()) return "is empty";
  if (printable(name) != name) return fmt::format("\"{}\" is not one line of printable text", name);
  const std::u32string characters = characters_of(name);
  if (kBlanks.find(characters.front()) != kBlanks.npos ||
      kBlanks.find(characters.back()) != kBlanks.npos)
    return fmt::format("\"{}\" has blanks around the name", name);
  if (characters.find_first_of(kFillers) != characters.npos)
    return fmt::format("\"{}\" has characters that show nothing", name);
  if (characters.size() > storage::kLongestOnBehalfOf)
    return fmt::format("has {} characters, {} are the most", characters.size(),
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
