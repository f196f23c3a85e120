// Whether shells can do what their forces ask of them: measured limits of meshes, and the stability of a tense cell.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "study/build.h"
#include "study/read_section.h"

namespace morula::scenarios {
namespace {

constexpr double kStrong = 0.92;  // W over the sum of both tensions from which groups of fine meshes were seen to stall
constexpr std::uint64_t kFineNodes =
    642;  // 13 cells of 642 nodes at 0.95 stop after twelve minutes, at 0.9 they come to rest; 162 nodes do
constexpr std::uint64_t kEnoughNodes = 162;  // that follow

std::uint64_t cells_of_type(const draft::Study& study, const std::string& type) {
  std::uint64_t out = 0;
  for (const auto& block : study.initial) {
    if (block.content.csv.given) return 1000;  // as many as the file says
    for (const auto& share : block.content.types)
      if (share.name == type) out += static_cast<std::uint64_t>(share.content.value * static_cast<double>(block.content.count.value));
    if (block.content.type.value == type) out += block.content.at.given ? block.content.at.value.size() : block.content.count.value;
  }
  return out;
}

/// Many cells that adhere nearly as much as their tension allows fold at triple lines, and a fine mesh cannot pass over the folds.
void check_strong_adhesion(BuildContext& c) {
  const auto drop = [&](std::size_t i) {
    const CellType& type = c.study.model.types[i];
    return type.regional_tension.drop_in_contact(type.shell.tension, 0.0);
  };
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    if (!may_be_shell(c, i) || !t.nodes.known() || t.nodes.value < kFineNodes || !t.tension.known() || !(t.tension.value > 0.0)) continue;
    for (const auto& sticks : t.adhesion) {
      const auto other =
          std::find_if(c.draft.cell_types.begin(), c.draft.cell_types.end(), [&](const auto& type) { return type.name == sticks.name; });
      if (other == c.draft.cell_types.end() || !sticks.content.known() || !other->content.tension.known()) continue;
      const double drops = drop(i) + drop(static_cast<std::size_t>(other - c.draft.cell_types.begin()));
      const double ratio = (sticks.content.value + drops) / (t.tension.value + other->content.tension.value);
      const bool same = other->name == name;
      const std::uint64_t cells = cells_of_type(c.draft, name) + (same ? 0 : cells_of_type(c.draft, other->name));
      if (ratio < kStrong || ratio >= 1.0 || cells < 3) continue;  // from 1 on: E509
      char text[32];
      std::snprintf(text, sizeof text, "%.2f", ratio);
      c.diagnostics.error(571, sticks.content.given ? sticks.content.place : place,
                          "shells of '" + name + "' with " + t.nodes.text + " nodes cannot follow an adhesion" +
                              (drops != 0.0 ? " (with what contact takes from the tension)" : "") + " of " + text +
                              " times the tension of both surfaces where more than two cells meet",
                          "`nodes: " + std::to_string(kEnoughNodes) + "` can; or adhesion up to 0.9 times both tensions");
    }
  }
}

/// Mean square slope of a surface under noise, of modes up to the edges of its mesh: ⟨θ²⟩ = k_B T/(4πκ) ln(1 + κ q²/(γ + κ/R²)), q = π/edge (Helfrich).
double square_of_slope(double energy, const dcm::ShellParameters& p, double edge, double radius) {
  const double most = std::numbers::pi / edge, rigidity = p.helfrich_rigidity + 0.5 * std::numbers::sqrt3 * p.hinge_stiffness;
  if (rigidity > 0.0)
    return energy / (4.0 * std::numbers::pi * rigidity) * std::log1p(rigidity * most * most / (p.tension + rigidity / (radius * radius)));
  return p.tension > 0.0 ? energy * most * most / (4.0 * std::numbers::pi * p.tension) : 0.0;
}

/// Noise that turns faces too far folds the mesh: no step is found.
void check_noise(BuildContext& c) {
  constexpr double kMost = 0.4;  // ⟨θ²⟩; one cell, 162 nodes, 0.1 mN/m: 0.36 runs (in steps of milliseconds), 0.48 ends within seconds
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    const double energy = c.study.model.types[i].fluctuations.energy, radius = t.radius.mean.value;
    if (!(energy > 0.0) || !t.radius.mean.known() || !may_be_shell(c, i)) continue;
    const double slope2 = square_of_slope(energy, c.study.model.types[i].shell, mean_edge(t.nodes.value) * radius, radius);
    if (slope2 <= kMost) continue;
    c.diagnostics.error(
        705, t.activity.energy.given ? t.activity.energy.place : place,
        "fluctuations of " + t.activity.energy.text + " turn the faces of shells of '" + name + "' by " +
            short_number(std::sqrt(slope2) * 180.0 / std::numbers::pi) + " deg: the mesh folds",
        "an `energy` of at most " + short_number(energy * kMost / slope2) + " fJ, fewer nodes, or more tension or rigidity");
  }
}

/// Under the pressure 2γ/R the volume shrinks, and that pressure rises: with K < 2γ/(3R) nothing stops it.
void check_bulk(BuildContext& c) {
  for (std::size_t i = 0; i < c.draft.cell_types.size(); ++i) {
    const auto& [name, place, t] = c.draft.cell_types[i];
    if (!may_be_shell(c, i)) continue;
    if (!t.bulk_modulus.known() || !t.tension.known() || !t.radius.mean.known() || !(t.radius.mean.value > 0.0)) continue;
    if (!(t.bulk_modulus.value > 0.0)) continue;
    const double least = 2.0 * t.tension.value / (3.0 * t.radius.mean.value);
    if (t.bulk_modulus.value > least) continue;
    char text[48];
    std::snprintf(text, sizeof text, "%.3g kPa", 3.0 * least);
    c.diagnostics.error(572,
                        t.bulk_modulus.given ? t.bulk_modulus.place
                        : t.tension.given    ? t.tension.place
                                             : place,
                        "cells of '" + name + "' would collapse: their volume (K = " + t.bulk_modulus.text +
                            ") does not resist the pressure of their cortical tension (" + t.tension.text + ")",
                        "`bulk_modulus` of at least " + std::string(text) + " (2 tension/radius), or less tension");
  }
}

}  // namespace

void check_resolution(BuildContext& c) {
  check_strong_adhesion(c);
  check_noise(c);
  check_bulk(c);
}

}  // namespace morula::scenarios
