#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "dcm/builtin.h"
#include "tests/dcm/shell_fixtures.h"

namespace morula::dcm::testing {
namespace {

/// Two cell types in which only this law acts.
std::vector<ShellParameters> only(const ShellLaw& law) {
  std::vector<ShellParameters> types(2, nothing());
  law.strength().in(types[0]) = 0.7;
  law.strength().in(types[1]) = 1.1;
  for (ShellParameters& p : types) {
    p.barrier_angle = 0.2;  // so low that it acts on most edges of a sphere
    p.spontaneous_curvature = 0.2;
  }
  set_area_ratio(types[1], 0.6);
  return types;
}

std::vector<ShellLaw> conservative_laws() {
  std::vector<ShellLaw> out;
  for (const ShellLaw& law : shell_laws()) {
    if (law.conservative) out.push_back(law);
  }
  return out;
}

class EveryShellLaw : public ::testing::TestWithParam<ShellLaw> {};

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST_P(EveryShellLaw, ForceIsMinusTheGradientOfItsEnergy) {
  Shells shells = rough_shells();
  for (double& v : shells.reference_volume) v *= 1.1;
  const auto types = only(GetParam());
  const auto at = mechanics(shells, types, shells.position);
  ASSERT_GT(norm(at.force), 1e-3);
  for (int trial = 0; trial < 20; ++trial) {
    auto direction = random_vectors(shells.position.size(), 100 + trial);
    const double scale = 1.0 / norm(direction), h = 2e-4;
    for (Vec3d& d : direction) d *= scale;
    const auto slope = [&](double step) {
      return (sum(mechanics(shells, types, moved(shells.position, direction, step)).energy) -
              sum(mechanics(shells, types, moved(shells.position, direction, -step)).energy)) /
             (2.0 * step);
    };
    EXPECT_NEAR(slope(h), -dot(at.force, direction), 1e-7 * norm(at.force));
  }
}

TEST_P(EveryShellLaw, ExertsNeitherNetForceNorTorque) {
  const Shells shells = rough_shells();
  const auto at = mechanics(shells, only(GetParam()), shells.position);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    Vec3d force{}, torque{};
    double size = 0.0;
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i) {
      const Vec3d arm = shells.position[i] - shells.position[shells.first_node[s]];
      force += at.force[i];
      torque += cross(arm, at.force[i]);
      size += morula::norm(at.force[i]);
    }
    ASSERT_GT(size, 0.0);
    EXPECT_LE(morula::norm(force), 1e-12 * size);
    EXPECT_LE(morula::norm(torque), 1e-12 * 12.0 * size);
  }
}

TEST_P(EveryShellLaw, DoesNotFeelRigidMotion) {
  const Shells shells = rough_shells();
  const auto types = only(GetParam());
  const auto at = mechanics(shells, types, shells.position);
  const double c = std::cos(0.9), s = std::sin(0.9);
  const auto turn = [&](const Vec3d& v) { return Vec3d{c * v.x - s * v.y, s * v.x + c * v.y, v.z}; };
  std::vector<Vec3d> x = shells.position;
  for (Vec3d& v : x) v = turn(v) + Vec3d{3.0, -7.0, 11.0};
  const auto there = mechanics(shells, types, x);
  for (std::size_t k = 0; k < shells.size(); ++k) EXPECT_NEAR(there.energy[k], at.energy[k], 3e-12 * (1.0 + at.energy[k]));
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LE(morula::norm(there.force[i] - turn(at.force[i])), 1e-11 * norm(at.force));
}

TEST_P(EveryShellLaw, GivesTheSameBitsInOneFourAndEightLanes) {
  const Shells shells = rough_shells();
  const auto types = only(GetParam());
  const auto one = mechanics(shells, types, shells.position, 1);
  for (const int lanes : {4, 8}) {
    const auto many = mechanics(shells, types, shells.position, lanes);
    EXPECT_TRUE(same_bits(one.energy, many.energy)) << lanes << " lanes";
    EXPECT_TRUE(same_bits(one.volume, many.volume)) << lanes << " lanes";
    EXPECT_TRUE(same_bits(one.pressure, many.pressure)) << lanes << " lanes";
    EXPECT_EQ(one.force, many.force) << lanes << " lanes";
  }
}

