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

std::string active_study() {
  return R"(schema: 1
study: active
seed: 5
time: {end: 60 s, output: 15 s, checkpoint: 15 s, step: 5 s}
domain: {size: [160 um, 160 um, 160 um], boundary: open}
contact:
  range: 1.2 um
  friction: objective
  pairs:
    - between: [wall, wall]
      regions: [{faces: [inner, any], adhesion: 2e-5 J/m^2}]
    - between: [crawler, floor]
      regions: [{faces: [front, any], adhesion: 2e-4 J/m^2}]
cell_types:
  wall:
    radius: 6 um
    adhesion: {wall: 1e-4 J/m^2, crawler: 5e-5 J/m^2, floor: 2e-5 J/m^2}
    friction: {medium: 1e8 N s/m^3, medium_tangential: 3e7 N s/m^3, cell_cell_tangential: 1e10 N s/m^3}
    fluctuations: {energy: 1e-17 J}
    dcm:
      nodes: 42
      self_contact: 200 nm
      cortex:
        tension: 0.3 mN/m
        lateral_easing: 20 s
        regions:
          inner: {tension: 0.5 mN/m, course: [{time: 20 s, factor: 1}, {time: 47 s, factor: 1.3}]}
          belt: {tension: 0.4 mN/m, amplitude: 30 %, period: 100 s}
          lateral: {tension: 0.2 mN/m}
  crawler:
    radius: 6 um
    adhesion: {crawler: 5e-5 J/m^2, floor: 1e-4 J/m^2}
    migration: {speed: 20 um/h, persistence: 10 min, substrate: floor}
    polarity: {turning: 5 1/h, follow_velocity: 5 min}
    protrusion: {force: 0.2 nN, substrate: floor, contact_area: 10 um^2}
    fluctuations: {energy: 1e-17 J}
    dcm: {nodes: 42, cortex: {tension: 0.3 mN/m}}
geometry:
  floor: {plane: {center: [0 um, 0 um, -30 um], normal: [0, 0, 1], size: 150 um}}
initial:
  - type: wall
    at: [[0 um, 6.23 um, 10.08 um], [0 um, -6.23 um, 10.08 um], [0 um, 6.23 um, -10.08 um], [0 um, -6.23 um, -10.08 um],
         [6.23 um, 10.08 um, 0 um], [-6.23 um, 10.08 um, 0 um], [6.23 um, -10.08 um, 0 um], [-6.23 um, -10.08 um, 0 um],
         [10.08 um, 0 um, 6.23 um], [-10.08 um, 0 um, 6.23 um], [10.08 um, 0 um, -6.23 um], [-10.08 um, 0 um, -6.23 um]]
    as: shell
  - {type: crawler, at: [[40 um, 0 um, -24.2 um], [52 um, 0 um, -24.2 um]], as: shell}
  - {type: crawler, at: [[40 um, 40 um, -24.2 um], [51 um, 40 um, -24.2 um], [60 um, 40 um, -10 um]], as: sphere}
marks:
  inner: {types: [wall], cone: {toward: [0 um, 0 um, 0 um], angle: 60 deg}}
  belt: {types: [wall, crawler], band: {axis: [0, 0, 1], half_width: 1.5 um}, when: always}
  front: {types: [crawler], cone: {polarity: true, angle: 40 deg}, when: always}
  floored: {types: [crawler], touched_by: {material: floor, keep: true}}
  low: {types: [wall], ball: {center: [0 um, 0 um, -12 um], radius: 8 um}}
lumens:
  cavity: {center: [0 um, 0 um, 0 um], pressure: 20 Pa, solute: kept, reach: 40 um, renewed: 20 s, from: 10 s}
apical:
  inside: {mark: inner, stiffness: 20 Pa/um, friction: 1e8 N s/m^3}
coupling:
  regions:
    - {name: late, shape: sphere, center: [60 um, 40 um, -10 um], radius: 10 um, as: shell, from: 40 s}
output: {report: false}
)";
}

std::string moulded_study() {
  return R"(schema: 1
study: moulded
time: {end: 40 min, output: 400 s, checkpoint: 400 s}
domain: {size: [90 um, 72 um, 108 um]}
cell_types:
  shell:
    body: shell
    cycle: {model: volume_threshold, duration: {mean: 40 min, spread: 10 %}, growth: linear, size: {control: sizer, spread: 5 %}, axis: long, shells: wait}
    inhibit_growth: {pressure_above: never}
    adhesion: {others: 0 mN/m}
    cbm: {young: 0.5 kPa}
    dcm: {nodes: 42, shape_stiffness: 0.02 mN/m, bulk_modulus: 10 kPa, cortex: {tension: 0.1 mN/m}}
  ball:
    radius: {mean: 6 um, spread: 3 %}
    cycle: {model: phases, phases: {g1: {duration: 8 min, law: gaussian, spread: 30 %}, s: {duration: 8 min, law: fixed}, m: {duration: 3 min, law: fixed}}, axis: across_direction, direction: [-0.905, -0.099, -0.414], daughters: {fates: [{share: 50 %, types: [shell, shell]}, {share: 50 %, types: [ball, shell]}]}, arrest: {contact: {from: 0.2, to: 0.6}}}
    inhibit_growth: {pressure_above: never}
    adhesion: {others: 0 mN/m}
    dcm: {nodes: 42, bulk_modulus: 1 kPa, cortex: {elastic: none, tension: 0.2 mN/m}}
contact: {range: 1.2 um}
initial: [{types: {shell: 40 %, ball: 60 %}, count: 5, fill: sphere, radius: 13.38 um, as: sphere}]
geometry: {mould: {capsule: {from: [-8 um, 0 um, 0 um], to: [8 um, 0 um, 0 um], radius: 20 um}, side: inside}}
output: {report: false}
)";
}

std::string lone_cell_study() {
  return R"(schema: 1
study: lone
time: {end: 2 min, output: 20 s, checkpoint: 20 s}
domain: {size: [60 um, 60 um, 60 um]}
cell_types: {a: {radius: 6 um, body: shell}}
initial:
  - {type: a, at: [[0 um, 0 um, 0 um]]}
output: {report: false}
)";
}

std::string calibrated_study() {
  return "schema: 1\nstudy: small\ntime: {end: 1 h}\ndomain: {size: [80 um, 80 um, 80 um], boundary: open}\n"
         "cell_types: {small: {radius: 5 um, dcm: {nodes: 42}}}\ninitial: [{type: small, at: [[0 um, 0 um, 0 um]]}]\n";
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
