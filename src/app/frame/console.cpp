#include "app/frame/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>

#include "app/frame/text_table.hpp"
#include "base/error.hpp"

namespace enfilade {

namespace {

/// Under smpirun all ranks and this program's globals share one process that SimGrid schedules:
/// there are no threads of ours in it.
bool is_simulated() { return std::getenv("SMPI_GLOBAL_SIZE") != nullptr; }

}  // namespace

/// The one line of progress on a terminal; at most ten updates a second. Where a step takes long,
/// the time that it has taken so far moves on every second.
class Console::Meter {
 public:
  ~Meter() {
    clock_.request_stop();
    woken_.notify_all();
  }

  /// What stands before a colon names the phase; the rest may change while it lasts.
  void show(std::string_view text, double fraction) {
    const std::lock_guard lock(guard_);
    const auto now = std::chrono::steady_clock::now();
    if (const auto phase = text.substr(0, text.find(':')); phase != phase_) {
      phase_ = phase;
      phase_start_ = now;
    } else if (now - last_ < std::chrono::milliseconds(100)) {
      return;
    }
    text_ = text;
    fraction_ = fraction;
    const double spent_s = std::chrono::duration<double>(now - phase_start_).count();
    // A straight line through the start: unsure below 2% or 1 s, so nothing is claimed there.
    const bool sure = fraction > 0.02 && fraction < 1.0 && spent_s > 1.0;
    print(sure ? ", about " + format_duration(spent_s * (1.0 - fraction) / fraction) + " left"
               : "");
    if (!clock_.joinable() && !is_simulated())
      clock_ = std::jthread([this](std::stop_token stop) { run_clock(stop); });
  }
  void wipe() {
    const std::lock_guard lock(guard_);
    if (shown_) fmt::print(stderr, "\r\x1b[K");
    shown_ = false;
  }

 private:
  void print(const std::string& more) {
    last_ = std::chrono::steady_clock::now();
    fmt::print(stderr, "\r\x1b[K{} {:.0f}%{}", terminal_text(text_), 100.0 * fraction_, more);
    std::fflush(stderr);
    shown_ = true;
  }

  /// Shows how long the phase has taken where nothing else has been shown for a second.
  void run_clock(const std::stop_token& stop) {
    constexpr auto second = std::chrono::seconds(1);
    std::unique_lock lock(guard_);
    while (!stop.stop_requested()) {
      woken_.wait_for(lock, stop, second, [] { return false; });
      const auto now = std::chrono::steady_clock::now();
      if (!shown_ || stop.stop_requested() || now - last_ < second) continue;
      const double spent_s = std::chrono::duration<double>(now - phase_start_).count();
      const bool short_yet = spent_s < 60.0;  // whole seconds, as they pass
      print((short_yet ? fmt::format(", {:.0f} s", std::floor(spent_s))
                       : ", " + format_duration(spent_s)) +
            " so far");
    }
  }

  std::string phase_, text_;
  double fraction_ = 0.0;
  std::chrono::steady_clock::time_point phase_start_, last_;
  bool shown_ = false;
  std::mutex guard_;
  std::condition_variable_any woken_;
  std::jthread clock_;  ///< last, so that it ends before what it uses
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
