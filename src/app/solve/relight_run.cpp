#include "app/solve/relight_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/frame/shown_value.hpp"
#include "base/byte_stream.hpp"
#include "base/error.hpp"
#include "gather/emitted_power.hpp"
#include "import/import_model.hpp"
#include "run/history.hpp"
#include "run/stats_json.hpp"
#include "scene/equal_bands.hpp"
#include "scene/make_lights.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {
namespace {

constexpr const char* remedy = "solve the scene without --relight";

double worst_band(const Spectrum& power) {
  return power.empty() ? 0.0 : *std::ranges::max_element(power);
}

bool same_corners(const Polygon& a, const Polygon& b) {
  constexpr double rounding = 1e-9;  // of a file's decimals
  return std::ranges::equal(a, b, [](const Vec3& p, const Vec3& q) {
    return glm::length(p - q) <= rounding * (1.0 + glm::length(p));
  });
}

bool emits(const Surface& surface) {
  return std::ranges::any_of(surface.exitance, [](double e) { return e > 0.0; });
}

std::string name_of(const Scene& scene, std::size_t i) {
  const std::string& name = scene.surfaces[i].name;
  return "surfaces[" + std::to_string(i) + "]" + (name.empty() ? "" : " '" + name + "'");
}

/// Of surfaces in one plane the emitting one is in front.
void check_same_pieces(const Scene& now, const Scene& before, const std::string& run) {
  const auto same_emitters =
      std::ranges::equal(now.surfaces, before.surfaces,
                         [](const Surface& a, const Surface& b) { return emits(a) == emits(b); });
  if (same_emitters) return;
  Warnings told_before;
  const std::vector<Piece> pieces = make_pieces(now, told_before);
  const std::vector<Piece> old = make_pieces(before, told_before);
  for (std::size_t i = 0; i < std::max(pieces.size(), old.size()); ++i) {
    if (i < pieces.size() && i < old.size() && pieces[i].surface == old[i].surface &&
        same_corners(pieces[i].polygon, old[i].polygon))
      continue;
    const SurfaceId first = i >= old.size()      ? pieces[i].surface
                            : i >= pieces.size() ? old[i].surface
                                                 : std::min(pieces[i].surface, old[i].surface);
    throw InputError(now.file, name_of(now, first.index()),
                     "is covered by another surface in its plane otherwise than in " + run +
                         ", since which of them emits has changed",
                     remedy);
  }
}

/// What all ranks take over from the run before.
struct Start {
  Relight relight;
  double epsilon = 0.0, target_error = 0.0;
  Basis basis = Basis::linear;
  Hierarchy hierarchy = Hierarchy::building;

