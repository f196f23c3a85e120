#pragma once
#include "scenarios/study/draft.h"

namespace morula::scenarios {

/// The one table of all keys of the study file: name, quantity, range, default, source, doc, example.
void declare_study(Section& section, draft::Study& study);

void declare_cell_type(Section& section, draft::CellType& type);
void declare_shell(Section& section, draft::CellType& type);
void declare_obstacle(Section& section, draft::Obstacle& obstacle);
/// `direction` and `course` of an obstacle's motion.
void declare_motion_course(Section& section, draft::Obstacle& obstacle);
void declare_contact(Section& section, draft::Contact& contact);
void declare_load(Section& section, draft::Load& load);
void declare_initial(Section& section, draft::Initial& initial);
void declare_field(Section& section, draft::Field& field);
void declare_coupling(Section& section, draft::Coupling& coupling);

}  // namespace morula::scenarios
