#include "app/outputs/plan_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/atomic_file.hpp"
#include "base/posix_file.hpp"

namespace enfilade {

std::string plan_content(const FloorPlan& plan, const std::string& path) {
  if (path.ends_with(".svg")) return to_svg(plan.drawing);
  return encode_png(to_bitmap(plan.drawing), plan.title);
}

std::string numbered_path(const std::string& path, int number) {
  const std::filesystem::path whole(path);
  const std::string name =
      fmt::format("{}-{}{}", whole.stem().string(), number, whole.extension().string());
  return (whole.parent_path() / name).string();
}

void write_run_plans(const std::string& run_directory, std::span<const FloorPlan> plans) {
  make_directory(run_directory + "/pictures");
  for (const FloorPlan& plan : plans) {
    for (const char* ending : {".svg", ".png"}) {
      const std::string path = fmt::format("{}/pictures/storey-{}-{}{}", run_directory, plan.storey,
                                           plan.subject, ending);
      write_file_atomically(path, plan_content(plan, path));
    }
  }
}

}  // namespace enfilade
