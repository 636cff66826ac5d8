#include "app/outputs/walk_file.hpp"

#include <filesystem>

#include "run/light_shares.hpp"

namespace enfilade {
namespace {

std::string name_of_run(const std::string& run_directory) {
  std::filesystem::path directory = std::filesystem::path(run_directory).lexically_normal();
  if (!directory.has_filename()) directory = directory.parent_path();
  return directory.filename().string();
}

}  // namespace

std::string walk_page(const SolvedRun& run, RunRooms& rooms, const std::string& run_directory,
                      const RoomTable* table, const std::string& program) {
  const SolvedScene solved = run.solved_scene();
  WalkSubject subject{solved, name_of_run(run_directory), rooms.all(), rooms.views(), table,
                      {},     run.patch_error()};
  LightShares shares;
  if (read_share_index(run_directory))
    shares = read_light_shares(run_directory, run.prepared(), solved.states);
  subject.shares.of_light.assign(solved.scene.lights.size(), shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    subject.shares.names.push_back(shares.groups[i].name);
    for (const std::size_t light : shares.groups[i].lights) subject.shares.of_light[light] = i;
  }
  subject.shares.clusters = shares.clusters;
  return walk_html(subject, program);
}

}  // namespace enfilade
