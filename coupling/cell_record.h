#pragma once
#include <cassert>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/boxed.h"
#include "core/mesh/topology.h"
#include "core/result.h"
#include "coupling/tissue.h"

namespace morula {

using cbm::SphereRecord;
using dcm::ShellRecord;

/// One cell whole: its row and its body. What events, swaps and moves between ranks work on.
struct CellRecord {
  CellState row;
  std::optional<SphereRecord> sphere;
  Boxed<ShellRecord> shell;  ///< boxed: a hundred thousand spheres shall not have the room for one each

  [[nodiscard]] Vec3d center() const;
};

/// What a shell encloses [µm³].
double volume_of(const dcm::ShellRecord& shell);

/// All cells of the tissue as records, in the order of the rows. The tissue's cells and bodies are left empty; it keeps its variables.
std::vector<CellRecord> take_apart(Tissue& tissue);

/// Put cells back: sorted into canonical order. The tissue's own cells must be empty, with the variables of those that come.
void put_together(Tissue& tissue, std::vector<CellRecord> cells);

/// The bodies of some rows (increasing).
std::vector<BodyOfRow> bodies_of(const Cells& cells, std::span<const std::size_t> rows);

/// One cell of the tissue as a record.
CellRecord record_of(const Tissue& tissue, const BodyOfRow& body);

/// The cells of the rows `gone` (increasing) leave the tissue, and `fresh` ones come in at their places in canonical order; all others are moved as
/// they are, in stretches. What an event of a few cells does: nothing is sorted but them.
void replace_cells(Tissue& tissue, std::span<const std::size_t> gone, std::vector<CellRecord> fresh);

/// Mean of some numbers or vectors, at least one.
template <class T>
T mean_of(std::span<const T> values) {
  assert(!values.empty());
  T sum{};
  for (const T& value : values) sum += value;
  if constexpr (std::is_arithmetic_v<T>)
    return sum / static_cast<T>(values.size());
  else
    return sum * (decltype(T::x)(1) / static_cast<decltype(T::x)>(values.size()));
}

/// Rest lengths of the edges of a free shell of this shape whose membrane is stress-free at `rest_volume` [µm].
std::vector<double> free_rest_lengths(const ReferenceShape& shape, double rest_volume);

/// The rows of these cells (sorted), increasing; cells that are not of this rank have none.
std::vector<std::size_t> rows_of(const Cells& cells, std::span<const CellId> sorted);

/// A spherical shell around `center` whose mesh encloses `volume`, with stress-free membrane at that volume and velocity zero.
ShellRecord spherical_shell(std::shared_ptr<const ReferenceShape> shape, const Vec3d& center, double volume, double reference_volume);

/// Give a shell the nucleus of its type, at its centroid and at rest in a cell at rest; none where the type has none.
void place_nucleus(ShellRecord& shell, const CellType& type, ShapeLibrary& shapes);

/// A cell as bytes and back. An icosphere travels by its node count, any other shape whole.
void append_bytes(const CellRecord& cell, std::vector<std::byte>& out);
std::vector<CellRecord> read_records(std::span<const std::byte> bytes, ShapeLibrary& shapes);

}  // namespace morula
