#include "storage/historian/setup/check_foreign.hpp"

#include <string>
#include <vector>

#include "storage/historian/foreign_plan.hpp"

namespace loopscope::storage {
namespace {

Finding conditions(const std::vector<ForeignScan>& scans, const std::string& relation) {
  for (const ForeignScan& scan : scans) {
    if (scan.filter.empty()) continue;
    return {true,
            "the other server sends rows that are thrown away here, by " + scan.filter + ", " +
                relation,
            "declare the columns of the foreign table with the types that they have there "
            "(timestamp for DATETIME), and keep conversions of tag and time out of views",
            true};
  }
  return {true, "tag and times of a window are looked up by the other server, " + relation, "",
          false};
}

Finding limit(const std::vector<ForeignScan>& scans, const std::string& relation) {
  const std::string& sent = scans.front().sent;
  if (sent.find(" LIMIT ") != std::string::npos || sent.find(" TOP ") != std::string::npos)
    return {true, "for a window the other server is asked: " + sent + ", " + relation, "", false};
  return {true,
          "the other server sends every row of a window's span, which is ordered and cut here: " +
              (sent.empty() ? "its wrapper does not say what it sends" : sent) + ", " + relation,
          "no harm where a window's span holds no more rows than the window wants", false};
}

}  // namespace

std::vector<Finding> check_foreign(const PqRows& plan, const std::string& relation) {
  const std::vector<ForeignScan> scans = foreign_scans(plan);
  // Every partition that a plan could have was left out.
  if (scans.empty()) return {};
  return {conditions(scans, relation), limit(scans, relation)};
}

}  // namespace loopscope::storage
