#pragma once
#include <vector>

#include "scenarios/verify/reference_numbers.h"

namespace morula::scenarios {

/// Numbers that are found as a user finds them: the text of a study is read and run, and its results are read back from the files (run_study.h).
void add_study_numbers(std::vector<ReferenceNumber>& out);

/// Those of them that are about contact: a packing under pressure, a sphere pushed onto a shell.
void add_contact_study_numbers(std::vector<ReferenceNumber>& out);
/// And about fields: a slab, balls that consume.
void add_field_study_numbers(std::vector<ReferenceNumber>& out);

/// Of the suite `life`: populations that grow by their cycles and laws of growth,
void add_cycle_study_numbers(std::vector<ReferenceNumber>& out);
/// what holds cells back,
void add_arrest_study_numbers(std::vector<ReferenceNumber>& out);
/// and shells that divide.
void add_division_study_numbers(std::vector<ReferenceNumber>& out);

/// Of the suite `hybrid`: where spheres and shells touch,
void add_interface_study_numbers(std::vector<ReferenceNumber>& out);
/// cells that exchange their bodies,
void add_exchange_study_numbers(std::vector<ReferenceNumber>& out);
/// and whole tissues of both beside those of one.
void add_hybrid_tissue_numbers(std::vector<ReferenceNumber>& out);

}  // namespace morula::scenarios
