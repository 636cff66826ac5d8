// Writes scenes and files so that a reader never meets half of one.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "scene_file/scene_io.hpp"
#include "scene_file/scene_stream.hpp"

namespace enfilade {
namespace {

[[noreturn]] void fail_to_write(const std::string& path) {
  throw RunError(path + ": cannot be written: " + std::strerror(errno) +
                 "; see to the directory and its permissions, or name another file");
}

}  // namespace

void write_scene(const Scene& scene, const std::string& path) {
  SceneStream stream(path, scene.unit);
  for (const Surface& surface : scene.surfaces) stream.add(surface);
  stream.finish(scene.lights, scene.probes, scene.building);
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
