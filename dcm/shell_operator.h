#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/friction/edge_block.h"
#include "core/friction/float4.h"
#include "core/simd/transpose.h"
#include "core/vec3.h"
#include "dcm/blocks.h"
#include "dcm/internal_forces.h"
#include "dcm/shell_friction.h"
#include "dcm/shells.h"

namespace morula::dcm {

/// The shells' part of the matrix of a step, A = Γ_n + Δt K̃, symmetric positive semi-definite, in float and in lanes [nN·s/µm].
///
/// Everything but the medium friction acts on differences of velocities, so that rigid translation feels nothing whatever the rounding:
///   edge     M (v_i − v_j): damper, spring, tension on the normal part of differences (½ cot per face), isotropic part of triangle_shape
///   shape    b bᵀ per face: Gauss–Newton part of triangle_shape, only where it counts
///   hinge    b bᵀ per edge: Gauss–Newton part of dihedral_barrier where it acts, and of hinge_bending where it is stiff against the tension
///   membrane the three edge strains of a face among each other; what an edge strain does to itself is in the edge blocks
///   bending  κ/a h hᵀ per node: Gauss–Newton part of the Helfrich law
///   rotation −Y S⁻¹ Yᵀ per shell, with K the stiffness that edges have of the membrane, R the three rotations of the shell, Y = K R and S = RᵀY = G Gᵀ:
///            tension resists every motion of two nodes across their edge, rotations of the whole shell too, which cost no energy. Without this part of it K
///            is as semi-definite as before, and rotations feel friction and contacts only (decision 0081)
///   volume   (Δt K_V/V) g gᵀ per shell, g = ∂V/∂x; likewise the global area, and the bulk viscosity with the g of the step's start
/// What no shell of a block has is empty and costs nothing.
/// Weak hinges are explicit: with them the iterations and the result stay the same (time_stepping.md §10.1).
struct ShellOperator {
  struct Block {
    LaneVector<float> edge;             ///< M, with what contacts add, xx xy xz yy yz zz: [edge][6][lane]
    LaneVector<float> diagonal;         ///< medium friction: [node][lane]
    LaneVector<float> volume_gradient;  ///< g: [node][3][lane]
    std::array<float, LaneBlock::kMaxLanes> volume_stiffness{};
    LaneVector<float> rotation;       ///< Ŷ = Y G⁻ᵀ, three vectors a node: [node][3][3][lane]
    LaneVector<float> membrane;       ///< h01 h12 h20, e1, e2 of every face: [face][9][lane]
    LaneVector<float> area_gradient;  ///< ∂A/∂x: [node][3][lane]
    std::array<float, LaneBlock::kMaxLanes> area_stiffness{};
    LaneVector<float> bulk_gradient;  ///< ∂V/∂x of the step's start: [node][3][lane]
    std::array<float, LaneBlock::kMaxLanes> bulk_friction{};
    LaneVector<float> bending_weight;       ///< ½ Σ cot of every edge: [edge][lane]
    LaneVector<float> bending_normal;       ///< √(Δt κ/a) n of every node: [node][3][lane]
    std::vector<std::uint32_t> shape_face;  ///< faces with a shape term
    LaneVector<float> shape;                ///< b at corners 1 and 2 (at 0 minus their sum): [entry][2][3][lane]
    std::vector<std::uint32_t> hinge_edge;  ///< edges with a hinge term
    LaneVector<float> hinge;                ///< b at nodes j, k, l (at i minus their sum): [entry][3][3][lane]
  };
  std::vector<Block> blocks;
};

/// Assemble A at `position` (a trial state) for the friction of the step's start and step size `time_step` [s].
///
/// `face_contact_energy` is the contact energy per area that lowers the tension of each face, ∂E_contact/∂A_T [nN/µm] by face
/// (ShellBlocks::first_face); empty when there is no contact. Where tension and contact energy sum to less than zero, their stiffness is
/// left out. `contacts` fills what contacts couple within a shell, blocks xx xy xz yy yz zz on the edges in the order of the shell's Topology;
/// it may be empty. `held` is as in internal_forces().
void assemble_shell_operator(const ShellBlocks& blocks, const Shells& shells, const ShellMaterials& materials,
                             std::span<const Vec3d> position, const ShellFriction& friction, std::span<const double> face_contact_energy,
                             double time_step, const EdgeBlockSource& contacts, ShellOperator& out, std::span<const HeldVolume> held = {});

/// q = A p by node of the shells; p and q are indexed as the shells' nodes, and q is overwritten. Fourth components come out as zero.
void apply_shell_operator(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<const Float4> p,
                          std::span<Float4> q);
/// The same for the blocks first .. last−1, by one thread.
void apply_shell_operator(const ShellBlocks& blocks, std::size_t first, std::size_t last, const Shells& shells, const ShellOperator& matrix,
                          std::span<const Float4> p, std::span<Float4> q);

/// Add the 3×3 diagonal blocks of A to `diagonal`, by node of the shells, for block-Jacobi. The volume term is left out: with it the
/// iterations are the same (time_stepping.md §5).
void add_block_diagonal(const ShellBlocks& blocks, const Shells& shells, const ShellOperator& matrix, std::span<SymMat3<float>> diagonal);

}  // namespace morula::dcm
