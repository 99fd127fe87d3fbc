#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "storage/catalogue_entry.hpp"
#include "storage/connection_settings.hpp"
#include "storage/error.hpp"

namespace loopscope::storage {

/// What became of entries that were saved.
struct SavedLoops {
  std::size_t added = 0;
  std::size_t changed = 0;
  std::size_t unchanged = 0;  ///< the catalogue had them as they are

  bool operator==(const SavedLoops&) const = default;
};

/// The loop catalogue: lists, adds and changes loops. Every function is one transaction and throws
/// DatabaseError. Not shared between threads.
class Catalogue {
 public:
  /// Connects and checks that the schema has the version this program was built for.
  explicit Catalogue(const ConnectionSettings& settings);
  ~Catalogue();

  /// Enabled or not, by name.
  [[nodiscard]] std::vector<CatalogueEntry> list();
  /// nullopt = there is no such loop.
  [[nodiscard]] std::optional<CatalogueEntry> find(const std::string& name);
  /// Inserts the loops, or changes those whose name exists; makes each due at once (one that a
  /// worker holds: when the worker is done). All or nothing: text that is no UTF-8, a name that
  /// stands twice and a value out of range are refused (give_up).
  SavedLoops save(std::span<const CatalogueEntry> entries);
  /// Reads all loops and saves what `edit` returns, so that nobody changes them in between; those
  /// it leaves out stay. What it throws passes through, and nothing is changed.
  SavedLoops change(
      const std::function<std::vector<CatalogueEntry>(const std::vector<CatalogueEntry>&)>& edit);
  /// Returns how many loops of these names were switched, those that were so already left out.
  std::size_t set_enabled(std::span<const std::string> names, bool enabled);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace loopscope::storage
