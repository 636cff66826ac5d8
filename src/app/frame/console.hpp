// The program's output: results on standard output, errors, warnings and progress on
// standard error. Here text leaves for the terminal, so here it is made safe (base/safe_text.hpp).
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/progress.hpp"
#include "base/safe_text.hpp"
#include "base/warnings.hpp"

namespace enfilade {

/// One rank of a run speaks; on the other ranks every call does nothing.
class Console {
 public:
  explicit Console(bool speaks);
  ~Console();
  Console(Console&&) noexcept;
  Console& operator=(Console&&) noexcept;

  bool speaks() const { return speaks_; }
  /// Writes the text to standard output. Throws RunError where that cannot be written.
  void print(std::string_view text) const;
  /// Writes "enfilade: error: ..." on one line, whatever line breaks the message has.
  void error(const std::string& message) const;
  /// Writes "enfilade: warning: ...", one line per kind of warning.
  void warnings(const Warnings& warnings) const;
  /// Writes one line on standard error that is neither an error nor a warning: "enfilade: ...".
  void note(const std::string& message) const;
  /// Shows phases, percent and an estimate of the time left, on a terminal; empty where standard
  /// error is none.
  Progress progress() const;
  /// Wipes the progress line.
  void end_progress() const;

 private:
  void line(const char* kind, const std::string& text) const;

  class Meter;
  bool speaks_ = true;
  std::shared_ptr<Meter> meter_;
};

}  // namespace enfilade
