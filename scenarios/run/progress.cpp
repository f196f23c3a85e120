#include "scenarios/run/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace morula::scenarios {
namespace {

double fraction(const Progress& p) { return p.end > 0.0 ? std::clamp(p.time / p.end, 0.0, 1.0) : 1.0; }

std::string numbers(const Progress& p) {
  std::string out = "t " + time_text(p.time) + " of " + time_text(p.end) + " · " + std::to_string(p.cells) + " cells";
  if (p.shells > 0) out += " (" + std::to_string(p.shells) + " shells)";
  char step[32];
  std::snprintf(step, sizeof step, " · dt %.3g s", p.step);
  if (p.step > 0.0) out += step;
  if (p.left.low >= 0.0 && p.time < p.end) out += " · left " + duration_text(p.left);
  return out;
}

std::string percent(const Progress& p) {
  char text[16];
  std::snprintf(text, sizeof text, "%3.0f %%", std::floor(100.0 * fraction(p)));
  return text;
}

}  // namespace

std::string time_text(double seconds) {
  char text[32];
  if (seconds == 0.0) return "0 h";
  if (seconds < 120.0)
    std::snprintf(text, sizeof text, "%.3g s", seconds);
  else if (seconds < 7200.0)
    std::snprintf(text, sizeof text, "%.3g min", seconds / 60.0);
  else
    std::snprintf(text, sizeof text, "%.4g h", seconds / 3600.0);
  return text;
}

std::string live_line(const Progress& progress) {
  constexpr int kWidth = 18;
  static constexpr const char* kPart[] = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const int eighths = static_cast<int>(std::floor(fraction(progress) * kWidth * 8.0));
  std::string bar;
  for (int i = 0; i < kWidth; ++i) bar += eighths >= 8 * (i + 1) ? "█" : kPart[std::clamp(eighths - 8 * i, 0, 7)];
  return percent(progress) + " ▕" + bar + "▏ " + numbers(progress);
}

std::string plain_line(const Progress& progress) { return percent(progress) + "  " + numbers(progress); }

bool PlainPace::due(const Progress& progress) {
  const int twentieth = static_cast<int>(std::floor(20.0 * fraction(progress)));
  const auto now = std::chrono::steady_clock::now();
  if (twentieth == twentieth_ && now - last_ < std::chrono::seconds(60)) return false;
  twentieth_ = twentieth;
  last_ = now;
  return true;
}

}  // namespace morula::scenarios
