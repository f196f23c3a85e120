#pragma once
#include <optional>

#include "core/mesh/triangle_mesh.h"
#include "study/draft.h"
#include "study/study.h"

namespace morula::scenarios {

/// What the steps from the draft to the model share. Each step checks its part against the rest of the study (E4xx, E5xx, E6xx) and fills the
/// model; it runs even when other parts have errors, and looks only at values that are known.
struct BuildContext {
  draft::Study& draft;
  Study& study;
  Diagnostics& diagnostics;
  std::filesystem::path folder;  ///< of the study, for relative paths
  const ReadOptions& options;
  std::filesystem::path shown_folder;  ///< the same as the user wrote it, for messages; empty: the study is no file

  /// A path of the study as messages name it, so that the place can be opened from where the program was started.
  [[nodiscard]] std::string shown(const std::string& written) const {
    return std::filesystem::path(written).is_relative() ? (shown_folder / written).lexically_normal().string() : written;
  }
};

void build_time_and_numerics(BuildContext& context);
void build_domain(BuildContext& context);
void build_cell_types(BuildContext& context);
/// The shell of one cell type, or of a nucleus, and whether its laws go together: E513–E515.
dcm::ShellParameters build_shell(BuildContext& context, const std::string& type_name, const draft::ShellKeys& draft,
                                 double medium_friction);
/// The law of `cbm: {law: fitted}`: what its file says goes into the sphere, and as text into the draft, where the study says nothing else: E510, E515,
/// E516, E532 and those of read_fitted_law(). Before build_packing().
void build_fitted_law(BuildContext& context, const std::string& type_name, draft::CellType& draft, cbm::SphereParameters& sphere);
/// Whether the types with fitted laws are of the materials that were fitted, and their cells of the sizes: E532, E534. After `resolved_text`.
void check_fitted_laws(BuildContext& context);
/// The pressure of packing of one cell type's spheres: E515, E530, E531; empty where there is none.
cbm::PackingCurve build_packing(BuildContext& context, const std::string& type_name, const draft::CellType& draft);
void build_geometry(BuildContext& context);
/// The prescribed way of an obstacle over time.
void build_motion_course(BuildContext& context, const draft::Obstacle& draft, ObstacleSpec& obstacle);
/// Osmosis of a cell type: E535, E536.
void build_osmosis(BuildContext& context, const draft::CellType& draft, CellType& type);
/// Nucleus and links of the shells of a type: E111, E537–E540, E590–E593.
dcm::InteriorParameters build_interior(BuildContext& context, const draft::CellType& draft, const std::string& type_name);
/// Mean edge of an icosphere of this many nodes whose enclosed volume is that of a sphere of radius 1; 0 for another number of nodes.
double mean_edge(std::uint64_t nodes);
/// Distance at which shells of a type touch themselves: E582 [µm].
double build_self_contact(BuildContext& context, const draft::CellType& draft);
/// Quality below which the meshes of a type are renewed; what hangs on their nodes is an error. `type`: with its shell and interior.
double build_mesh_renewal(BuildContext& context, const draft::CellType& draft, const CellType& type);
/// Whether shells of a type may have connectivity of their own; `type` has its renew_mesh_below.
bool build_own_mesh(BuildContext& context, const draft::CellType& draft, const CellType& type);
/// The points of a course as a table; E510 where their times do not increase, or there is only one.
TimeCourse build_course(BuildContext& context, const std::vector<Named<draft::CoursePoint>>& points);
/// Marks of faces, tension by region, cavities, springs: E555–E557; after types, obstacles, pairs and domain.
void build_regions(BuildContext& context);
/// Growth, phases and division of a cell type: E302, E510, E515, E558, E700–E703.
void build_cycle(BuildContext& context, const draft::CellType& draft, const Place& type_place, CellType& type);
/// Types and polarities of daughters; after all types are there.
void build_fates(BuildContext& context, const draft::CellType& draft, CellType& type);
/// Its phases and quiescence, after growth and size: E112, E510, E515, E516, E700, E702, E703.
void build_phases(BuildContext& context, const draft::CellType& draft, CellType& type);
/// The factors of the rate of a phase.
std::vector<CellArrest> build_phase_arrest(BuildContext& context, const draft::CyclePhase& phase, const Place& place);
/// What the cells of a type do by behaviours of the registry: E103, E515, and what these say.
void build_behaviours(BuildContext& context, const draft::CellType& draft, const Place& type_place, CellType& type);
/// Fluctuations, polarity, protrusion, what migrates on what, directions of friction: E558; after types and obstacles.
void build_activity(BuildContext& context);
/// External loads; after the cells of time 0.
void build_loads(BuildContext& context);
/// After all that acts on cells.
void build_tolerance(BuildContext& context);
/// Adhesion and friction of all pairs of materials; missing pairs get their default, in the draft, too.
void build_pairs(BuildContext& context);
/// What `contact.pairs` says of them, after build_pairs(): E515–E517.
void build_contact_pairs(BuildContext& context);
/// Adhesion by marks, after build_contact_pairs() and build_regions(): E580, E581.
void build_adhesion_regions(BuildContext& context);
/// `contact.repulsion` as a number, that of pairs which do not ask for more where it is `auto` [kPa/µm].
double usual_repulsion(const draft::Study& study);
/// Repulsion of pairs that adhere strongly, where the study leaves it open; after all that is said of adhesion.
void build_repulsion(BuildContext& context);
void build_fields(BuildContext& context);
void build_initial(BuildContext& context);
void build_coupling(BuildContext& context);
/// Criteria and plots as they are given, with the files of their data; whether they can be judged is asked by ReadOptions::check_criteria.
void build_criteria(BuildContext& context);
/// Checks that need the whole study: contact range, friction, step, domain size.
void check_whole(BuildContext& context);
/// Measured limits of meshes under strong adhesion, and cells whose volume does not bear their tension: E571, E572.
void check_resolution(BuildContext& context);
/// What bodies do not do: shells that wait, adhesion of spheres beyond JKR: E646, E647.
void check_bodies(BuildContext& context);
/// Rules that no cell ever meets, or that are never asked: W694.
void check_rules(BuildContext& context);
/// Keys that nothing reads in this study: W515.
void check_unused(BuildContext& context);

/// Index of a cell type or field by name, or −1 and an error with suggestions.
int find_type(BuildContext& context, const std::string& name, const Place& place);
/// Index of a cell type, or of an obstacle after the types, by name; −1 and an error with suggestions.
int find_cell_or_obstacle(BuildContext& context, const std::string& name, const Place& place);
/// Bit of a mark by name; −1 and an error with suggestions.
int find_mark(BuildContext& context, const std::string& name, const Place& place);
/// Number of an obstacle by name; −1 and an error with suggestions.
int find_obstacle(BuildContext& context, const std::string& name, const Place& place);
/// Whether a region of bodies that was built already, a cell type or an obstacle has this name: 0, or −1 and E401.
int find_cells(BuildContext& context, const std::string& name, const Place& place);
/// Whether shells of a material ever carry a mark, after build_regions(); obstacles do not.
bool may_carry_mark(const BuildContext& context, int material, int mark);
/// The places of all cells, found as the run finds them and judged: E505, E596, E597, E658, E659, E661; after all else, without errors only.
void check_places(BuildContext& context);
/// Whether a shell resists being stretched in its plane by anything but its tension.
bool resists_in_plane(const draft::ShellKeys& t);
/// Whether cells of a type may be shells at some time: by the type, as they begin, by fates or by coupling; after build_initial().
bool may_be_shell(const BuildContext& context, std::size_t type);
/// The types whose cells this one may come of by the fates of daughters, itself first.
std::vector<std::size_t> origins_of(const draft::Study& draft, std::size_t type);
int find_field(BuildContext& context, const std::string& name, const Place& place);
/// Whether cells of any type may.
bool may_have_shells(const BuildContext& context);
/// K_V of the ideal filled cell: that of packing, or of the cell as a shell (`bulk_modulus: shell`) [kPa].
double packing_modulus(const draft::CellType& type);
/// Note a file the study refers to; `written` is replaced by the place of its copy, for the resolved study.
std::string add_input_file(BuildContext& context, Given<std::string>& written);
/// Read the closed surface of an STL or OBJ file, in µm, and check it: E601–E602 and E620–E624; then the mesh is empty.
TriangleMesh surface_from_file(BuildContext& context, Given<std::string>& written, const Given<double>& scale);
/// Largest explicit Euler step that is stable for the types of this study [s] (estimate).
double explicit_step_limit(const BuildContext& context);

}  // namespace morula::scenarios
