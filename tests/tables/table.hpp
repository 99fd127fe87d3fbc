#pragma once
/// Tables of the READMEs: each is a function with a name, run by `tables NAME`.

#include <string>
#include <string_view>
#include <vector>

namespace loopscope::tables {

struct Table {
  std::string_view name;
  std::string_view about;
  void (*print)();
};

/// By name.
[[nodiscard]] std::vector<Table> all_tables();

/// Puts a table on the list, before main().
struct Registration {
  explicit Registration(const Table& table);
};

/// A figure that a table promises.
/// @throws std::runtime_error it does not hold
void require(bool holds, const std::string& promise);

}  // namespace loopscope::tables

/// A table's name and what it shows, followed by the body that prints it.
#define LOOPSCOPE_TABLE(name, about)                                                  \
  void name();                                                                        \
  const ::loopscope::tables::Registration name##_registered({#name, about, &(name)}); \
  void name()
