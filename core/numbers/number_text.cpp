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

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

}  // namespace morula
