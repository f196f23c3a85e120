#pragma once
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/numbers/unit_conversion.h"
#include "core/own_keys.h"
#include "core/space/space.h"
#include "core/vec3.h"
#include "coupling/own_values.h"

namespace morula {

class CellView;
class TriangleTree;
struct Model;
struct Region;
struct Trigger;

inline constexpr double kNever = std::numeric_limits<double>::infinity();

enum class BodyKind : std::uint8_t { kSphere = 0, kShell = 1 };

/// How far outside a region a cell is, and how far it may be and yet stay: lengths [µm], numbers of contacts, or parts of a level.
struct Standing {
  double outside, margin;

  [[nodiscard]] bool is_in() const { return outside <= margin; }
};

/// What a region counts contacts from.
enum class CountsContacts : std::uint8_t {
  kNo,           ///< it does not: it lies in space, or looks at the cells
  kFromNamed,    ///< OwnValues `of`: a region before it, a type, an obstacle
  kFromSurface,  ///< the cells at the tissue's surface (Mechanics::open_sides())
};

/// A shape of regions: what there is to say about it, its keys in a region of the study beside `center`, and where its inside is.
struct RegionShape {
  LawInfo info;                ///< info.name is the word of `shape`
  std::vector<OwnKey> keys{};  ///< those without a default must be given
  bool has_center = true;      ///< `center` says where it lies, and it may follow the tissue
  /// Fills in what distance() reads of a Region, from its values and the obstacles of the model; null: it reads Region::values.
  void (*build)(const Model& model, Region& region) = nullptr;
  /// Counted in contacts, not measured in space: cells that are at most Region::contacts away from those that the region begins with.
  /// contacts_from_regions() finds how many they are.
  CountsContacts counts = CountsContacts::kNo;
  /// How a cell stands to it wherever it is: of shapes that name cells or look at what these sense; distance() is not asked then. The margin is that
  /// of a cell that is in it.
  Standing (*of_cell)(const Region& region, const CellView& cell) = nullptr;
  const char* awaited = nullptr;  ///< while such regions are there, a run at rest goes on for this; null: it does not
  /// Distance outside of a point that is `from` away from the centre; negative inside [µm]. Where it is more than the region's margin it may be less than
  /// what it is, if not less than the margin.
  double (*distance)(const Region& region, const Vec3d& from) = nullptr;
  bool repeats = false;  ///< in a periodic domain it is there in every image of the domain, as what lies in it is
  /// Whether any of it lies in the domain; null: some always does.
  bool (*meets)(const Region& region, const Box& domain) = nullptr;
  /// How much of the domain it takes at most, for estimates of costs; null: all of it [µm³].
  double (*volume)(const Region& region) = nullptr;

  /// Whether it has a border in space, which a cell leaves a length behind.
  [[nodiscard]] bool has_border() const { return distance != nullptr; }
};

std::vector<std::shared_ptr<const RegionShape>> builtin_region_shapes();
std::shared_ptr<const RegionShape> sphere_region();
std::shared_ptr<const RegionShape> box_region();
std::shared_ptr<const RegionShape> half_space_region();
std::shared_ptr<const RegionShape> everything_region();
std::shared_ptr<const RegionShape> around_region();
std::shared_ptr<const RegionShape> neighbours_region();
std::shared_ptr<const RegionShape> chosen_cells_region();
std::shared_ptr<const RegionShape> surface_region();
std::shared_ptr<const RegionShape> level_region();

/// Where cells are to be shells.
struct Region {
  std::string name;
  std::shared_ptr<const RegionShape> shape = sphere_region();
  Vec3d center{};
  double radius = 0.0;
  Vec3d size{};           ///< of a box
  Vec3d normal{0, 0, 1};  ///< of a half space; inside is the side the normal points away from
  BodyKind body = BodyKind::kShell;
  double margin = 3.0;                            ///< leaving needs this distance beyond the border [µm]
  bool follow_tissue = false;                     ///< centre is relative to the tissue's centroid
  int obstacle = -1;                              ///< that it moves along with; −1: none
  std::shared_ptr<const TriangleTree> surface{};  ///< of that obstacle at time 0, where distance() asks for it
  double reach = 0.0;                             ///< from that surface [µm]
  double room = 0.0;                              ///< within its reach [µm³]
  double contacts = 0.0;                          ///< up to which it counts them
  double from = 0.0;                              ///< the region exists from here [s]
  double until = kNever;                          ///< to here [s]
  OwnValues values{};                             ///< of the shape's own keys

  [[nodiscard]] bool exists_at(double time) const { return time >= from && time < until; }
};

/// A value of a cell that `promote` and `demote` of a trigger may compare.
struct TriggerValue {
  LawInfo info;  ///< info.name is the word in the study, but for the values of fields, which have the name of the field
  Quantity quantity = Quantity::kNumber;
  const char* example = "";       ///< of a comparison: "pressure > 1 kPa"
  bool looks_at_body = false;     ///< of CellView: what the body is at present positions
  const char* awaited = nullptr;  ///< while such triggers are there, a run at rest goes on for this; null: it does not
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();  ///< that a cell can have
  double (*of)(const Trigger& trigger, const CellView& cell) = nullptr;
};

std::vector<std::shared_ptr<const TriggerValue>> builtin_trigger_values();
std::shared_ptr<const TriggerValue> pressure_value();
std::shared_ptr<const TriggerValue> field_value();

/// Promote or demote by a value of the cell, or all cells of a type, or all in a phase of their cycle.
struct Trigger {
  std::shared_ptr<const TriggerValue> value = pressure_value();
  int field = -1;             ///< of field_value()
  int type = -1;              ///< cells of this type are shells, and no value is looked at; −1: by the value
  std::string phase{};        ///< cells in the phase of this name are shells, and no value is looked at; empty: by the value
  bool promote_above = true;  ///< promote when value > promote threshold (else when below)
  double promote = 0.0;
  double demote = 0.0;
  double hold = 1800.0;  ///< no second swap within this time [s]

  [[nodiscard]] bool compares() const { return type < 0 && phase.empty(); }
};

}  // namespace morula
