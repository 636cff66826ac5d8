// Writes scenes and files so that a reader never meets half of one.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "scene/scene_io.hpp"

namespace enfilade {
namespace {

using nlohmann::ordered_json;

ordered_json list_of(const Vec3& p) { return ordered_json::array({p.x, p.y, p.z}); }

[[noreturn]] void fail_to_write(const std::string& path) {
  throw RunError(path + ": cannot be written: " + std::strerror(errno) +
                 "; see to the directory and its permissions, or name another file");
}

std::string surface_line(const Surface& surface) {
  ordered_json entry, vertices = ordered_json::array();
  for (const Vec3& v : surface.vertices) vertices.push_back(list_of(v));
  entry["vertices"] = std::move(vertices);
  entry["reflectance"] = surface.reflectance;
  entry["exitance"] = surface.exitance;
  if (!surface.name.empty()) entry["name"] = surface.name;
  if (!surface.object.empty()) entry["object"] = surface.object;
  if (surface.two_sided) entry["two_sided"] = true;
  return entry.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// One entry a line: files that people can read and compare.
template <class Items, class Line>
void append_list(std::string& text, const char* key, const Items& items, Line line) {
  if (items.empty()) return;
  text += std::string(",\n \"") + key + "\": [";
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "\n  " : ",\n  ") + line(items[i]);
  text += "\n ]";
}

}  // namespace

void write_scene(const Scene& scene, const std::string& path) {
  std::string text =
      "{\"format\": \"enfilade-scene\", \"version\": 1, \"units\": \"m\", \"exitanceUnits\": \"";
  text += std::string(name_of(scene.unit)) + "\"";
  append_list(text, "surfaces", scene.surfaces, surface_line);
  append_list(text, "lights", scene.lights, [](const PointLight& light) {
    return ordered_json{{"type", "point"}, {"p", list_of(light.p)}, {"intensity", light.intensity}}
        .dump();
  });
  append_list(text, "probes", scene.probes, [](const Probe& probe) {
    return ordered_json{{"p", list_of(probe.p)}, {"n", list_of(probe.n)}}.dump();
  });
  write_file_atomically(path, text + "\n}\n");
}

void write_file_atomically(const std::string& path, const std::string& text) {
  const std::string temporary = path + ".part" + std::to_string(::getpid());
  const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail_to_write(path);
  std::size_t done = 0;
  bool fine = true;
  while (fine && done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n >= 0)
      done += static_cast<std::size_t>(n);
    else if (errno != EINTR)
      fine = false;
  }
  // Without the flush a power cut could leave the new name with none of the bytes.
  fine = fine && ::fsync(file) == 0;
  fine = ::close(file) == 0 && fine;
  if (fine && std::rename(temporary.c_str(), path.c_str()) == 0) return;
  const int cause = errno;
  ::unlink(temporary.c_str());
  errno = cause;
  fail_to_write(path);
}

}  // namespace enfilade
