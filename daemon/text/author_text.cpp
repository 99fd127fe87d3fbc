#include "daemon/text/author_text.hpp"

#include <fmt/format.h>

namespace loopscope::daemon {

std::string author_text(const std::string& login, const std::optional<std::string>& on_behalf_of) {
  if (!on_behalf_of || *on_behalf_of == login) return login;
  return fmt::format("{} (login {})", *on_behalf_of, login);
}

}  // namespace loopscope::daemon
