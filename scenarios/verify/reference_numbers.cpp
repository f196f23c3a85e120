#include "scenarios/verify/reference_numbers.h"

#include "dcm/derived_parameters.h"
#include "scenarios/verify/lone_shell.h"
#include "scenarios/verify/study_numbers.h"

namespace morula::scenarios {
namespace {

/// What follows from the values of Table 1 (dcm.md §0).
void add_derived_parameters(std::vector<ReferenceNumber>& out) {
  constexpr const char* kClosedForm = "closed form";
  out.push_back({"dcm 0", "stiffness of the springs, E 1 kPa, h 0.2 um [nN/um]", 0.173205, 5e-7,
                 "Seung & Nelson 1988, doi:10.1103/PhysRevA.38.1005", [] { return dcm::spring_stiffness(kYoung, kThickness); }});
  out.push_back({"dcm 0", "bending rigidity of the cortex, Poisson ratio 0.5 [nN um]", 8.8889e-4, 5e-9, kClosedForm,
                 [] { return dcm::bending_modulus(kYoung, kThickness, kPoisson); }});
  out.push_back({"dcm 0", "stiffness of the hinges [nN um]", 1.02640e-3, 5e-9, kClosedForm,
                 [] { return dcm::hinge_stiffness(kYoung, kThickness, kPoisson); }});
}

}  // namespace

std::vector<ReferenceNumber> physics_numbers() {
  std::vector<ReferenceNumber> out;
  add_derived_parameters(out);
  add_friction_numbers(out);
  add_membrane_numbers(out);
  add_bending_numbers(out);
  add_tension_numbers(out);
  add_volume_numbers(out);
  add_osmosis_numbers(out);
  add_contact_numbers(out);
  add_contact_friction_numbers(out);
  add_fluctuation_numbers(out);
  add_migration_numbers(out);
  add_interior_numbers(out);
  add_growth_numbers(out);
  add_active_numbers(out);
  add_sphere_numbers(out);
  add_study_numbers(out);
  return out;
}

}  // namespace morula::scenarios
