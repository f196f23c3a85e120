#pragma once
#include <string>

#include "core/result.h"
#include "study/study.h"

namespace morula::scenarios {

/// What a virtual experiment takes from a study: the deformable cell of one type, and how surfaces touch. Life, migration, spheres and everything else
/// of the study stay behind.
struct CellMaterial {
  std::string type;
  double radius = 0.0;    ///< mean, of the free cell [µm]
  double adhesion = 0.0;  ///< W of two cells of the type [nN/µm]
  double tension = 0.0;   ///< of their cortices [nN/µm]
  double range = 0.0;     ///< of contact [µm]
  std::uint32_t nodes = 0;
  CellFriction friction;  ///< for how fast cells come together, no part of what they are
  std::string shell;      ///< the sections of the type that its shells read, as YAML in one line: `dcm: {...}`
  std::string contact;    ///< the section `contact` without its pairs, as YAML in one line
  std::string pair;       ///< what stands there for two cells of the type: `, repulsion: 50 kPa/um`

  /// All that the shells are, as a YAML map in one line: a fit belongs to the material that has its text.
  [[nodiscard]] std::string text() const;
};

/// Errors (kInput): no such type; a type whose surface has parts of its own (marks, regions of tension, adhesion by region), which one pair curve
/// cannot stand for.
Result<CellMaterial> material_of(const Study& study, const std::string& type);

/// Where two texts of materials differ first: "`dcm.tension` is 0.1 mN/m here and 0.2 mN/m there"; empty where they do not.
std::string first_difference(const std::string& here, const std::string& there);

}  // namespace morula::scenarios
