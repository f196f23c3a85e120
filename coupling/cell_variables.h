#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/model.h"

namespace morula {

/// What the two cells of a division have of a value of their mother.
enum class AtDivision : std::uint8_t {
  kCopied,  ///< both what she had
  kShared,  ///< each its part by volume; what rounding leaves goes to the second
  kUsual,   ///< what a new cell has
  kSet,     ///< what the division finds for it (make_daughter, set_place)
};

/// A number by cell that exists because the model asks for it, beside what every cell has: what it took from a field, what it sees of one. 0 for a
/// new cell. Files and messages name it and have as many as the model has.
struct CellVariable {
  std::string name;  ///< "amount/oxygen": its path below the tables of cells
  std::string unit;  ///< "1" for a number
  AtDivision at_division = AtDivision::kCopied;
  bool grows = false;  ///< changed before the mechanics of a step: a refused step takes it back

  bool operator==(const CellVariable&) const = default;
};

/// Numbers of the two variables that each field of a model has.
constexpr std::size_t amount_of(std::size_t field) { return 2 * field; }             ///< taken from it so far [amol]
constexpr std::size_t concentration_of(std::size_t field) { return 2 * field + 1; }  ///< seen in it [mM]

/// What is told of the renewals of a shell's mesh (coupling/mesh_renewal.cpp): numbers of the variables behind the first.
enum class MeshRenewal : std::uint8_t {
  kDone,      ///< how often
  kRefused,   ///< how often it could not be
  kNextTry,   ///< after one that could not be [s]
  kArea,      ///< largest relative change of area
  kDistance,  ///< largest distance between the surfaces, in mean edges
};

/// What is told besides of a type whose shells may have meshes of their own: numbers of the variables behind those.
enum class OwnMeshRenewal : std::uint8_t {
  kPasses,    ///< how often connectivity was changed
  kChanges,   ///< how many edges were split, drawn together or turned
  kSkipped,   ///< changes that were wanted and could not be made
  kReturns,   ///< how often the shell has gone back to the mesh of the library
  kNextPass,  ///< after one that gained nothing [s]
  kArea,      ///< largest relative change of area of a pass
  kVolume,    ///< largest relative change of volume of a pass
  kOff,       ///< farthest that a pass has put a node off the surface, in mean edges
};
inline constexpr std::size_t kMeshRenewals = 5;

/// Numbers of the three variables of a model in which any type's cycle has phases: the phase (CyclePlace), what is left of it [s], and for how long the
/// condition of going into or out of quiescence has held [s].
constexpr std::size_t cycle_variables_of(std::size_t fields) { return 2 * fields; }
inline constexpr const char* kPhaseVariable = "cycle/phase";

/// Tells the types of a model which variables say how far a cell is from its type in a trait, as a part ("tension/deviation"). After all that
/// cell_variables() looks at is there, and again where any of it has gone.
void number_trait_variables(Model& model);

/// All variables of the cells of a model, by number: two for each field, three for the phases of the cycle where there are any, those of the
/// renewal of meshes where a type has it, those of its behaviours, "<behaviour>/<variable>", and one for each trait in which a type varies.
std::vector<CellVariable> cell_variables(const Model& model);

/// Number of the first of three variables of a lumen that is found by sight, "cavity/<name>/x" to z: what its eye sees of a sphere, ∫ n dA with n away from the
/// eye [µm²].
std::size_t cavity_variables(const Model& model, std::size_t lumen);
/// Number of a variable of the renewal of meshes, in a model that has a type with it.
std::size_t mesh_renewal_variable(const Model& model, MeshRenewal which);
/// Number of a variable of meshes of their own, in a model that has a type with them.
std::size_t own_mesh_variable(const Model& model, OwnMeshRenewal which);

}  // namespace morula
