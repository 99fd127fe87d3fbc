#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace loopscope::tests {

/// An environment variable with another value for as long as this lives. Other threads must not
/// look at the environment meanwhile.
class EnvironmentVariable {
 public:
  // NOLINTBEGIN(concurrency-mt-unsafe): as said above.
  EnvironmentVariable(const char* name, const std::string& value) : name_(name) {
    if (const char* former = std::getenv(name)) former_ = former;
    setenv(name, value.c_str(), 1);
  }
  ~EnvironmentVariable() {
    if (former_) {
      setenv(name_, former_->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  // NOLINTEND(concurrency-mt-unsafe)
  EnvironmentVariable(const EnvironmentVariable&) = delete;
  EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> former_;
};

}  // namespace loopscope::tests