  std::string to_text() const {
    ByteWriter w;
    w.put_text(relight.from);
    w.put_all(relight.old_light);
    w.put_all(relight.old_band);
    w.put(epsilon);
    w.put(target_error);
    w.put(static_cast<std::uint8_t>(basis));
    w.put(static_cast<std::uint8_t>(hierarchy));
    return w.text();
  }
  static Start from_text(const std::string& text) {
    ByteReader r(text, "the start of --relight");
    Start start;
    start.relight.from = r.get_text();
    start.relight.old_light = r.get_all<std::uint32_t>();
    start.relight.old_band = r.get_all<std::uint32_t>();
    start.epsilon = r.get<double>();
    start.target_error = r.get<double>();
    start.basis = static_cast<Basis>(r.get<std::uint8_t>());
    start.hierarchy = static_cast<Hierarchy>(r.get<std::uint8_t>());
    return start;
  }
};

/// A master deals out clusters, and does not know far nodes.
void check_scheme(const SolveConfig& config, const Manifest& manifest) {
  if (config.scheme == Scheme::spmd || manifest.hierarchy == Hierarchy::clusters) return;
  throw InputError("command line", "--scheme",
                   "does not go with the links of this run, which was solved with --scheme spmd",
                   "leave it out");
}

/// On rank 0.
Start prepare_start(const SolveOptions& options, const SolveConfig& config, Warnings& warnings,
                    RunLock& lock) {
  const std::string& from = options.input;
  std::error_code missing;
  const bool in_place = std::filesystem::equivalent(from, config.run_directory, missing);
  RunLock reading;
  if (in_place) {
    lock.write(from);
  } else {
    reading.read(from);
  }
  const Prepared old = load_prepared(from);
  const Manifest manifest = committed_manifest(RunLayout(from));
  if (manifest.history.empty())
    throw InputError(from, "--relight", "the solve there has not begun", "solve it first");
  check_scheme(config, manifest);
  Warnings told_before;
  const Scene before = scene_from(scene_text(from), from + "/scene.json", told_before);
  Scene now = read_scene_or_model(options.relight, warnings, options.allow_outside);
  check_same_geometry(now, before, from);
  Scene lit = now;
  make_lights(lit);
  merge_equal_bands(lit);
  Start start;
  start.relight.from = in_place ? config.run_directory + "/before-relight" : from;
  start.relight.old_light = lights_with_links(lit, old.scene);
  start.relight.old_band = bands_before(lit, old.scene);
  const double emitted = worst_band(emitted_power(old.scene, old.clusters));
  start.epsilon = emitted > 0.0 ? history_of(manifest).back().plan.link_tolerance / emitted : 0.0;
  start.target_error = options.target_is_given()
                           ? config.target_error
                           : read_stats(from).number("target_error", config.target_error);
  start.basis = manifest.basis;
  start.hierarchy = manifest.hierarchy;
  prepare_relit(now, from, config.run_directory, lock);
  return start;
}

}  // namespace

void check_same_geometry(const Scene& now, const Scene& before, const std::string& run) {
  for (std::size_t i = 0; i < std::min(now.surfaces.size(), before.surfaces.size()); ++i) {
    const Surface &a = now.surfaces[i], &b = before.surfaces[i];
    if (a.transmittance != b.transmittance) {
      throw InputError(now.file, name_of(now, i), "lets other light through than in " + run,
                       remedy);
    }
    if (same_corners(a.vertices, b.vertices) && a.two_sided == b.two_sided) continue;
    throw InputError(now.file, name_of(now, i), "has another geometry than in " + run, remedy);
  }
  if (now.surfaces.size() != before.surfaces.size()) {
    throw InputError(
        now.file, "surfaces",
        fmt::format("has {} of them, {} has {}", now.surfaces.size(), run, before.surfaces.size()),
        remedy);
  }
  if (now.unit != before.unit) {
    throw InputError(now.file, "exitanceUnits", "is not the unit of " + run,
                     "give the light in the same unit, or " + std::string(remedy));
  }
  check_same_pieces(now, before, run);
}

Prepared begin_relight(const SolveOptions& options, SolveConfig& config, Communicator& communicator,
                       Warnings& warnings, RunLock& lock) {
  std::string text;
  communicator.on_root([&] { text = prepare_start(options, config, warnings, lock).to_text(); });
  const Start start = Start::from_text(communicator.broadcast(text));
  config.relight = start.relight;
  config.epsilon = start.epsilon;
  config.target_error = start.target_error;
  config.gather.basis = start.basis;
  config.hierarchy = start.hierarchy;
  lock.join(config.run_directory);
  return load_prepared(config.run_directory);
}

Warnings relight_shortfall(const SolveOptions& options, const RunRecord& record) {
  Warnings warnings;
  const auto percent = [&](const char* key) { return shown_number(key, record.number(key, 1.0)); };
  if (record.number("estimated_error", 1.0) > record.number("target_error", 1.0)) {
    warnings.add(options.relight,
                 fmt::format("relit with links that were refined for other light: estimated error "
                             "{}, asked {}; solve the scene without --relight for that",
                             percent("estimated_error"), percent("target_error")));
  }
  return warnings;
}

}  // namespace enfilade
