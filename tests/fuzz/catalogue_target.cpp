// Loops for the catalogue as CSV: any text is refused with a place and a hint, or becomes entries
// that come back when they are written.

#include "daemon/catalogue/catalogue_csv.hpp"
#include "daemon/catalogue/entry_fields.hpp"
#include "tests/fuzz/require.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/fuzz/text_target.hpp"

namespace loopscope::tests::fuzz {
namespace {

void check_catalogue(std::string_view text) {
  const auto entries = daemon::parse_catalogue(daemon::parse_csv(text, "loops.csv"), {}, {});
  for (const storage::CatalogueEntry& entry : entries) daemon::check_entry(entry);
  const std::string written = daemon::catalogue_csv(entries);
  const auto again = daemon::parse_catalogue(daemon::parse_csv(written, "again"), {}, {});
  require(again.size() == entries.size(), "every loop comes back");
  for (std::size_t k = 0; k < entries.size(); ++k)
    for (const daemon::EntryField& field : daemon::entry_fields())
      require(field.read(again[k]) == field.read(entries[k]), "every field comes back");
}

}  // namespace

int fuzz_catalogue(const std::uint8_t* data, std::size_t size) {
  return check_as_text(data, size, [](const auto& text) { check_catalogue(text); });
}

}  // namespace loopscope::tests::fuzz
