#pragma once
#include "study/draft.h"

namespace morula::scenarios {

/// The one table of all keys of the study file: name, quantity, range, default, source, doc, example.
void declare_study(Section& section, draft::Study& study);

void declare_cell_type(Section& section, draft::CellType& type);
/// `mean` and `spread` of a number that varies from cell to cell.
/// `spread` alone, `most` at the most.
void declare_relative_spread(Section& s, draft::Spread& value, double most);
/// `correlation` of a daughter with her mother, beside `spread`.
void declare_correlation(Section& s, draft::Spread& value);
void declare_spread(Section& section, draft::Spread& value, Quantity quantity, const char* mean, const char* doc, const char* source,
                    double low, double high);
/// `cycle` of a cell type.
void declare_cycle(Section& section, draft::CellType& type);
void declare_shell(Section& section, draft::CellType& type);
/// Mesh and mechanics of a shell; `cell` is null for those of a nucleus, whose defaults are others and which has no regions.
void declare_shell_keys(Section& section, draft::ShellKeys& shell, draft::CellType* cell);
/// `cbm.law` of a law in a file of `morula calibrate`, and `cbm.packing.law` of the packing in it.
inline constexpr const char* kFittedLaw = "fitted";
/// `cbm.packing`.
void declare_packing(Section& section, draft::CellType& type);
/// `regions` and `lateral_easing` of the cortex.
void declare_tension_regions(Section& section, draft::CellType& type);
void declare_mark(Section& section, draft::Mark& mark);
void declare_lumen(Section& section, draft::Lumen& lumen);
void declare_apical_spring(Section& section, draft::ApicalSpring& spring);
/// `migration` of a cell type.
void declare_migration(Section& section, draft::CellType& type);
/// `fluctuations`, `polarity` and `protrusion` of a cell type.
void declare_activity(Section& section, draft::CellType& type);
void declare_obstacle(Section& section, draft::Obstacle& obstacle);
/// `direction` and `course` of an obstacle's motion.
void declare_motion_course(Section& section, draft::Obstacle& obstacle);
void declare_contact(Section& section, draft::Contact& contact);
void declare_load(Section& section, draft::Load& load);
/// A point of a factor over time.
void declare_course_point(Section& section, draft::CoursePoint& point);
/// A point of a distance over time.
void declare_distance_point(Section& section, draft::CoursePoint& point);
/// The keys of the behaviours whose section this is; the section may have others as well.
void declare_behaviour_keys(Section& section, const std::string& name, draft::CellType& type);
/// The sections of all behaviours but these, which are declared elsewhere.
void declare_behaviours(Section& section, const std::vector<std::string>& but, draft::CellType& type);
/// `nucleus` and `cytoskeleton` of a shell.
void declare_interior(Section& section, draft::CellType& type);
/// `osmosis` of a cell type.
void declare_osmosis(Section& section, draft::CellType& type);
void declare_initial(Section& section, draft::Initial& initial);
void declare_meshes(Section& section, draft::Meshes& meshes);
void declare_field(Section& section, draft::Field& field);
void declare_coupling(Section& section, draft::Coupling& coupling);
void declare_criterion(Section& section, Criterion& criterion);
void declare_study_plot(Section& section, StudyPlot& plot);

}  // namespace morula::scenarios
