#include "daemon/setup/check_databases.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "config/http_address.hpp"
#include "config/ip_network.hpp"
#include "daemon/service/historians/storage_settings.hpp"
#include "daemon/text/printable.hpp"
#include "daemon/text/shell_word.hpp"
#include "storage/historian/setup/check_historian.hpp"
#include "storage/historian/setup/check_writer.hpp"
#include "storage/results/schema/check_owner.hpp"

namespace loopscope::daemon {
namespace {

/// storage/ knows no files: its commands have an F there.
std::string with_file(std::string text, const std::string& file) {
  constexpr std::string_view kAnyFile = "--config F`";
  const std::size_t at = text.find(kAnyFile);
  return at == std::string::npos
             ? text
             : text.replace(at, kAnyFile.size(), "--config " + shell_word(file) + "`");
}

/// Prints what is found and keeps count.
class Report {
 public:
  explicit Report(const std::string& file) : file_(file) {}

  void add(const std::string& about, const std::vector<storage::Finding>& findings) {
    for (const storage::Finding& finding : findings) {
      const char* judgement = !finding.ok ? "PROBLEM" : finding.warning ? "warning" : "ok";
      std::cout << fmt::format("{:<8} {}: {}\n", judgement, printable(about),
                               printable(finding.what));
      if (!finding.hint.empty())
        std::cout << fmt::format("         HINT: {}\n", printable(with_file(finding.hint, file_)));
      if (!finding.ok) ++check_.problems;
      if (!finding.index_sql.empty()) check_.indexes.push_back(finding);
    }
  }
  [[nodiscard]] const DatabaseCheck& check() const { return check_; }

 private:
  const std::string& file_;
  DatabaseCheck check_;
};

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += ", " + name;
  return text;
}

/// The pages need no login: whoever reaches the address reads them.
std::vector<storage::Finding> check_http(const config::DaemonSettings& daemon) {
  const auto parsed = config::parse_http_address(daemon.http_address);
  if (!parsed) return {{true, "none", "", false}};
  const storage::Finding names{
      true, "answers to addresses and localhost" + joined(daemon.http_names), "", false};
  if (parsed->loopback)
    return {{true, daemon.http_address + ", for this host alone", "", false}, names};
  return {
      {true,
       daemon.http_address + " is not of the loopback: anyone who reaches it can read the pages",
       "write 127.0.0.1 or [::1] and let a proxy with a login stand before it, or guard the "
       "port by a firewall",
       true},
      names};
}

/// Wider than /8 of IPv4, /32 of IPv6: more than one site's own.
bool is_wide(const std::string& proxy) {
  constexpr int kBitsBeforeIpv4 = 96;
  const auto network = config::parse_ip_network(proxy);
  const auto ipv4 = config::parse_ip_network("::ffff:0:0/96");
  if (!network) return false;
  const bool is_ipv4 =
      network->bits >= kBitsBeforeIpv4 &&
      std::equal(ipv4->address.begin(), ipv4->address.begin() + 12, network->address.begin());
  return network->bits < (is_ipv4 ? kBitsBeforeIpv4 + 8 : 32);
}

void warn_of_wide_networks(const config::AcknowledgeSettings& acknowledge,
                           std::vector<storage::Finding>& findings) {
  for (const std::string& proxy : acknowledge.trusted_proxies) {
    if (is_wide(proxy))
      findings.push_back({true, proxy + " is a very wide network to trust",
                          "name the addresses of the proxies that sign people in", true});
  }
}

/// Who may write on the pages, and what makes that more than was meant.
std::vector<storage::Finding> check_acknowledge(const config::DaemonSettings& daemon) {
  const config::AcknowledgeSettings& acknowledge = daemon.acknowledge;
  if (!acknowledge.on()) return {};
  std::vector<storage::Finding> findings = {
      {true,
       "is on: who comes by" + joined(acknowledge.trusted_proxies).substr(1) + " is whom " +
           acknowledge.user_header + " names, and sees the pages under " + acknowledge.origin,
       "whatever runs at these addresses can write in anybody's name: a proxy that signs people in "
       "and always overwrites that header, nothing else",
       false}};
  const auto parsed = config::parse_http_address(daemon.http_address);
  if (parsed && !parsed->loopback)
    findings.push_back(
        {true, daemon.http_address + " can be reached from elsewhere than the proxies",
         "let a firewall admit the proxies alone, or write an address of the loopback "
         "and run the proxy on this host",
         true});
  if (acknowledge.origin.starts_with("http://"))
    findings.push_back({true,
                        acknowledge.origin + " is not encrypted: logins can be read on the way",
                        "let the proxy speak TLS, and write https:// here", true});
  warn_of_wide_networks(acknowledge, findings);
  return findings;
}

void check_historians(const config::Settings& settings, Report& report) {
  for (const config::HistorianSettings& historian : settings.historians) {
    report.add(
        "historian " + historian.name,
        storage::check_historian(historian_connection(historian), historian_layout(historian)));
    if (historian.writer_connection.empty()) continue;
    report.add(
        "import into " + historian.name,
        storage::check_writer(historian_writer_connection(historian), historian_layout(historian)));
  }
}

}  // namespace

DatabaseCheck check_databases(const config::Settings& settings, const std::string& settings_file,
                              storage::SchemaStage stage) {
  Report report(settings_file);
  report.add("HTTP", check_http(settings.daemon));
  report.add("acknowledging on the pages", check_acknowledge(settings.daemon));
  report.add("results database", storage::check_results(results_connection(settings), stage));
  if (!settings.results.owner_connection.empty())
    report.add("results database, owner", storage::check_owner(owner_connection(settings)));
  if (!settings.results.engineer_connection.empty()) {
    report.add("results database, engineer",
               storage::check_engineer(engineer_connection(settings), stage));
  }
  check_historians(settings, report);
  return report.check();
}

}  // namespace loopscope::daemon
