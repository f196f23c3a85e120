#pragma once
#include <functional>
#include <string>
#include <vector>

namespace morula::scenarios {

/// A number that is known in closed form or was published or computed independently, and how this program finds it.
struct ReferenceNumber {
  std::string id;        ///< of the test it belongs to, as `T4.1`
  std::string quantity;  ///< in words, with its unit
  double reference = 0.0;
  double tolerance = 0.0;  ///< largest |difference|: the digits of the reference, or what the mesh explains
  std::string source;
  std::function<double()> compute;  ///< takes milliseconds, seconds where statistics are needed
  double aim = 0.0;                 ///< largest |difference| that is wanted, where it is not met yet; 0: the tolerance is what is wanted
};

/// The reference numbers of the laws of shells and spheres: `morula verify physics` prints them, and a test holds those of all suites (suites.h).
/// A number belongs here when it is not ours; to add one, add a line.
std::vector<ReferenceNumber> physics_numbers();

/// Those of the sections of dcm.md, one file for each, which physics_numbers() puts together.
void add_friction_numbers(std::vector<ReferenceNumber>& out);          ///< 1
void add_membrane_numbers(std::vector<ReferenceNumber>& out);          ///< 2
void add_bending_numbers(std::vector<ReferenceNumber>& out);           ///< 3
void add_tension_numbers(std::vector<ReferenceNumber>& out);           ///< 4
void add_volume_numbers(std::vector<ReferenceNumber>& out);            ///< 5
void add_osmosis_numbers(std::vector<ReferenceNumber>& out);           ///< 6
void add_contact_numbers(std::vector<ReferenceNumber>& out);           ///< 7, and pipettes
void add_contact_friction_numbers(std::vector<ReferenceNumber>& out);  ///< 9
void add_fluctuation_numbers(std::vector<ReferenceNumber>& out);       ///< 10
void add_migration_numbers(std::vector<ReferenceNumber>& out);         ///< 11
void add_interior_numbers(std::vector<ReferenceNumber>& out);          ///< 12
void add_growth_numbers(std::vector<ReferenceNumber>& out);            ///< 13
void add_active_numbers(std::vector<ReferenceNumber>& out);            ///< 15
void add_sphere_numbers(std::vector<ReferenceNumber>& out);            ///< of cbm.md

}  // namespace morula::scenarios
