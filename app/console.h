#pragma once
#include <string>
#include <string_view>

#include "core/result.h"

namespace morula::app {

/// Where the program speaks: results go to standard output, messages to standard error. On several ranks only the root is heard.
class Console {
 public:
  explicit Console(bool heard);

  /// A result, as it is.
  void result(std::string_view text) const;
  /// A message, as it is.
  void message(std::string_view text) const;
  /// `error: ...` and, if there is one, the line `  = help: ...`. An error without text was told already.
  void error(const Error& error) const;
  void warning(std::string_view text) const;
  void note(std::string_view text) const;

  [[nodiscard]] bool heard() const { return heard_; }
  /// Colour on standard error: a terminal, and NO_COLOR is not set (no-color.org).
  [[nodiscard]] bool colour() const { return colour_; }
  /// Standard error is a terminal: the live line may be used.
  [[nodiscard]] bool live() const { return live_; }
  /// Whether all results reached standard output, as far as anybody reads it; false on a full disk.
  [[nodiscard]] bool finish() const;

 private:
  void labelled(std::string_view label, std::string_view ansi, std::string_view text) const;
  bool heard_, colour_, live_;
};

}  // namespace morula::app
