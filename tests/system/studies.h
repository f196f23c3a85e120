#pragma once
#include <string>

namespace morula::test {

/// A small tissue of spheres: a second or two of wall time, no randomness left out.
[[nodiscard]] std::string sphere_study();
/// About thirty cells, some of them shells: oxygen, growth, division, promotion by a region.
[[nodiscard]] std::string hybrid_study();
/// Shells that are pulled, stretched and pressed by a moving plate, and a sphere that sinks: every kind of load, with courses.
[[nodiscard]] std::string loaded_study();
/// The hybrid study with nuclei, links and osmosis in a medium that thins out.
[[nodiscard]] std::string interior_study();
/// Shells and spheres with every kind of mark, region of tension, cavity, spring and active force: about 20 cells of 42 nodes about a cavity.
[[nodiscard]] std::string active_study();
/// Spheres in a mould, which divide into shells that press the others around: what obstacles do to them is told after each step.
[[nodiscard]] std::string moulded_study();
/// Shells of few nodes, all else default: type `small`, to be calibrated in seconds.
[[nodiscard]] std::string calibrated_study();
/// One default shell at rest, two minutes.
[[nodiscard]] std::string lone_cell_study();
/// A text with the first `from` replaced by `to`; a test failure when it does not hold `from`.
[[nodiscard]] std::string changed(std::string text, const std::string& from, const std::string& to);

/// A cube as ASCII STL [µm], its faces counter-clockwise seen from outside; `faces` of 12, `flipped` turns the first one.
[[nodiscard]] std::string cube_stl(double edge, int faces = 12, bool flipped = false);
/// Two cubes as one surface, the second moved by half an edge: it crosses itself.
[[nodiscard]] std::string crossing_stl(double edge);

}  // namespace morula::test
