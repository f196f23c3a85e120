#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/key_spec.h"
#include "core/law_info.h"

namespace morula {

/// A key of a thing that declares its keys itself (a behaviour, a load, a shape of a region, a reaction): how the study writes it, and what OwnValues
/// have of it under its name.
struct OwnKey {
  enum class Kind : std::uint8_t {
    kQuantity,    ///< a number with a unit
    kFlag,        ///< true or false: 1 or 0
    kWord,        ///< one of spec.words: its place among them
    kVector,      ///< [x, y, z]
    kDirection,   ///< [x, y, z] that is not 0; made of length 1
    kField,       ///< name of a field: its number
    kFieldValue,  ///< `field: NAME` and `NAME: value`, or in one key `<field>_<spec.name>: value`; the field's number is that of `field`
    kMark,        ///< name of a mark of faces: its bit
    kObstacle,    ///< name of an obstacle: its number
    kCells,       ///< name of a region of bodies declared before, a cell type or an obstacle
    kCellIds,     ///< id of a cell, or a list of ids: OwnValues::ids()
    kCourse,      ///< list of points over time: a TimeCourse. `spec.quantity` is that of the values, kNumber: factors
    kGroup,       ///< a section, with `keys`; its name is 1 where it stands in the study, and its keys are `group.key`
  } kind = Kind::kQuantity;
  KeySpec spec;                ///< `required`: must be given where the thing acts
  std::vector<OwnKey> keys{};  ///< of kGroup
};

/// A law's own section of the study as `explain` and docs/laws.md have it.
inline std::vector<LawKey> law_keys(const std::string& section, const std::vector<OwnKey>& keys) {
  std::vector<LawKey> out;
  for (const OwnKey& key : keys) {
    if (key.kind == OwnKey::Kind::kGroup)
      for (LawKey& inner : law_keys(section + "." + key.spec.name, key.keys)) out.push_back(std::move(inner));
    else
      out.push_back({section, key.spec});
  }
  return out;
}

}  // namespace morula
