#include "app/frame/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "app/frame/text_table.hpp"
#include "base/error.hpp"

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
    fmt::print(stderr, "\r\x1b[K{} {:.0f}%{}", terminal_text(text), 100.0 * fraction, left);
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
  if (!speaks_ || text.empty()) return;
  end_progress();
  const std::string safe = terminal_text(text);
  errno = 0;
  if (std::fwrite(safe.data(), 1, safe.size(), stdout) == safe.size() && std::fflush(stdout) == 0)
    return;
  throw RunError(std::string("standard output: cannot be written: ") + std::strerror(errno) +
                 "; see what it is redirected to");
}

void Console::error(const std::string& message) const { line("error: ", message); }

void Console::warnings(const Warnings& warnings) const {
  for (const std::string& text : warnings.summary()) line("warning: ", text);
}

void Console::note(const std::string& message) const { line("", message); }

void Console::line(const char* kind, const std::string& text) const {
  if (!speaks_) return;
  end_progress();
  fmt::print(stderr, "enfilade: {}{}\n", kind, terminal_text(on_one_line(text)));
}

Progress Console::progress() const {
  if (!meter_) return {};
  return
      [meter = meter_](std::string_view phase, double fraction) { meter->show(phase, fraction); };
}

void Console::end_progress() const {
  if (meter_) meter_->wipe();
}

}  // namespace enfilade
