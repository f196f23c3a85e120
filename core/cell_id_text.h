#pragma once
#include <optional>
#include <string_view>

#include "core/cell_id.h"

namespace morula {

/// The id that CellId::text() writes so; none where the text is no such name.
[[nodiscard]] std::optional<CellId> cell_id_of(std::string_view text);

/// Whether a cell is this one or comes of it.
[[nodiscard]] bool descends_from(CellId cell, CellId ancestor);

}  // namespace morula
