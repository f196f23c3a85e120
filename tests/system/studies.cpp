#include "tests/system/studies.h"

#include <gtest/gtest.h>

#include <array>

namespace morula::test {

std::string sphere_study() {
  return R"(schema: 1
study: small
seed: 7
time: {end: 2 h, output: 10 min, checkpoint: 30 min}
domain: {size: [200 um, 200 um, 200 um], boundary: open}
cell_types:
  round:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 4 h, spread: 10 %}}
    adhesion: {round: 1e-4 J/m^2}
    cbm: {law: jkr, young: 450 Pa, poisson: 0.4}
initial:
  - {type: round, count: 20, fill: sphere, radius: 20 um, as: sphere}
output: {report: false}
)";
}

std::string hybrid_study() {
  return R"(schema: 1
study: hybrid
seed: 11
time: {end: 40 min, output: 5 min, checkpoint: 10 min}
domain: {size: [120 um, 120 um, 120 um], boundary: open}
cell_types:
  cell:
    radius: {mean: 5 um, spread: 5 %}
    cycle: {duration: {mean: 3 h, spread: 10 %}}
    migration: {speed: 2 um/h, persistence: 30 min}
    adhesion: {cell: 1e-4 J/m^2}
    cbm: {law: jkr, young: 450 Pa, poisson: 0.4}
    dcm:
      nodes: 162
      cortex: {young: 1 kPa, thickness: 200 nm, tension: 0.2 mN/m}
      bulk_modulus: 2.5 kPa
initial:
  - {type: cell, count: 30, fill: sphere, radius: 20 um, as: sphere}
fields:
  oxygen: {diffusion: 2e-9 m^2/s, initial: 0.2 mM, boundary: {all: 0.2 mM}, uptake: {cell: 40 amol/s}}
coupling:
  regions:
    - {name: core, shape: sphere, center: [0 um, 0 um, 0 um], radius: 7 um, as: dcm, margin: 3 um}
output: {report: false}
)";
}

std::string interior_study() {
  const std::string inside = R"(      bulk_modulus: 2.5 kPa
      nucleus: {radius: 2 um}
      cytoskeleton:
        nucleus_links: {number: 40, stiffness: 0.01 nN/um, damping: 1e-5 N s/m}
        cortex_links: {stiffness: 0.005 nN/um, tension_only: true}
    osmosis: {permeability: 1e-13 m/s/Pa, field: oxygen, course: [{time: 4 min, factor: 1}, {time: 7 min, factor: 0.8}]}
)";
  std::string text = changed(hybrid_study(), "      bulk_modulus: 2.5 kPa\n", inside);
  return changed(changed(text, "end: 40 min", "end: 16 min"), "checkpoint: 10 min", "checkpoint: 5 min");
}

std::string loaded_study() {
  return R"(schema: 1
study: loaded
time: {end: 60 s, output: 10 s, checkpoint: 20 s}
domain: {size: [120 um, 60 um, 60 um], boundary: open}
cell_types:
  pulled: {radius: 6 um, dcm: {nodes: 42, cortex: {tension: 0.1 mN/m}}}
  lit: {radius: 6 um, dcm: {nodes: 42, cortex: {tension: 0.1 mN/m}}}
  squeezed: {radius: 6 um, dcm: {nodes: 42, cortex: {tension: 0.1 mN/m}}}
  stone: {radius: 6 um}
contact: {range: 1 um}
geometry:
  plate:
    plane: {center: [0 um, 0 um, 6.5 um], normal: [0, 0, -1], size: 100 um}
    motion: {direction: [0, 0, -1], course: [{time: 5 s, distance: 0 um}, {time: 33 s, distance: 0.8 um}]}
initial:
  - {type: pulled, at: [[-40 um, 0 um, 0 um], [-20 um, 0 um, 0 um]], as: shell, orientation: aligned}
  - {type: lit, at: [[0 um, 0 um, 0 um]], as: shell}
  - {type: squeezed, at: [[20 um, 0 um, 0 um]], as: shell, orientation: aligned}
  - {type: stone, at: [[40 um, 0 um, -12 um]], as: sphere}
loads:
  beads: {type: pulled, pull: {force: 200 pN, axis: [1, 1, 0], part: 5 %}, course: [{time: 0 s, factor: 0}, {time: 17 s, factor: 1}, {time: 41 s, factor: 0.5}]}
  light: {type: lit, traction: {peak: 2 Pa, axis: [0, 1, 0]}}
  press: {type: squeezed, pressure: {value: 5 Pa, axis: [0, 1, 0], part: 20 %, ends: low}}
  weight: {type: stone, body_force: [0 nN, 0 nN, -1 nN]}
)";
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "the text does not hold: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

namespace {

using Corner = std::array<double, 3>;

std::string cube_facets(double edge, int faces, bool flipped, double shift) {
  constexpr int triangles[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                    {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const double h = edge / 2;
  const Corner corners[8] = {{-h, -h, -h}, {h, -h, -h}, {h, h, -h}, {-h, h, -h}, {-h, -h, h}, {h, -h, h}, {h, h, h}, {-h, h, h}};
  std::string out;
  for (int f = 0; f < faces; ++f) {
    out += "facet normal 0 0 0\n outer loop\n";
    for (int k = 0; k < 3; ++k) {
      const Corner& c = corners[triangles[f][f == 0 && flipped ? 2 - k : k]];
      out += "  vertex " + std::to_string(c[0] + shift) + " " + std::to_string(c[1] + shift) + " " + std::to_string(c[2] + shift) + "\n";
    }
    out += " endloop\nendfacet\n";
  }
  return out;
}

}  // namespace

std::string cube_stl(double edge, int faces, bool flipped) {
  return "solid cube\n" + cube_facets(edge, faces, flipped, 0.0) + "endsolid cube\n";
}

std::string crossing_stl(double edge) {
  return "solid cubes\n" + cube_facets(edge, 12, false, 0.0) + cube_facets(edge, 12, false, 0.3 * edge) + "endsolid cubes\n";
}

}  // namespace morula::test
