#include "tests/support/tls_server.hpp"

#include <arpa/inet.h>
#include <stdexcept>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/run_program.hpp"

namespace loopscope::tests {
namespace {

/// One that nobody listens on at the moment.
int free_port() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  const bool bound =
      bind(listener, generic, size) == 0 && getsockname(listener, generic, &size) == 0;
  close(listener);
  if (!bound) throw std::runtime_error("no free port");
  return ntohs(address.sin_port);
}

ProgramResult run_script(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{(source_dir() / "tests/support/tls_postgres").string()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

}  // namespace

TlsServer::TlsServer() : folder_(parent_.path() / "server"), port_(free_port()) {
  // The server's user has to pass through.
  std::filesystem::permissions(parent_.path(), std::filesystem::perms::others_exec,
                               std::filesystem::perm_options::add);
  const ProgramResult started = run_script({"start", folder_.string(), std::to_string(port_)});
  if (started.exit_code != 0) throw std::runtime_error("no TLS server: " + started.err);
}

TlsServer::~TlsServer() {
  static_cast<void>(run_script({"stop", folder_.string()}));
}

std::string TlsServer::certificate(const std::string& name) const {
  return folder_ / "tls" / (name + ".crt");
}

std::string TlsServer::superuser() const {
  return "host=" + folder_.string() + " port=" + std::to_string(port_) +
         " user=postgres dbname=postgres";
}

void TlsServer::execute(const std::string& sql) const {
  const ProgramResult done =
      run_program({"/usr/bin/psql", "-Xq", "-v", "ON_ERROR_STOP=1", "-d", superuser(), "-c", sql});
  if (done.exit_code != 0) throw std::runtime_error(done.err);
}

void TlsServer::show_certificate(const std::string& name) const {
  const std::string file = (folder_ / "tls" / name).string();
  execute("ALTER SYSTEM SET ssl_key_file = '" + file + ".key'");
  reload("ssl_cert_file = '" + file + ".crt'");
}

void TlsServer::switch_tls(bool on) const {
  reload(on ? "ssl = on" : "ssl = off");
}

void TlsServer::reload(const std::string& setting) const {
  execute("ALTER SYSTEM SET " + setting);
  execute("SELECT pg_reload_conf()");
  // The postmaster reads it a moment later; only backends that start after that know it.
  usleep(300'000);
}

}  // namespace loopscope::tests
