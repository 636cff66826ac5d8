// enfilade render: a picture of the solved scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/frame/option_checks.hpp"
#include "app/frame/output_file.hpp"
#include "app/frame/text_table.hpp"
#include "app/outputs/room_survey.hpp"
#include "app/outputs/solved_run.hpp"
#include "app/pages/pages.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "report/pictures/false_colour.hpp"
#include "report/pictures/render.hpp"
#include "report/pictures/tone_mapping.hpp"
#include "report/survey/room_cameras.hpp"

namespace enfilade {

namespace {

constexpr SubcommandText render_help{
    "render", "Make a PNG picture of a solved scene",
    "Examples:\n  enfilade render out/duplex -o room.png\n"
    "  enfilade render out/duplex -o plan.png --camera storey-1 --false-colour\n"
    "  enfilade render out/duplex -o dusk.png --switch 'kitchen ceiling=0.3'\n"
    "  enfilade render out/duplex -o desk.png --eye 2 1 1.6 --look-at 4 3 0.8 --angle 50"};

struct RenderOptions {
  std::string run, output, camera_file, camera_name;
  RunLight light;
  std::vector<double> eye, look_at, up;
  double vertical_angle_deg = Camera{}.vertical_angle_deg;
  RenderConfig render;
  ToneConfig tone;
  FalseColourConfig scale;
  bool linear_tone = false, false_colour = false, linear_scale = false;
};

Vec3 point(const std::vector<double>& p) { return {p[0], p[1], p[2]}; }

/// The camera of --eye and --look-at, else the named one of --cameras or of the automatic cameras.
Camera choose_camera(const RenderOptions& options, const SolvedRun& run) {
  const SolvedScene solved = run.solved_scene();
  if (!options.eye.empty()) {
    Camera camera;
    camera.name = "asked";
    camera.eye = point(options.eye);
    camera.look_at = point(options.look_at);
    if (!options.up.empty()) camera.up = point(options.up);
    camera.vertical_angle_deg = options.vertical_angle_deg;
    check_camera(camera, "command line", "--");
    return camera;
  }
  RunRooms rooms(run);
  const std::vector<Camera> cameras = options.camera_file.empty()
                                          ? room_cameras(solved, rooms.all(), rooms.views())
                                          : read_cameras(options.camera_file);
  std::string names;
  for (const Camera& camera : cameras) {
    if (options.camera_name.empty() || camera.name == options.camera_name) return camera;
    names += (names.empty() ? "" : ", ") + camera.name;
  }
  throw InputError("command line", "--camera", "there is no camera '" + options.camera_name + "'",
                   names.empty() ? "give --eye and --look-at" : "choose one of " + names);
}

void check(const RenderOptions& options) {
  if (options.eye.empty() != options.look_at.empty()) {
    throw InputError("command line", "render", "--eye and --look-at belong together",
                     "give both or neither");
  }
  if (options.scale.highest > 0.0 && options.scale.lowest >= options.scale.highest) {
    throw InputError("command line", "--highest", "is not above --lowest", "give a higher one");
  }
  if (!options.output.ends_with(".png")) {
    throw InputError("command line", "-o", "'" + options.output + "' is no .png file",
                     "name a .png file");
  }
  check_output_file(options.output);
}

void run_render(const RenderOptions& options, const Console& console) {
  check(options);
  RunLock lock;
  lock.read(options.run);
  const SolvedRun run(options.run, {}, options.light);
  const SolvedScene solved = run.solved_scene();
  const Camera camera = choose_camera(options, run);
  const LightImage light = render(solved, camera, options.render, console.progress());
  const std::string unit = irradiance_label(solved.scene.unit);
  ToneConfig tone = options.tone;
  if (options.linear_tone) tone.curve = ToneConfig::Curve::linear;
  FalseColourConfig scale = options.scale;
  scale.logarithmic = !options.linear_scale;
  const Bitmap picture =
      options.false_colour ? false_coloured(light, unit, scale) : tone_mapped(light, tone);
  write_file_atomically(options.output, encode_png(picture, "enfilade, camera " + camera.name));
  TextTable table(options.output);
  table.add("camera", camera.name);
  table.add("pixels", std::to_string(picture.width) + " x " + std::to_string(picture.height));
  if (light.gathered_places > 0)
    table.add("light",
              fmt::format("gathered at {} places by {} rays each",
                          with_thousands(light.gathered_places), options.render.gather_rays));
  if (options.false_colour) table.add("unit", unit);
  console.print(table.text());
}

void add_camera_options(CLI::App& sub, RenderOptions& o) {
  OptionGroup group(sub, "Camera");
  const auto add_point = [&group](const char* name, std::vector<double>& p, const char* help) {
    return group.add(name, p, help)->expected(3)->delimiter(',');
  };
  group.add("--camera", o.camera_name, "Camera by name; default: the first");
  group.add("--cameras", o.camera_file,
            "File with cameras (JSON); default: cameras found in the rooms");
  add_point("--eye", o.eye, "Where the eye is, in metres: X Y Z");
  add_point("--look-at", o.look_at, "The point in the middle of the picture: X Y Z");
  add_point("--up", o.up, "Upward direction; default: 0 0 1")->needs("--eye");
  group
      .add("--angle", o.vertical_angle_deg, "Vertical angle of view, degrees",
           number_between(0.0, 180.0))
      ->needs("--eye");
}

void add_picture_options(CLI::App& sub, RenderOptions& o) {
  OptionGroup group(sub, "Picture");
  group.add("--width", o.render.width, "Pixels", CLI::Range(1, 20000));
  group.add("--height", o.render.height, "Pixels", CLI::Range(1, 20000));
  group.add("--samples", o.render.samples, "Rays a pixel", CLI::Range(1, 4096));
  group.add(
      "--gather-rays", o.render.gather_rays,
      "Light is gathered from the solution at places of the picture, by so many rays over the "
      "hemisphere of each (four times as many to a sky), and smoothed between them: no patches "
      "show; 0 = light of the patches",
      CLI::Range(0, 1000000));
  group.add(
      "--gather-every", o.render.gather_every_px,
      "Distance of these places, pixels; the light that comes straight from lamps is found at "
      "least every 4 pixels",
      CLI::Range(1, 1000));
  group.add("--threads", o.render.threads, "Threads; 0 = one a core", CLI::Range(0, 4096));
  group
      .add("--exposure", o.tone.exposure,
           "The light is shown this many times as bright; default: by itself")
      ->check(positive_number());
  group.flag("--linear-tone", o.linear_tone,
             "Brightness in proportion, without the photographic curve");
  group.flag("--false-colour,--false-color", o.false_colour,
             "Irradiance as colours, with a legend in its unit");
  group.add("--lowest", o.scale.lowest, "Lower end of the colour scale; default: from the picture")
      ->check(number_from_zero())
      ->needs("--false-colour");
  group
      .add("--highest", o.scale.highest, "Upper end of the colour scale; default: from the picture")
      ->check(positive_number())
      ->needs("--false-colour");
  group.flag("--linear-scale", o.linear_scale, "Colour scale in equal steps, not logarithmic")
      ->needs("--false-colour");
}

void add_options(CLI::App& sub, RenderOptions& o) {
  sub.add_option("run", o.run, "RUN directory that solve has filled")->required();
  sub.add_option("-o,--output", o.output, "PNG file to write")->required();
  add_switch_option(sub, o.light.switches);
  add_camera_options(sub, o);
  add_picture_options(sub, o);
}

}  // namespace

void add_render(CLI::App& cli, Command& chosen) {
  add_subcommand(cli, chosen, render_help, add_options, run_render);
}

}  // namespace enfilade
