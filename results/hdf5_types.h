#pragma once
#include <hdf5.h>

#include <cstdint>
#include <span>
#include <string>

#include "results/hdf5_plan.h"

namespace morula::scenarios {

/// The HDF5 type of a stored value, a copy to be closed. For kText a string of `width` bytes, UTF-8, filled with zeros. With `kinds` an
/// enumeration on that type, its values 0, 1, ...
[[nodiscard]] hid_t file_type(StoredType type, std::uint32_t width, std::span<const std::string> kinds = {});

}  // namespace morula::scenarios
