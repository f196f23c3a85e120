#include "core/parallel/partition.h"

#include <zoltan.h>

#include <string>

namespace morula {
namespace {

struct Points {
  std::span<const Vec3d> position;
  std::span<const double> weight;
};

int count_points(void* data, int* error) {
  *error = ZOLTAN_OK;
  return static_cast<int>(static_cast<Points*>(data)->position.size());
}

void list_points(void* data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float* weights, int* error) {
  const auto& points = *static_cast<Points*>(data);
  for (std::size_t i = 0; i < points.position.size(); ++i) {
    global[i] = local[i] = static_cast<ZOLTAN_ID_TYPE>(i);
    weights[i] = static_cast<float>(points.weight[i]);
  }
  *error = ZOLTAN_OK;
}

int dimensions(void*, int* error) {
  *error = ZOLTAN_OK;
  return 3;
}

void coordinates(void* data, int, int, int count, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double* out, int* error) {
  const auto& points = *static_cast<Points*>(data);
  for (int i = 0; i < count; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) out[3 * i + static_cast<int>(axis)] = points.position[local[i]][axis];
  *error = ZOLTAN_OK;
}

}  // namespace

struct Partition::Cuts {
  Zoltan_Struct* zoltan = nullptr;
  ~Cuts() {
    if (zoltan != nullptr) Zoltan_Destroy(&zoltan);
  }
};

Partition::Partition() = default;
Partition::~Partition() = default;
Partition::Partition(Partition&&) noexcept = default;
Partition& Partition::operator=(Partition&&) noexcept = default;

std::vector<int> Partition::balance(std::span<const Vec3d> position, std::span<const double> weight, const Comm& comm) {
  std::vector<int> owner(position.size(), comm.rank());
  if (comm.size() == 1) return owner;
  float version = 0.0f;
  Zoltan_Initialize(0, nullptr, &version);
  cuts_ = std::make_unique<Cuts>();
  cuts_->zoltan = Zoltan_Create(comm.raw());
  const auto set = [&](const char* name, const char* value) { Zoltan_Set_Param(cuts_->zoltan, name, value); };
  set("DEBUG_LEVEL", "0");
  set("LB_METHOD", "RCB");
  set("NUM_GID_ENTRIES", "1");
  set("NUM_LID_ENTRIES", "1");
  set("OBJ_WEIGHT_DIM", "1");
  set("IMBALANCE_TOL", "1.05");
  set("KEEP_CUTS", "1");
  set("RCB_RECTILINEAR_BLOCKS", "0");
  set("RETURN_LISTS", "EXPORT");
  Points points{position, weight};
  Zoltan_Set_Num_Obj_Fn(cuts_->zoltan, count_points, &points);
  Zoltan_Set_Obj_List_Fn(cuts_->zoltan, list_points, &points);
  Zoltan_Set_Num_Geom_Fn(cuts_->zoltan, dimensions, &points);
  Zoltan_Set_Geom_Multi_Fn(cuts_->zoltan, coordinates, &points);

  int changes = 0, gid_size = 0, lid_size = 0, imports = 0, exports = 0;
  ZOLTAN_ID_PTR import_global = nullptr, import_local = nullptr, export_global = nullptr, export_local = nullptr;
  int *import_rank = nullptr, *import_part = nullptr, *export_rank = nullptr, *export_part = nullptr;
  const int code = Zoltan_LB_Partition(cuts_->zoltan, &changes, &gid_size, &lid_size, &imports, &import_global, &import_local, &import_rank,
                                       &import_part, &exports, &export_global, &export_local, &export_rank, &export_part);
  if (code == ZOLTAN_OK || code == ZOLTAN_WARN)
    for (int i = 0; i < exports; ++i) owner[export_local[i]] = export_rank[i];
  Zoltan_LB_Free_Part(&import_global, &import_local, &import_rank, &import_part);
  Zoltan_LB_Free_Part(&export_global, &export_local, &export_rank, &export_part);
  return owner;
}

int Partition::owner(const Vec3d& point) const {
  if (cuts_ == nullptr) return 0;
  double coordinate[3] = {point.x, point.y, point.z};
  int rank = 0;
  Zoltan_LB_Point_Assign(cuts_->zoltan, coordinate, &rank);
  return rank;
}

}  // namespace morula
