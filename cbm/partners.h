#pragma once
#include <vector>

#include "core/cell_id.h"

namespace morula::cbm {

/// The cells to which a sphere adheres: sorted by id, each once (Spheres::attached). Both partners of a pair carry the entry.
using Partners = std::vector<CellId>;

[[nodiscard]] bool adheres(const Partners& partners, CellId other);

/// Make or break the entry of one partner; no change where it is so already.
void set_adheres(Partners& partners, CellId other, bool attached);

/// Partners of a daughter at birth: those of its mother and its sister. A neighbour out of reach is let go by the next update_attached, and
/// one within reach does not feel a jump from adhesion to none and back.
[[nodiscard]] Partners daughter_partners(const Partners& mother_partners, CellId sister);

/// In a neighbour of a mother that divides: both daughters in place of her, where she was a partner.
void replace_partner(Partners& partners, CellId mother, CellId first, CellId second);

}  // namespace morula::cbm
