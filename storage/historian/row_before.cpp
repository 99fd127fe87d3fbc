#include "storage/historian/row_before.hpp"

#include "storage/historian/scan.hpp"
#include "storage/historian/scan_sql.hpp"

namespace loopscope::storage::historian_statements {
namespace {

std::string before_span(const ResolvedLayout& layout) {
  return layout.time + " < " + bound_sql(layout, "request.from_time");
}

/// As in a series: of rows with one time the largest value counts where nothing tells them apart.
std::string ties(const ResolvedLayout& layout) {
  return layout.tiebreak.empty() ? ", u.value DESC NULLS LAST" : "";
}

std::string row_of(const ResolvedLayout& layout, const std::string& value) {
  return order_of(layout).columns + time_sql(layout) + " AS time, " + value + " AS value";
}

/// WHERE of one of the growing spans before a request's.
std::string before_within(const ResolvedLayout& layout, std::size_t span,
                          const std::string& value) {
  return key_is_requested(layout) + layout.time +
         " >= " + bound_sql(layout, "request.before_" + std::to_string(span)) + " AND " +
         before_span(layout) + has_value(layout, value);
}

/// As before_elsewhere() for who cannot be sent the newest time: the rows of a span are settled
/// here.
std::string before_by_constants(const ResolvedLayout& layout,
                                const std::vector<std::string>& relations,
                                const std::string& value) {
  std::string spans;
  for (std::size_t k = 0; k < kGrowingSpans_us.size(); ++k) {
    spans += (k == 0 ? "" : " UNION ALL ") +
             ("(SELECT u.time, u.value FROM " +
              fenced(all_of(relations, row_of(layout, value), before_within(layout, k, value))) +
              " AS u ORDER BY " + order_of(layout).newest_first + ties(layout) + " LIMIT 1)");
  }
  return "SELECT n.time, n.value FROM (" + spans + ") AS n LIMIT 1";
}

std::string newest_of_spans(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                            const std::string& value) {
  std::string spans;
  for (std::size_t k = 0; k < kGrowingSpans_us.size(); ++k) {
    spans += (k == 0 ? "" : " UNION ALL ") +
             ("(SELECT u.o0 FROM " +
              all_of(relations, layout.time + " AS o0", before_within(layout, k, value)) +
              " AS u ORDER BY u.o0 DESC LIMIT 1)");
  }
  return "SELECT n.o0 FROM (" + spans + ") AS n LIMIT 1";
}

/// The newest time before each request's span, as the column has it. That a value has to be there
/// is not in the index of the other server: it would read the year for the largest time.
std::string newest_time_elsewhere(const ResolvedLayout& layout,
                                  const std::vector<std::string>& relations,
                                  const std::string& value) {
  if (!layout.largest_elsewhere || layout.layout.null_is_absent)
    return newest_of_spans(layout, relations, value);
  const std::string within = before_within(layout, kGrowingSpans_us.size() - 1, value);
  return "SELECT n.o0 FROM (" + largest_time(layout, relations, within) +
         ") AS n WHERE n.o0 IS NOT NULL";
}

// Only the order of the times goes over to the other server: mysql_fdw offers a CASE for ordering
// and then fails to write it, and pushes FETCH FIRST ... WITH TIES as if it were LIMIT. So the rows
// of the newest time are fetched and settled here. Nothing lies between the newest time and the
// span, so that they are all that lies from there to the span: an equality would miss them where
// a parameter loses its fraction of a second on the way, as in mysql_fdw.
std::string before_elsewhere(const ResolvedLayout& layout,
                             const std::vector<std::string>& relations, const std::string& value) {
  const std::string within = key_is_requested(layout) + layout.time + " >= newest.o0 AND " +
                             before_span(layout) + has_value(layout, value);
  return "SELECT u.time, u.value FROM (" + newest_time_elsewhere(layout, relations, value) +
         ") AS newest CROSS JOIN LATERAL " +
         fenced(all_of(relations, row_of(layout, value), within)) + " AS u ORDER BY " +
         order_of(layout).newest_first + ties(layout) + " LIMIT 1";
}

/// The newest row of one column before each request's span.
std::string before_sql(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                       const std::string& value) {
  if (!layout.parameters_elsewhere) return before_by_constants(layout, relations, value);
  if (layout.foreign) return before_elsewhere(layout, relations, value);
  const std::string within = key_is_requested(layout) + layout.time +
                             " >= " + bound_sql(layout, "request.before_time") + " AND " +
                             before_span(layout) + has_value(layout, value);
  return "SELECT u.time, u.value FROM " + all_of(relations, row_of(layout, value), within) +
         " AS u ORDER BY " + order_of(layout).newest_first + ties(layout) + " LIMIT 1";
}

}  // namespace

RowsBefore rows_before(const ResolvedLayout& layout, const std::vector<std::string>& relations,
                       const std::vector<ScanColumn>& columns) {
  RowsBefore before;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!columns[k].before) continue;
    const std::string name = "b" + std::to_string(k);
    before.columns += ", " + name + ".time, " + name + ".value";
    before.joins += " LEFT JOIN LATERAL (" + before_sql(layout, relations, columns[k].value) +
                    ") AS " + name + " ON true";
  }
  return before;
}

}  // namespace loopscope::storage::historian_statements
