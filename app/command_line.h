#pragma once
#include <string>
#include <variant>
#include <vector>

#include "app/options.h"
#include "core/result.h"

namespace morula::app {

/// A text that answers the command by itself: `--help`, `--version`.
struct Answer {
  std::string text;
};

/// Read the command line. `arguments` without the program's name. Errors are kInput (exit 2), with what is near to a verb or flag that does not exist.
Result<std::variant<Options, Answer>> read_command_line(const std::vector<std::string>& arguments);

}  // namespace morula::app
