// enfilade render: a picture of the solved scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "app/command.hpp"
#include "app/option_checks.hpp"
#include "app/output_file.hpp"
#include "app/solved_run.hpp"
#include "app/text_table.hpp"
#include "base/error.hpp"
#include "report/pictures/camera.hpp"
#include "report/pictures/false_colour.hpp"
#include "report/pictures/render.hpp"
#include "report/pictures/tone_mapping.hpp"
#include "scene_file/scene_io.hpp"

namespace enfilade {

namespace {

struct RenderOptions {
  std::string run, output, camera_file, camera_name;
  std::vector<double> eye, look_at, up;
  double vertical_angle_deg = Camera{}.vertical_angle_deg;
  RenderConfig render;
  ToneConfig tone;
  FalseColourConfig scale;
  bool linear_tone = false, false_colour = false, linear_scale = false;
};

Vec3 point(const std::vector<double>& p) { return {p[0], p[1], p[2]}; }

/// From --eye and --look-at, else by name from --cameras or from those that find their place
/// themselves.
Camera choose_camera(const RenderOptions& options, const SolvedScene& solved) {
  if (!options.eye.empty()) {
    Camera camera;
    camera.name = "asked";
    camera.eye = point(options.eye);
    camera.look_at = point(options.look_at);
    if (!options.up.empty()) camera.up = point(options.up);
    camera.vertical_angle_deg = options.vertical_angle_deg;
    return camera;
  }
  const std::vector<Camera> cameras =
      options.camera_file.empty() ? automatic_cameras(solved) : read_cameras(options.camera_file);
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
  for (const auto& [name, numbers] :
       {std::pair{"--eye", &options.eye}, {"--look-at", &options.look_at}, {"--up", &options.up}}) {
    if (std::ranges::all_of(*numbers, [](double x) { return std::isfinite(x); })) continue;
    throw InputError("command line", name, "is no point", "give three finite numbers");
  }
  if (!options.eye.empty() && options.eye == options.look_at) {
    throw InputError("command line", "--look-at", "is where the eye is", "look at another point");
  }
  if (!options.up.empty() && point(options.up) == Vec3(0.0)) {
    throw InputError("command line", "--up", "has no direction", "give another, as 0 0 1");
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

void run_render(const RenderOptions& options, Session& session) {
  check(options);
  const SolvedRun run(options.run);
  const SolvedScene solved = run.solved_scene();
  const Camera camera = choose_camera(options, solved);
  const LightImage light = render(solved, camera, options.render, session.console().progress());
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
  if (options.false_colour) table.add("unit", unit);
  session.console().print(table.text());
}

void add_camera_options(CLI::App& sub, RenderOptions& o) {
  const std::string group = "Camera";
  sub.add_option("--camera", o.camera_name, "Camera by name; default: the first")->group(group);
  sub.add_option("--cameras", o.camera_file,
                 "File with cameras (JSON); default: cameras found in the rooms")
      ->group(group);
  sub.add_option("--eye", o.eye, "Where the eye is, in metres: X Y Z")
      ->expected(3)
      ->delimiter(',')
      ->group(group);
  sub.add_option("--look-at", o.look_at, "The point in the middle of the picture: X Y Z")
      ->expected(3)
      ->delimiter(',')
      ->group(group);
  sub.add_option("--up", o.up, "Upward direction; default: 0 0 1")
      ->expected(3)
      ->delimiter(',')
      ->needs("--eye")
      ->group(group);
  sub.add_option("--angle", o.vertical_angle_deg, "Vertical angle of view, degrees")
      ->check(number_between(0.0, 180.0))
      ->needs("--eye")
      ->capture_default_str()
      ->group(group);
}

void add_picture_options(CLI::App& sub, RenderOptions& o) {
  const std::string group = "Picture";
  sub.add_option("--width", o.render.width, "Pixels")
      ->check(CLI::Range(1, 20000))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--height", o.render.height, "Pixels")
      ->check(CLI::Range(1, 20000))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--samples", o.render.samples, "Rays a pixel")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--gather-rays", o.render.gather_rays,
                 "Rays of a gather from the solution at each pixel: slow, and shows no mesh lines; "
                 "0 = none")
      ->check(CLI::Range(0, 1000000))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--threads", o.render.threads, "Threads; 0 = one a core")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str()
      ->group(group);
  sub.add_option("--exposure", o.tone.exposure,
                 "The light is shown this many times as bright; default: by itself")
      ->check(positive_number())
      ->group(group);
  sub.add_flag("--linear-tone", o.linear_tone,
               "Brightness in proportion, without the photographic curve")
      ->group(group);
  sub.add_flag("--false-colour,--false-color", o.false_colour,
               "Irradiance as colours, with a legend in its unit")
      ->group(group);
  sub.add_option("--lowest", o.scale.lowest,
                 "Lower end of the colour scale; default: from the picture")
      ->check(number_from_zero())
      ->needs("--false-colour")
      ->group(group);
  sub.add_option("--highest", o.scale.highest,
                 "Upper end of the colour scale; default: from the picture")
      ->check(positive_number())
      ->needs("--false-colour")
      ->group(group);
  sub.add_flag("--linear-scale", o.linear_scale, "Colour scale in equal steps, not logarithmic")
      ->needs("--false-colour")
      ->group(group);
}

}  // namespace

void add_render(CLI::App& cli, Command& chosen) {
  auto options = std::make_shared<RenderOptions>();
  CLI::App* sub = cli.add_subcommand("render", "Make a PNG picture of a solved scene");
  sub->add_option("run", options->run, "RUN directory that solve has filled")->required();
  sub->add_option("-o,--output", options->output, "PNG file to write")->required();
  add_camera_options(*sub, *options);
  add_picture_options(*sub, *options);
  sub->footer(
      "Examples:\n  enfilade render out/duplex -o room.png\n"
      "  enfilade render out/duplex -o plan.png --camera storey-1 --false-colour\n"
      "  enfilade render out/duplex -o desk.png --eye 2 1 1.6 --look-at 4 3 0.8 --angle 50");
  sub->callback([options, &chosen] {
    chosen = {false, [options](Session& session) { run_render(*options, session); }};
  });
}

}  // namespace enfilade
