#pragma once

#include <cstdint>
#include <string>

namespace loopscope::tests {

/// What Grafana's PostgreSQL source makes of the macros of a statement for the time range from
/// `from_s` to `to_s` (seconds since 1970): times and numbers as literals. A macro that is not
/// known here stays and makes the statement fail.
[[nodiscard]] std::string expand_macros(std::string statement, std::int64_t from_s,
                                        std::int64_t to_s);

/// The statement with `${variable:sqlstring}` replaced by the text as SQL writes it.
[[nodiscard]] std::string with_variable(std::string statement, const std::string& variable,
                                        const std::string& value);

}  // namespace loopscope::tests
