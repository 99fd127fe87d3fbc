#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "daemon/catalogue/naming_convention.hpp"
#include "storage/catalogue_entry.hpp"

namespace loopscope::daemon {

/// A tag that may have a role in a loop.
struct TagCandidate {
  std::string tag;
  std::string word;    ///< plain_word()
  std::string loop;    ///< the loop's name as this tag spells it
  std::string shape;   ///< the tag but for loop and word, lower case: ".pida.{}"; "" = not known
  bool glued = false;  ///< nothing stands between the name and the word
};

/// Several tags for one role of a loop, or a tag that several loops could have.
struct AmbiguousRole {
  std::string loop;
  std::string role;
  std::vector<std::string> tags;
  std::string taken;  ///< by the order of the words, or as the others are named; empty = none
};

/// The tags of one loop by role.
struct RoleAssignment {
  storage::CatalogueEntry entry;  ///< name and tags
  std::vector<AmbiguousRole> ambiguous;
  /// A word that stands for two roles (MV: manipulated variable here, valve position there) was
  /// taken for the first role that nothing else fills.
  bool by_shared_word = false;
  const NamingConvention* convention = nullptr;  ///< by which the tags were taken; not null
  bool one_shape = true;  ///< sp, pv and op differ in nothing but their words
  bool glued = false;     ///< one of them is glued to the name

  [[nodiscard]] std::size_t signals() const;  ///< how many of sp, pv and op there are, 0 to 3
};

/// By the convention that fills most of sp, pv and op, then most roles; of equal ones the first.
/// `candidates` and `conventions` are not empty; the result points into the latter.
[[nodiscard]] RoleAssignment assign_roles(std::span<const TagCandidate> candidates,
                                          std::span<const NamingConvention> conventions);

}  // namespace loopscope::daemon
