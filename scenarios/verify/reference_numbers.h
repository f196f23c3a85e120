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
  std::function<double()> compute;  ///< takes milliseconds
};

/// The reference numbers of the laws of shells and spheres: `morula verify physics` prints them, and a test holds them.
/// A number belongs here when it is not ours; to add one, add a line.
std::vector<ReferenceNumber> physics_numbers();

/// Those of water, nucleus and cytoskeleton.
void add_interior_numbers(std::vector<ReferenceNumber>& out);
/// Those of contacts and pipettes (contact_numbers.cpp), which physics_numbers() adds.
void add_contact_numbers(std::vector<ReferenceNumber>& out);
/// Those of what acts on marked faces and single nodes (verify/active_numbers.cpp), appended.
void add_active_numbers(std::vector<ReferenceNumber>& out);

}  // namespace morula::scenarios
