#include "run/graph_file.hpp"

#include <charconv>
#include <string_view>

#include "base/error.hpp"
#include "base/posix_file.hpp"
#include "run/run_layout.hpp"

namespace enfilade {
namespace {

constexpr std::string_view title = "enfilade-graph 1 ";

/// Takes numbers and words off the front of a text.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& path) : text_(text), path_(path) {}
  std::uint64_t number() {
    skip_blanks();
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
    if (code != std::errc{}) damaged();
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return value;
  }
  void expect(std::string_view word) {
    skip_blanks();
    if (!text_.starts_with(word)) damaged();
    text_.remove_prefix(word.size());
  }
  void end_of_line() {
    if (text_.empty() || text_.front() != '\n') damaged();
    text_.remove_prefix(1);
  }
  bool at_end_of_line() const { return text_.empty() || text_.front() == '\n'; }
  bool empty() const { return text_.empty(); }

  [[noreturn]] void damaged() const {
    throw RunError(path_ + ": the visibility graph is damaged; prepare the run again");
  }

 private:
  void skip_blanks() {
    while (!text_.empty() && text_.front() == ' ') text_.remove_prefix(1);
  }
  std::string_view text_;
  const std::string& path_;
};

}  // namespace

void write_graph(const ClusterGraph& graph, const std::string& path) {
  std::string text(title);
  const auto add = [&text](std::size_t number, char after) {
    text += std::to_string(number);
    text += after;
  };
  add(graph.size(), ' ');
  add(graph.edges(), '\n');
  for (std::size_t i = 0; i < graph.size(); ++i) {
    text += RunLayout::stem(ClusterId(i));
    text += ' ';
    add(i, ' ');
    for (const std::uint32_t j : graph.neighbours(i)) add(j, ' ');
    text.back() = '\n';
  }
  replace_file(path, text);
}

ClusterGraph read_graph(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  Scanner in({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
  in.expect(title);
  const std::uint64_t clusters = in.number(), edges = in.number();
  in.end_of_line();
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint64_t i = 0; i < clusters; ++i) {
    in.expect(RunLayout::stem(ClusterId(static_cast<std::size_t>(i))));
    if (in.number() != i) in.damaged();
    while (!in.at_end_of_line()) {
      const std::uint64_t j = in.number();
      if (j >= clusters) in.damaged();
      if (i < j) pairs.emplace_back(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    }
    in.end_of_line();
  }
  ClusterGraph graph(static_cast<std::size_t>(clusters), std::move(pairs));
  if (!in.empty() || graph.edges() != edges) in.damaged();
  return graph;
}

}  // namespace enfilade
