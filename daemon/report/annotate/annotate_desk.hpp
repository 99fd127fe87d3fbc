#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "daemon/monitor/http_answer.hpp"
#include "daemon/report/annotate/annotate_form.hpp"
#include "daemon/report/annotate/form_users.hpp"
#include "daemon/text/time_zone.hpp"
#include "storage/results/catalogue/annotations.hpp"

namespace loopscope::daemon {

/// Who is at the desk.
struct AnnotateVisitor {
  std::string user;           ///< as the proxy says
  std::string proxy;          ///< its address
  bool sees_nothing = false;  ///< HEAD: no token is made, and what is to be told waits
};

/// The page on which people speak of a loop's findings, and what comes of its form: one annotation
/// added or withdrawn by the login of engineer_connection, in the name of who is signed in, by the
/// rules of `loopscope annotate`. What is refused
/// here leaves everything as it is, and what was typed stands in the form again. What was entered
/// is never called refused, whatever fails afterwards. For one thread at a time, which waits for
/// the database.
class AnnotateDesk {
 public:
  using Settings = std::shared_ptr<const config::Settings>;
  using Sentences = std::function<std::vector<std::string>()>;

  /// `settings` is asked for each request: those in force. `written` is called after each change.
  AnnotateDesk(std::function<Settings()> settings, std::function<void()> written)
      : settings_(std::move(settings)), written_(std::move(written)) {}

  /// 200, 404 for an unknown loop and while acknowledging is off, as below, 503 when the results
  /// are away.
  [[nodiscard]] HttpAnswer show(const AnnotateVisitor& visitor, const std::string& loop);
  /// 303 when it is done, to the loop's page, or back to this one where there is something to
  /// tell: whose words the new ones replace. 400 for no form of ours, 403 for a token that is not
  /// (or no more) one of this user and loop, 422 for what `annotate` refuses, 429 for too many, 503
  /// when the results are away.
  [[nodiscard]] HttpAnswer take(const AnnotateVisitor& visitor, const std::string& body);

 private:
  /// Takes the settings of this request; what to answer where they let nobody write.
  [[nodiscard]] std::optional<HttpAnswer> open();
  [[nodiscard]] HttpAnswer page_of(const AnnotateVisitor& visitor, const AnnotateForm& form,
                                   int status, const std::string& trouble);
  [[nodiscard]] HttpAnswer carry_out(const AnnotateVisitor& visitor, const AnnotateForm& form);
  [[nodiscard]] HttpAnswer say(const AnnotateVisitor& visitor, const AnnotateForm& form);
  [[nodiscard]] HttpAnswer withdraw(const AnnotateVisitor& visitor, const AnnotateForm& form);
  /// 303 in any case. The first sentence says what was done; it is told where no other page shows
  /// it, or there are more.
  [[nodiscard]] HttpAnswer after_commit(const AnnotateVisitor& visitor, const std::string& loop,
                                        storage::Annotations& annotations,
                                        const Sentences& told_of);

  std::function<Settings()> settings_;
  std::function<void()> written_;
  Settings now_;  ///< those of the request that is answered
  FormUsers users_;
};

}  // namespace loopscope::daemon
