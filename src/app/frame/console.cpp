#include "app/frame/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "app/frame/text_table.hpp"

namespace enfilade {

/// The one line of progress on a terminal; at most ten updates a second.
class Console::Meter {
 public:
  /// What stands before a colon names the phase; the rest may change while it lasts.
  void show(std::string_view text, double fraction) {
    const auto now = std::chrono::steady_clock::now();
    if (const auto phase = text.substr(0, text.find(':')); phase != phase_) {
      phase_ = phase;
      phase_start_ = now;
    } else if (now - last_ < std::chrono::milliseconds(100)) {
      return;
    }
    last_ = now;
    const double spent_s = std::chrono::duration<double>(now - phase_start_).count();
    // A straight line through the start: unsure below 2% or 1 s, so nothing is claimed there.
    const bool sure = fraction > 0.02 && fraction < 1.0 && spent_s > 1.0;
    const std::string left =
        sure ? ", about " + format_duration(spent_s * (1.0 - fraction) / fraction) + " left" : "";
    fmt::print(stderr, "\r\x1b[K{} {:.0f}%{}", text, 100.0 * fraction, left);
    std::fflush(stderr);
    shown_ = true;
  }
  void wipe() {
    if (shown_) fmt::print(stderr, "\r\x1b[K");
    shown_ = false;
  }

 private:
  std::string phase_;
  std::chrono::steady_clock::time_point phase_start_, last_;
  bool shown_ = false;
};

Console::Console(bool speaks) : speaks_(speaks) {
  if (speaks_ && isatty(STDERR_FILENO) != 0) meter_ = std::make_shared<Meter>();
}
Console::~Console() = default;
Console::Console(Console&&) noexcept = default;
Console& Console::operator=(Console&&) noexcept = default;

void Console::print(std::string_view text) const {
  if (!speaks_) return;
  end_progress();
  fmt::print("{}", text);
  std::fflush(stdout);
}

void Console::error(const std::string& message) const {
  if (!speaks_) return;
  end_progress();
  fmt::print(stderr, "enfilade: error: {}\n", on_one_line(message));
}

void Console::warnings(const Warnings& warnings) const {
  if (!speaks_) return;
  end_progress();
  for (const std::string& line : warnings.summary()) {
    fmt::print(stderr, "enfilade: warning: {}\n", on_one_line(line));
  }
}

void Console::note(const std::string& message) const {
  if (!speaks_) return;
  end_progress();
  fmt::print(stderr, "enfilade: {}\n", on_one_line(message));
}

Progress Console::progress() const {
  if (!meter_) return {};
  return
      [meter = meter_](std::string_view phase, double fraction) { meter->show(phase, fraction); };
}

void Console::end_progress() const {
  if (meter_) meter_->wipe();
}

std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t';
    if (!blank)
      line += c;
    else if (!line.empty() && line.back() != ' ')
      line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace enfilade
