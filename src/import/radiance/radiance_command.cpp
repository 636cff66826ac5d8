#include "import/radiance/radiance_command.hpp"

#include <algorithm>
#include <sstream>

#include "import/radiance/radiance_generators.hpp"

namespace enfilade {
namespace {

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// The commands between the pipes.
std::vector<std::vector<std::string>> stages_of(const std::string& command) {
  std::vector<std::vector<std::string>> stages;
  std::istringstream in(command);
  for (std::string part; std::getline(in, part, '|');) stages.push_back(words_of(part));
  if (stages.empty() || command.back() == '|') stages.emplace_back();
  return stages;
}

}  // namespace

RadianceCommand parse_radiance_command(const std::string& command, const RadiancePlace& place) {
  const auto refuse = [&] {
    place.fail("the command " + radiance_quoted("!" + command) + " is not carried out",
               "expand the file with Radiance's own xform first (xform -e model.rad > "
               "expanded.rad)");
  };
  // What a shell would read in a special way may mean anything.
  if (command.find_first_of("&;<>()$`*?[]{}~\\\"'#") != std::string::npos) refuse();
  RadianceCommand result;
  bool first = true;
  for (std::vector<std::string>& words : stages_of(command)) {
    if (words.empty()) refuse();
    const std::string program = words[0];
    words.erase(words.begin());
    if (program == "xform") {
      const RadianceXform next = parse_radiance_xform(words, place);
      if (first && next.files.empty())
        place.fail("xform names no file", "write the file that it takes in");
      if (!first && !next.files.empty())
        place.fail("xform takes in a file behind a pipe", "write it without the pipe");
      result.xform = first ? next : result.xform.then(next, place);
    } else if (!first) {
      refuse();
    } else if (program == "cat" && !words.empty() && words[0][0] != '-') {
      result.xform.files = words;
    } else if (program == "genbox" || program == "genprism") {
      RadianceGenerated made =
          program == "genbox" ? radiance_box(words, place) : radiance_prism(words, place);
      result.modifier = std::move(made.modifier);
      result.name = std::move(made.name);
      result.polygons = std::move(made.polygons);
    } else if (program == "gensky" || program == "gendaylit") {
      result.left_out = program;
    } else {
      refuse();
    }
    first = false;
  }
  return result;
}

}  // namespace enfilade
