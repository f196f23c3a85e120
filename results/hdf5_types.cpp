#include "results/hdf5_types.h"

#include <algorithm>
#include <array>

#include "results/hdf5_handle.h"

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

namespace {

hid_t plain_type(StoredType type, std::uint32_t width) {
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

}  // namespace

hid_t file_type(StoredType type, std::uint32_t width, std::span<const std::string> kinds) {
  const hid_t plain = plain_type(type, width);
  if (kinds.empty()) return plain;
  const hid_t enumeration = H5Tenum_create(plain);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    // Little-endian bytes of the value: the first bytes are those of every narrower type.
    std::array<std::uint8_t, 8> value{};
    for (std::size_t byte = 0; byte < value.size(); ++byte) value[byte] = static_cast<std::uint8_t>(i >> (8 * byte));
    H5Tenum_insert(enumeration, kinds[i].c_str(), value.data());
  }
  H5Tclose(plain);
  return enumeration;
}

void StoragePlan::add_text(const std::string& path, std::span<const std::string> texts, const DatasetLabel& label) {
  std::size_t width = 1;
  if (is_root_)
    for (const std::string& text : texts) width = std::max(width, text.size());
  add_text_rows(path, label, is_root_ ? texts : std::span<const std::string>{}, static_cast<std::uint32_t>(width));
}

void StoragePlan::add_text_rows(const std::string& path, const DatasetLabel& label, std::span<const std::string> local,
                                std::uint32_t width) {
  Dataset dataset{prefix_ + path, label, StoredType::kText, width, {}};
  dataset.bytes.resize(local.size() * width);
  auto* out = reinterpret_cast<char*>(dataset.bytes.data());
  for (std::size_t i = 0; i < local.size(); ++i)
    std::copy_n(local[i].begin(), std::min<std::size_t>(local[i].size(), width), out + i * width);
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