/// dcm.md §16.4: neither the order of the shells, of which eight share lanes, nor the numbers of nodes and faces matter.
TEST_P(EveryShellLaw, GivesTheSameBitsInAnyOrderOfShells) {
  const Shells shells = rough_shells();
  Shells turned;
  for (std::size_t s = shells.size(); s-- > 0;) {
    add_shell(turned, shells.shape[s], shells.rest_volume[s], {}, shells.type[s]);
    turned.reference_volume.back() = shells.reference_volume[s];
    std::copy(shells.nodes(s).begin(), shells.nodes(s).end(), turned.nodes(turned.size() - 1).begin());
  }
  const auto types = only(GetParam());
  const auto at = mechanics(shells, types, shells.position), there = mechanics(turned, types, turned.position);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const std::size_t place = shells.size() - 1 - s;
    EXPECT_EQ(there.energy[place], at.energy[s]);
    for (std::uint32_t i = 0; i < shells.topology(s).node_count(); ++i)
      EXPECT_EQ(there.force[turned.first_node[place] + i], at.force[shells.first_node[s] + i]) << "shell " << s;
  }
}

TEST_P(EveryShellLaw, DoesNotKnowTheNumbersOfNodesAndFaces) {
  const auto shape = icosphere(162);
  std::mt19937_64 engine(13);
  std::vector<std::uint32_t> place(162);  // of each node in the other numbering
  for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), engine);
  std::vector<Triangle> faces;
  for (const Triangle& t : shape->topology->faces()) {
    const std::size_t first = engine() % 3;
    faces.push_back({place[t[first]], place[t[(first + 1) % 3]], place[t[(first + 2) % 3]]});
  }
  std::shuffle(faces.begin(), faces.end(), engine);
  std::vector<Vec3d> reference(162);
  for (std::size_t i = 0; i < place.size(); ++i) reference[place[i]] = shape->position[i];
  Shells shells = one_shell(162), renamed;
  add_shell(renamed, make_reference_shape(Topology::build(162, faces).value(), reference), sphere_volume(6.0));
  for (Shells* each : {&shells, &renamed}) each->reference_volume[0] *= 1.1;
  const auto noise = random_vectors(162, 8);
  for (std::size_t i = 0; i < place.size(); ++i) shells.position[i] += 0.12 * noise[i];
  for (std::size_t i = 0; i < place.size(); ++i) renamed.position[place[i]] = shells.position[i];
  const auto types = only(GetParam());
  const auto at = mechanics(shells, types, shells.position), there = mechanics(renamed, types, renamed.position);
  ASSERT_GT(norm(at.force), 1e-3);
  EXPECT_NEAR(there.energy[0], at.energy[0], 1e-12 * std::abs(at.energy[0]));
  for (std::size_t i = 0; i < place.size(); ++i) EXPECT_LE(morula::norm(there.force[place[i]] - at.force[i]), 1e-12 * norm(at.force));
}

TEST_P(EveryShellLaw, GivesNothingToTheShellsOfATypeWithoutIt) {
  const Shells shells = rough_shells();
  auto types = only(GetParam());
  const auto both = mechanics(shells, types, shells.position);
  GetParam().strength().in(types[1]) = 0.0;
  const auto one = mechanics(shells, types, shells.position);  // types 0 and 1 share lanes
  for (std::size_t s = 0; s < shells.size(); ++s) {
    const bool has = shells.type[s] == 0;
    EXPECT_EQ(one.energy[s], has ? both.energy[s] : 0.0);
    for (std::uint32_t i = shells.first_node[s]; i < shells.first_node[s + 1]; ++i)
      EXPECT_EQ(one.force[i], has ? both.force[i] : Vec3d{}) << "shell " << s;
  }
}

TEST_P(EveryShellLaw, IsSilentInTheReferenceShapeWhereItHasOne) {
  const Shells shells = one_shell(162);
  auto types = only(GetParam());
  for (ShellParameters& p : types) p.barrier_angle = 1.6;
  const auto at = mechanics(shells, types, shells.position);
  if (GetParam().zero_in_reference) {
    EXPECT_LE(norm(at.force), 1e-11);
    EXPECT_LE(std::abs(at.energy[0]), 1e-11);
  } else {
    EXPECT_GT(norm(at.force), 1e-3);
  }
}

