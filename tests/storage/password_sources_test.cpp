#include "storage/password_sources.hpp"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>

#include "tests/support/environment.hpp"
#include "tests/support/source_dir.hpp"

namespace loopscope::storage {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using tests::EnvironmentVariable;

class PasswordSources : public testing::Test {
 protected:
  PasswordSources() : file_(folder_.path() / "pgpass") {
    std::ofstream(file_) << "*:*:*:*:geheim\n";
    permit(std::filesystem::perms::owner_read);
  }

  void permit(std::filesystem::perms permissions) const {
    std::filesystem::permissions(file_, permissions);
  }

  [[nodiscard]] static std::vector<Finding> found(const std::string& conninfo = "host=localhost") {
    ConnectionSettings settings;
    settings.conninfo = conninfo;
    settings.purpose = "results";
    std::vector<Finding> findings = check_password_sources(settings);
    for (const Finding& finding : findings) {
      EXPECT_TRUE(finding.ok && finding.warning);
      EXPECT_THAT(finding.what + finding.hint, Not(HasSubstr("geheim")));
    }
    return findings;
  }

  tests::TemporaryFolder folder_;
  std::string file_;
};

TEST_F(PasswordSources, AFileOfOnesOwnIsFine) {
  const EnvironmentVariable named("PGPASSFILE", file_);
  EXPECT_THAT(found(), IsEmpty());
  permit(std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(PasswordSources, AFileThatOthersMayReadIsIgnoredByLibpqAndThatIsSaid) {
  for (const auto other : {std::filesystem::perms::group_read, std::filesystem::perms::others_read,
                           std::filesystem::perms::group_write}) {
    permit(std::filesystem::perms::owner_read | other);
    const auto findings = found("host=localhost passfile=" + file_);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_THAT(findings[0].what, HasSubstr("is open to others, so it is ignored"));
    EXPECT_EQ(findings[0].hint, "chmod 0600 " + file_);
  }
}

TEST_F(PasswordSources, AFileThatIsNamedAndNotThere) {
  EXPECT_THAT(found("passfile=/nowhere/pgpass").at(0).what, HasSubstr("/nowhere/pgpass does not"));
  EXPECT_THAT(found("passfile=" + folder_.path().string()).at(0).what, HasSubstr("no plain file"));
  const EnvironmentVariable home("HOME", folder_.path());
  EXPECT_THAT(found(), IsEmpty()) << "nobody has to have a ~/.pgpass";
  const EnvironmentVariable named("PGPASSFILE", "/nowhere/else");
  EXPECT_THAT(found().at(0).what, HasSubstr("/nowhere/else does not"));
}

TEST_F(PasswordSources, AServiceFileWithAPasswordIsItsReadersAlone) {
  const std::string services = folder_.path() / "services";
  std::ofstream(services) << "[plant]\nhost=localhost\npassword=geheim\n[other]\nhost=db2\n";
  const EnvironmentVariable named("PGSERVICEFILE", services);
  const EnvironmentVariable passwords("PGPASSFILE", file_);
  std::filesystem::permissions(services, std::filesystem::perms(0640));
  ASSERT_EQ(found("service=plant").size(), 1U);
  EXPECT_THAT(found("service=plant")[0].what, HasSubstr(services + " holds a password"));
  EXPECT_THAT(found("host=localhost"), IsEmpty()) << "nobody asks for a service";
  std::filesystem::permissions(services, std::filesystem::perms(0600));
  EXPECT_THAT(found("service=plant"), IsEmpty());
  std::ofstream(services) << "[plant]\nhost=localhost\n";
  std::filesystem::permissions(services, std::filesystem::perms(0644));
  EXPECT_THAT(found("service=plant"), IsEmpty()) << "no secret in it";
}

TEST_F(PasswordSources, APasswordInTheEnvironmentWorksAndIsAdvisedAgainst) {
  const EnvironmentVariable named("PGPASSFILE", file_);
  const EnvironmentVariable password("PGPASSWORD", "geheim");
  EXPECT_THAT(found().at(0).what, HasSubstr("PGPASSWORD is set"));
}

}  // namespace
}  // namespace loopscope::storage
