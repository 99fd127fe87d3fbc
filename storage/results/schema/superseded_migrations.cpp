#include "storage/results/schema/superseded_migrations.hpp"

#include <array>

namespace loopscope::storage {
namespace {

// A database holds these words: they never change.
constexpr std::array kChain = std::to_array<SupersededMigration>({
    {"0001_catalogue", "3997078d4b37215ad1ef75a4f38cc54e078827fdb33d519193956f4590584ac5"},
    {"0002_results", "d7477d3dd7360f2efd8d11b4091ea9e85a4ae21502945c4211ff10572302b90d"},
    {"0003_result_comments", "141663928b6518d23510f5da115fd71dbd6aae934a5014bd36fb9d84d773dffa"},
    {"0004_plant_and_people", "e2c028019f3cef7d724cc388b2af1b1c8093d021a075216376a013be967534f9"},
    {"0005_partitions", "c5ff70264f0c294ed7098421d07493191b853cbf90c8f48a1a1227cdb52f37e0"},
    {"0006_views", "549b19667845274a370255aec35cbc3252f6b8f74b07f1b2268ad9171eef7075"},
    {"0007_rights", "24f6ef548ea9ac79f75ec67c55c7b9f0d0c2f66aa53c8c6149a496b9a652e723"},
    {"0008_late_data", "893b8cc8faf7728be9e2d576f6e3f97e1efb3d9c8f07d6e03c269595769cc840"},
    {"0009_data_problems", "804ab6acb93426431604e7c018fa82f7c0c9fb0ab83ca21fc1e431f18917462d"},
    {"0010_refused_tests", "2efe590b23cb59d275204370fd6faec3e03b8b0f064c277aef2ef4f8c704cfb7"},
    {"0011_stage_cost", "b0328323bc71f118725bcae8d170f6545cac02b709c9fe1c6a83e5887f9471c8"},
    {"0012_unattended", "ec3adb7b10bb66ef89c012e42e196fc70ee852481a6be3fefef528f42cf4eada"},
    {"0013_repairs", "f24c9d853f793474dc238243ce1b11e4a32128114dea756a278c9dc465044011"},
    {"0014_findings", "db8961b5f003c1d6beb5c99b83197729e29c05fed7b27be9b03126e2e3afef77"},
    {"0015_defaults", "f3eb98c2ced4dbd7294e9a8d6121866de2a81638746059e56d8fb4bee8e54356"},
    {"0016_rights_and_locks", "1d8e2a93f843f70fe8def9b6bc3bdd57a8c10c23c097c18bf6ce0d7a0ec35a98"},
    {"0017_clocks", "cc391d2e4dc91dfe19f68e3fc9be94dd907fb3583b1d51781010febaac0fa6ff"},
    {"0018_old_snapshots", "a0ee91f710a5ab5357316bb1adce69623c057653a4258330ca9d8453a741f49c"},
    {"0019_plant_noise", "1ac8edb22840710b0ddac2b62c23aed2c84ed74f0e0da612b473affa2052df5b"},
    {"0020_asked_by", "52bb2a593e179a03f9438705fc15e0a2c56fbc644d491beb1e77938fabc21f52"},
    {"0021_causes", "cbb13a895a6ceeb9f5a126fa00ecd46ddad61f049e8961d4fe28955ee71be4bd"},
    {"0022_combined", "cbec0e63cc5bd26969dd897fc1019c87c0813f0b241161d97efc474b35d14603"},
    {"0023_states", "e21e5463d034ef7ebde56999e9f96d7c27671141d140aa397a162d1edb6d6d25"},
    {"0024_standing_list", "c97f5b0197068ca3edf6c202b9859cbf56640b25a7dc92a4151eadecc6468518"},
    {"0025_list_memory", "291d8b611a9a29f9e8f71bde9aab52e74b40285b999399c07599d9f57742d373"},
    {"0026_list_leave", "043e16848b9ce67ebdddd6a86da2c002c3bf162ecd2631e7385eed441ec91aa3"},
    {"0027_plant_box", "3ad9fe7fe1a22e03d5d5f6cccd59433c9fffbb77d4ec3f332780abc24293216a"},
});

}  // namespace

std::span<const SupersededMigration> superseded_migrations() {
  return kChain;
}

}  // namespace loopscope::storage
