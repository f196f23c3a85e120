#include "core/numbers/number_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace morula {

std::string shortest_text(double value) {
  if (std::isnan(value)) return "nan";  // without a sign
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string number_text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace morula
