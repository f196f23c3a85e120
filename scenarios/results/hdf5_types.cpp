#include "scenarios/results/hdf5_types.h"

#include <algorithm>

#include "scenarios/results/hdf5_handle.h"

namespace morula::scenarios {

std::size_t size_of(StoredType type) {
  switch (type) {
    case StoredType::kUint8:
    case StoredType::kText:
      return 1;
    case StoredType::kUint16:
      return 2;
    case StoredType::kUint32:
    case StoredType::kInt32:
    case StoredType::kFloat:
      return 4;
    case StoredType::kUint64:
    case StoredType::kInt64:
    case StoredType::kDouble:
      return 8;
  }
  return 1;
}

hid_t file_type(StoredType type, std::uint32_t width) {
  switch (type) {
    case StoredType::kUint8:
      return H5Tcopy(H5T_STD_U8LE);
    case StoredType::kUint16:
      return H5Tcopy(H5T_STD_U16LE);
    case StoredType::kUint32:
      return H5Tcopy(H5T_STD_U32LE);
    case StoredType::kUint64:
      return H5Tcopy(H5T_STD_U64LE);
    case StoredType::kInt32:
      return H5Tcopy(H5T_STD_I32LE);
    case StoredType::kInt64:
      return H5Tcopy(H5T_STD_I64LE);
    case StoredType::kFloat:
      return H5Tcopy(H5T_IEEE_F32LE);
    case StoredType::kDouble:
      return H5Tcopy(H5T_IEEE_F64LE);
    case StoredType::kText:
      break;
  }
  const hid_t text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, width);
  H5Tset_strpad(text, H5T_STR_NULLPAD);
  H5Tset_cset(text, H5T_CSET_UTF8);
  return text;
}

void StoragePlan::add_text(const std::string& path, std::span<const std::string> texts) {
  Dataset dataset{prefix_ + path, "", StoredType::kText, 1, {}};
  if (is_root_) {
    for (const std::string& text : texts) dataset.width = std::max(dataset.width, static_cast<std::uint32_t>(text.size()));
    for (const std::string& text : texts) {
      const std::size_t old = dataset.bytes.size();
      dataset.bytes.resize(old + dataset.width);
      std::copy(text.begin(), text.end(), reinterpret_cast<char*>(dataset.bytes.data()) + old);
    }
  }
  datasets_.push_back(std::move(dataset));
}

std::string hdf5_reason() {
  std::string reason;
  // The walk goes up from the innermost cause; the first entry is the one that says why.
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* entry, void* out) -> herr_t {
        auto& text = *static_cast<std::string*>(out);
        if (text.empty() && entry->desc != nullptr) text = entry->desc;
        return 0;
      },
      &reason);
  return reason.empty() ? "not a whole HDF5 file" : reason;
}

}  // namespace morula::scenarios
