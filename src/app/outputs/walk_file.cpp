#include "app/outputs/walk_file.hpp"

#include "app/outputs/room_survey.hpp"

namespace enfilade {

std::string walk_page(const SolvedRun& run, const std::string& title, const RoomTable* table,
                      const std::string& program) {
  const SolvedScene solved = run.solved_scene();
  std::vector<SurveyRoom> rooms;
  if (table == nullptr) rooms = rooms_of_run(run);
  for (std::size_t i = 0; table != nullptr && i < table->rooms.size(); ++i)
    rooms.push_back(table->rooms[i].room);
  return walk_html({solved, title, rooms, table, run.patch_error()}, program);
}

}  // namespace enfilade