TEST_P(EveryShellLaw, ForceIsProportionalToItsStrength) {
  const Shells shells = rough_shells();
  auto types = only(GetParam());
  const auto once = mechanics(shells, types, shells.position);
  for (ShellParameters& p : types) GetParam().strength().in(p) *= 2.0;
  const auto twice = mechanics(shells, types, shells.position);
  for (std::size_t i = 0; i < once.force.size(); ++i) {
    EXPECT_LE(morula::norm(twice.force[i] - 2.0 * once.force[i]), 1e-14 * norm(once.force));
  }
}

TEST_P(EveryShellLaw, EnergyScalesWithTheSizeOfTheCellAsItsUnitsSay) {
  // Energy ∝ size^n at fixed coefficients: [nN·µm] = [coefficient] · µm^n.
  const std::map<std::string, int> exponent{{"nN/µm", 2}, {"nN·µm", 0}, {"kPa", 3}};
  const int n = exponent.at(GetParam().info.parameters.front().unit);
  Shells shells = rough_shells();
  auto types = only(GetParam());
  const auto at = mechanics(shells, types, shells.position);
  const double scale = 1.7;
  for (ShellParameters& p : types) p.spontaneous_curvature /= scale;
  for (Vec3d& x : shells.position) x *= scale;
  for (double& length : shells.rest_length) length *= scale;
  for (double& volume : shells.rest_volume) volume *= scale * scale * scale;
  for (double& volume : shells.reference_volume) volume *= scale * scale * scale;
  const auto larger = mechanics(shells, types, shells.position);
  for (std::size_t s = 0; s < shells.size(); ++s) {
    EXPECT_NEAR(larger.energy[s], std::pow(scale, n) * at.energy[s], 1e-11 * std::pow(scale, n) * (1.0 + at.energy[s]));
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryShellLaw, ::testing::ValuesIn(conservative_laws()),
                         [](const auto& test) { return test.param.info.name; });

TEST(InternalForces, HaveTheSameBitsOnAnyNumberOfThreads) {
  const Shells shells = rough_shells();
  ShellParameters p;
  p.spring_stiffness = 0.17, p.hinge_stiffness = 1e-3, p.tension = 0.5, p.barrier_angle = 0.5;
  const std::vector<ShellParameters> types{p, p};
  const auto one = mechanics(shells, types, shells.position);
  ShellBlocks blocks = make_shell_blocks(shells);
  blocks.threads = 3;
  ShellMechanics three;
  internal_forces(blocks, shells, types, shells.position, three);
  EXPECT_EQ(one.force, three.force);
  EXPECT_EQ(one.energy, three.energy);
  EXPECT_EQ(one.volume, three.volume);
}

TEST(ShellLawRegistry, DescribesEveryLawCompletely) {
  std::vector<std::string> names;
  for (const ShellLaw& law : shell_laws()) {
    EXPECT_FALSE(law.info.name.empty() || law.info.title.empty() || law.info.equation.empty() || law.info.source.empty());
    ASSERT_EQ(law.info.parameters.size(), law.sheet ? law.sheet->coefficient_count : law.coefficients.size()) << law.info.name;
    EXPECT_FALSE(law.info.parameters.empty()) << law.info.name;
    for (const LawParameter& p : law.info.parameters)
      EXPECT_FALSE(p.name.empty() || p.quantity.empty() || p.unit.empty() || p.source.empty() || p.doc.empty()) << law.info.name;
    EXPECT_FALSE(law.info.keys.empty()) << law.info.name;
    for (const LawKey& key : law.info.keys) {
      EXPECT_FALSE(key.section.empty() || key.spec.doc.empty()) << law.info.name;
      EXPECT_LT(key.spec.low, key.spec.high) << key.spec.name;
      EXPECT_NE(*key.spec.example, '\0') << key.spec.name;
      EXPECT_TRUE(key.spec.fallback == nullptr || *key.spec.source != '\0') << key.spec.name;
    }
    EXPECT_TRUE(law.build != nullptr || !law.words.empty()) << "a study can choose " << law.info.name;
    names.push_back(law.info.name);
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end()) << "names are unique";
}

}  // namespace
}  // namespace morula::dcm::testing
