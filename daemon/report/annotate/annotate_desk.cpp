#include "daemon/report/annotate/annotate_desk.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "daemon/catalogue/annotation_wish.hpp"
#include "daemon/output/annotation_text.hpp"
#include "daemon/report/annotate/entry_text.hpp"
#include "daemon/report/page/page_answer.hpp"
#include "daemon/report/page/page_frame.hpp"
#include "daemon/report/page/template.hpp"
#include "daemon/report/text/loop_links.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/failure.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/time_text.hpp"
#include "storage/explain_error.hpp"
#include "storage/results/catalogue/catalogue.hpp"
#include "storage/results/reports/report_database.hpp"
#include "storage/utf8.hpp"

namespace loopscope::daemon {
namespace {

/// A person waits: a database that takes longer is one that does not answer.
constexpr int kPatience_s = 5;
/// Characters, as the form has it.
constexpr std::size_t kLongestReason = 500;
/// With `no-referrer` a browser would send "Origin: null" with the form.
constexpr const char* kReferrer = "same-origin";

constexpr std::array kKinds{std::pair{"acknowledge", "acknowledged"},
                            std::pair{"suppress", "suppressed"},
                            std::pair{"false-positive", "false_positive"}};

const AnnotationWords& words_of_the_page() {
  static const AnnotationWords words{"the verdict",
                                     "until",
                                     "the reason",
                                     "choose: whatever the verdict",
                                     "choose one that the form offers",
                                     minute_in_zone};
  return words;
}

storage::ConnectionSettings patient(const config::Settings& settings) {
  storage::ConnectionSettings connection = engineer_connection(settings);
  connection.connect_timeout_s = std::min(connection.connect_timeout_s, kPatience_s);
  connection.statement_timeout_s = kPatience_s;
  connection.network_timeout_s = kPatience_s;
  return connection;
}

Failure refused(const std::string& what, const std::string& hint) {
  return {ExitCode::usage, what, hint};
}

/// What the form asks for besides the rules of `annotate`.
AnnotationWish wish_of(const AnnotateForm& form) {
  const TypedAnnotation& typed = form.typed;
  const auto* kind =
      std::ranges::find_if(kKinds, [&](const auto& one) { return one.first == typed.deed; });
  if (kind == kKinds.end()) throw refused("nothing was chosen", "choose what is to be entered");
  if (typed.reason.empty())
    throw refused("the reason is empty", "say why, for those who ask later");
  const std::size_t characters = storage::count_characters(typed.reason);
  if (characters > kLongestReason)
    throw refused("the reason is too long",
                  fmt::format("it has {} characters, {} are the most", characters, kLongestReason));
  const bool suppresses = typed.deed == "suppress";
  if (suppresses && typed.until.empty())
    throw refused("no time was chosen", "choose the time until which it is off the list");
  if (!suppresses && !typed.until.empty())
    throw refused("a time ends a suppression alone", "suppress, or leave the time empty");
  return {form.loop, kind->second, typed.code, typed.until, typed.reason};
}

std::string database_trouble(const storage::DatabaseError& error) {
  spdlog::warn("not entered from a page: {} HINT: {}", printable(error.what()),
               printable(error.hint()));
  return error.sqlstate() == storage::kOutcomeUnknown
             ? "The connection broke while this was entered: whether it holds is said below, or "
               "when this page is loaded again."
             : "Nothing was entered: the results database did not take it. The log says why; "
               "what you typed is below.";
}

HttpAnswer go_to(const std::string& address) {
  HttpAnswer answer{303, "entered\n"};
  answer.headers.emplace("Location", address);  // everything of the name in it is %XX
  return answer;
}

/// false = there is no such loop.
bool read_facts(AnnotateFacts& facts, const storage::ConnectionSettings& connection) {
  facts.found = storage::ReportDatabase(connection).newest(facts.loop_name);
  if (!facts.found && !storage::Catalogue(connection).find(facts.loop_name)) return false;
  facts.in_force = storage::Annotations(connection).in_force(facts.loop_name);
  return true;
}

}  // namespace

std::optional<HttpAnswer> AnnotateDesk::open() {
  now_ = settings_();
  if (now_->daemon.acknowledge.on() && !now_->results.engineer_connection.empty())
    return std::nullopt;
  return HttpAnswer{404, "acknowledging from the page is off by now: nothing was entered\n"};
}

HttpAnswer AnnotateDesk::page_of(const AnnotateVisitor& visitor, const AnnotateForm& form,
                                 int status, const std::string& trouble) {
  AnnotateFacts facts;
  facts.loop_name = form.loop;
  facts.user = visitor.user;
  facts.trouble = trouble;
  facts.typed = form.typed;
  facts.zone = TimeZone(now_->plant.time_zone);
  PageFrame frame{form.loop, {"what people say of it"}, true, facts.zone.name()};
  frame.referrer = kReferrer;
  try {
    if (!read_facts(facts, patient(*now_)))
      return page_answer(404, page(frame, {render("no_such_loop", {{"name", form.loop}})}));
  } catch (const storage::DatabaseError&) {
    facts.away = true;
    status = std::max(status, 503);
  }
  if (!visitor.sees_nothing) {
    facts.told = users_.told(visitor.user, form.loop);
    facts.token = users_.new_token(visitor.user, form.loop);
  }
  return page_answer(status, page(frame, {annotate_section(facts)}), kReferrer);
}

HttpAnswer AnnotateDesk::show(const AnnotateVisitor& visitor, const std::string& loop) {
  if (auto closed = open()) return *std::move(closed);
  AnnotateForm form;
  form.loop = loop;
  return page_of(visitor, form, 200, "");
}

HttpAnswer AnnotateDesk::take(const AnnotateVisitor& visitor, const std::string& body) {
  if (auto closed = open()) return *std::move(closed);
  const std::optional<AnnotateForm> form = read_annotate_form(body);
  if (!form) return {400, "this is not what the form of a page sends\n"};
  if (!users_.take_token(visitor.user, form->loop, form->token))
    return page_of(
        visitor, *form, 403,
        "Nothing was entered: the page that you sent is too old, was used already, or is "
        "not yours. It was loaded again, with what you typed: look at it, and send it.");
  if (!users_.may_write(visitor.user)) {
    HttpAnswer answer = page_of(visitor, *form, 429,
                                fmt::format("Nothing was entered: more than {} entries within a "
                                            "minute. Wait a minute, and send it again.",
                                            FormUsers::kMostWrites));
    answer.headers.emplace("Retry-After", "60");
    return answer;
  }
  try {
    return carry_out(visitor, *form);
  } catch (const Failure& failure) {
    return page_of(visitor, *form, 422,
                   fmt::format("Nothing was entered: {}; {}.", failure.what(), failure.hint()));
  } catch (const storage::DatabaseError& error) {
    return page_of(visitor, *form, 503, database_trouble(error));
  }
}

HttpAnswer AnnotateDesk::carry_out(const AnnotateVisitor& visitor, const AnnotateForm& form) {
  return form.typed.deed == "withdraw" ? withdraw(visitor, form) : say(visitor, form);
}

HttpAnswer AnnotateDesk::say(const AnnotateVisitor& visitor, const AnnotateForm& form) {
  const TimeZone zone(now_->plant.time_zone);
  const AnnotationWish wish = wish_of(form);
  check_wish(wish, words_of_the_page(), zone);
  storage::Annotations annotations(patient(*now_));
  storage::Annotation annotation = annotation_meant(wish, words_of_the_page(), zone, annotations);
  annotation.on_behalf_of = visitor.user;
  const std::optional<storage::OthersInForce> others = annotations.add(annotation);
  if (!others) throw refused("the catalogue has no such loop", "it may have been removed");
  return after_commit(visitor, form.loop, annotations, [&] {
    spdlog::info("entered from a page: {}, by {}, proxy {}", annotation_line(annotation, {}),
                 printable(visitor.user), visitor.proxy);
    std::vector<std::string> told = others_told(*others, zone);
    told.insert(told.begin(), entered_sentence(annotation, zone));
    return told;
  });
}

HttpAnswer AnnotateDesk::withdraw(const AnnotateVisitor& visitor, const AnnotateForm& form) {
  storage::Annotations annotations(patient(*now_));
  const auto withdrawn = annotations.withdraw_one(form.loop, form.annotation_id, visitor.user);
  if (!withdrawn)
    throw refused("that does not hold any more", "what holds now is shown here, if anything does");
  return after_commit(visitor, form.loop, annotations, [&] {
    spdlog::info("withdrawn from a page: {}, by {}, proxy {}", annotation_line(*withdrawn, {}),
                 printable(visitor.user), visitor.proxy);
    return std::vector<std::string>{"Withdrawn."};
  });
}

/// What fails here, such as the question for the loop's page, refuses nothing: it is written.
HttpAnswer AnnotateDesk::after_commit(const AnnotateVisitor& visitor, const std::string& loop,
                                      storage::Annotations& annotations, const Sentences& told_of) {
  try {
    written_();
    const std::vector<std::string> sentences = told_of();
    users_.tell(visitor.user, loop, sentences);
    if (sentences.size() > 1 || !annotations.newest_code(loop)) return go_to(annotate_link(loop));
    static_cast<void>(users_.told(visitor.user, loop));  // the loop's page shows it
    return go_to(LoopLinks::pages().to_page(loop));
  } catch (const std::exception& error) {
    spdlog::warn("entered from a page, and its answer was cut short: {}", printable(error.what()));
    return go_to(annotate_link(loop));
  }
}

}  // namespace loopscope::daemon
