#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace loopscope::daemon {

/// Under which names this server may be asked for. A page of somebody else's that runs in a
/// browser reaches this host when its own name is made to mean this host's address (DNS rebinding);
/// the browser then sends that name as Host, so a name that nobody has entered is refused.
/// Addresses and `localhost` cannot be made to mean another host.
class HostNames {
 public:
  explicit HostNames(std::vector<std::string> names = {}) : names_(std::move(names)) {}

  /// Whether the header Host, a name or address with or without a port, is one of them.
  [[nodiscard]] bool contain(std::string_view host) const;

 private:
  std::vector<std::string> names_;
};

}  // namespace loopscope::daemon
