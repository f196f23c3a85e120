#pragma once
#include <array>
#include <map>
#include <vector>

#include "coupling/model.h"
#include "study/criterion.h"
#include "study/draft_own.h"
#include "study/section.h"

namespace morula::scenarios::draft {

/// The study as its file says it, key by key, in internal units: the form between the YAML and the Model. Every struct has one declaration in
/// declare.h and nothing here is looked at by the simulation.

struct Time {
  Given<double> end, step, output, checkpoint, rest;
  Given<std::string> integrator;
};

struct Numerics {
  Given<std::uint64_t> newton;
  Given<double> initial_step, skin, start_cap, start_cap_within, tolerance;
  PlainKeys<StepControl> step;
};

/// `all`, an axis, or one face; the most particular one holds.
struct DomainBoundary {
  Given<std::string> all, x, y, z, x_low, x_high, y_low, y_high, z_low, z_high;
};

struct Domain {
  Given<Vec3d> size, center;
  DomainBoundary boundary;
  std::vector<Named<CoursePoint>> course;
};

struct Spread {
  Given<double> mean, spread, correlation;
};

struct PackingKnot {
  Given<double> packing, pressure;
};

/// Osmotic control of the volume.
struct Osmosis {
  bool present = false;
  Given<double> inactive, inside, outside;
  PlainKeys<morula::Osmosis> law;
  Given<std::string> field;
  std::vector<Named<CoursePoint>> course;
};

/// What a layer of a shell resists: shear and stretch in its plane, bending.
struct Layer {
  Given<std::string> elastic, bending_law;
  Given<double> bending;
  std::map<std::string, Given<double>> own;  ///< keys that the laws of layers have for themselves, by name
};

/// The mesh of a shell and its mechanics: the cortex of a cell or the lamina of a nucleus that is a shell, and perhaps a membrane on it.
struct ShellKeys : Layer {
  Given<std::uint64_t> nodes;
  Given<double> young, thickness, poisson, tension, turnover, damping, isotropic_damping;
  bool has_membrane = false;
  Layer membrane;
  Given<double> local_area, global_area;
  Given<bool> area_on_top;
  Given<double> bulk_modulus, bulk_viscosity, shape_stiffness, fold_stiffness, fold_angle;
};

struct Nucleus {
  bool present = false;
  Given<std::string> kind;
  Given<double> radius, volume_fraction, viscosity;
  ShellKeys shell;                     ///< of `kind: shell`
  std::vector<Named<bool>> no_effect;  ///< keys of a shell that stand where the nucleus is none
};
struct Links {
  bool present = false;
  Given<std::uint64_t> number;
  Given<double> stiffness, damping;
  PlainKeys<dcm::LinkParameters> law;
};

/// A phase of the cycle of a cell type.
struct CyclePhase {
  Given<double> duration, spread;
  Given<std::string> law, until;
  Given<std::uint64_t> stages;
  Given<bool> grows;
  bool has_arrest = false;
  std::map<std::string, OwnSection> arrest;  ///< by name of the factor's section
};

/// What the cycle of a cell type has beside growth and division.
struct Cycle {
  Given<double> ratio;
  Given<std::string> control;
  Given<double> volume, volume_spread;
  std::vector<Named<CyclePhase>> phases;
  bool has_arrest = false;
  std::map<std::string, OwnSection> arrest;  ///< of growth
  bool has_quiescence = false;
  Given<std::string> quiescent_phase;
  Given<double> enter_below, leave_above, hold;
};

struct Fate {
  Given<double> share;
  Given<std::vector<std::string>> types;
};

struct CellType : ShellKeys {
  Given<std::string> like;
  Spread radius;
  Given<std::string> body, color;
  bool has_cycle = false;
  Cycle cycle;
  Given<std::string> cycle_model, growth, axis, shells_divide;
  std::map<std::string, Given<double>> growth_own;  ///< keys that laws of growth have for themselves, by name
  std::vector<Named<Fate>> fates;
  Given<std::string> daughter_polarity;
  OwnSection axis_own;  ///< keys that axes of division have for themselves
  Given<double> axis_spread, new_surface;
  Spread division_share;
  Spread cycle_duration;
  std::array<Spread, kTraits.size()> variation;
  Given<double> pressure_above;
  std::map<std::string, OwnSection> behaviours;  ///< by name of the section
  PlainKeys<morula::CellType> plain;
  Given<double> migration_speed;
  Given<std::string> migration_law, migration_substrate;
  OwnSection migration;  ///< keys that laws of migration have for themselves
  OwnSection polarity;   ///< those of what turns the polarity
  Osmosis osmosis;
  Nucleus nucleus;
  Links nucleus_links, cortex_links;
  Given<double> friction_cell_cell, friction_obstacle, friction_medium;
  std::vector<Named<Given<double>>> adhesion;
  Given<std::string> sphere_law;
  std::map<std::string, Given<double>> sphere_own;  ///< keys that laws of spheres have for themselves, by name
  Given<double> sphere_young, sphere_poisson;
  Given<std::string> sphere_file, sphere_form;  ///< of `law: fitted`
  PlainKeys<cbm::WithShells> with_shells;
  PlainKeys<cbm::SphereParameters> sphere_friction;  ///< factors on friction with cells
  Given<std::string> packing_law;
  Given<double> packing_bulk_modulus;
  std::vector<Named<PackingKnot>> packing_knots;
  Given<double> self_contact;
  Given<double> renew_mesh_below;
  Given<bool> own_mesh;
  std::vector<Named<TensionRegion>> tension_regions;
  Given<double> lateral_easing;
  Activity activity;
  Given<double> tangential_cell_cell, tangential_obstacle, tangential_medium;
};

/// Adhesion of faces with certain marks.
struct AdhesionRegion {
  Given<std::vector<std::string>> faces;
  Given<double> adhesion;
};

struct ContactPair {
  Given<std::vector<std::string>> between;
  Given<std::string> law;
  Given<double> range, repulsion, normal_friction, tangential_friction;
  std::map<std::string, Given<double>> own;  ///< keys that laws have for themselves, by name
  std::vector<Named<AdhesionRegion>> regions;
};

struct Contact {
  Given<double> range, repulsion;
  Given<std::string> friction;
  Given<std::uint64_t> points;
  std::vector<Named<ContactPair>> pairs;
};

struct Shape {
  bool present = false;
  Given<Vec3d> center, size, normal, low_end, high_end;
  Given<double> radius;
};

struct Obstacle {
  Given<std::string> stl, obj;
  Given<double> scale;
  Shape plane, sphere, cylinder, capsule, box;
  Shape pipette;  ///< from: the mouth; to: the far end; radius: inside
  Given<double> pipette_wall, pipette_lip, pipette_edge;
  Given<std::string> side;
  Given<Vec3d> velocity, direction;
  std::vector<Named<CoursePoint>> course;
};

struct Load {
  Given<std::string> type;
  std::map<std::string, OwnSection> kinds;  ///< by name of the load's section
  std::vector<Named<CoursePoint>> course;
};

/// Cells that come with surfaces of their own.
struct Meshes {
  Given<std::string> file;
  Given<std::vector<std::string>> files;
  Given<double> scale;
  Given<std::string> cell_is, id_array;
  Given<std::vector<std::string>> types;
  Given<std::string> type_array, pressure_array;
  Given<double> pressure_unit;
  Given<std::uint64_t> nodes;
  Given<double> edge;
  Given<bool> repair;
  Given<double> overlap;
  Given<Vec3d> center;
};

struct Initial {
  Given<std::string> type;
  std::vector<Named<Given<double>>> types;
  Given<std::string> on;
  Given<std::uint64_t> count;
  Given<std::string> fill;
  Given<Vec3d> center, size;
  Given<double> radius;
  Given<std::vector<Vec3d>> at;
  Given<std::string> age;
  Given<std::string> csv, units;
  Given<double> coincident_shift, coincident_below;
  bool has_hull = false, has_cavity = false;
  Given<double> hull_margin, cavity_radius;
  Given<std::string> hull_share;
  Given<Vec3d> cavity_center;
  Given<std::string> body;
  Given<double> start_volume, inflate;
  Given<std::string> shape, orientation;
  bool has_meshes = false;
  Meshes meshes;
};

struct FieldBoundary {
  Given<double> all, x_low, x_high, y_low, y_high, z_low, z_high;
};

struct Field {
  Given<double> voxel;
  PlainKeys<fields::FieldSpec> spec;
  FieldBoundary boundary;
  std::vector<Named<CoursePoint>> course;
  std::map<std::string, OwnSection> reactions;                         ///< in the volume, by section
  std::map<std::string, std::vector<Named<OwnSection>>> by_cell_type;  ///< reactions of cells, by section
};

struct Region {
  Given<std::string> name, shape, body, follow;
  Given<Vec3d> center;
  OwnSection own;  ///< of the shape
  Given<double> margin, from, until;
  Given<bool> follow_tissue;
};

struct Trigger {
  Given<std::string> promote, demote, type, phase;
  Given<double> outside_law;
  PlainKeys<morula::Trigger> plain;
};

struct Coupling {
  PlainKeys<Swaps> swaps;
  Given<std::string> exchange;
  std::vector<Named<Region>> regions;
  std::vector<Named<Trigger>> triggers;
};

struct Output {
  Given<std::vector<std::string>> series, formats;
  Given<bool> report;
};

struct Limits {
  Given<double> overlap;
  PlainKeys<morula::Limits> plain;
};

struct Study {
  Given<std::uint64_t> schema, seed;
  Given<std::string> name, title, scenario;
  std::vector<Named<Criterion>> criteria;
  std::vector<Named<StudyPlot>> plots;
  Time time;
  Numerics numerics;
  Domain domain;
  std::vector<Named<CellType>> cell_types;
  Contact contact;
  std::vector<Named<Obstacle>> geometry;
  std::vector<Named<Initial>> initial;
  std::vector<Named<Load>> loads;
  std::vector<Named<Mark>> marks;
  std::vector<Named<Lumen>> lumens;
  std::vector<Named<ApicalSpring>> apical;
  std::vector<Named<Field>> fields;
  Coupling coupling;
  Output output;
  Limits limits;
};

}  // namespace morula::scenarios::draft
