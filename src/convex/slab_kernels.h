// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
// The inner loops of the partition over plain arrays of doubles: a C-obstacle as slabs against a
// cell.
#pragma once

namespace fcl_prob::detail {

/// A convex C-obstacle as an intersection of slabs `lo <= n·y <= hi`, |n| = 1, in
/// structure-of-arrays layout: six consecutive arrays nx, ny, nz, lo, hi, margin of `count` doubles
/// each, `count` a multiple of 4. The slabs as stored contain V whatever was rounded; shrunk by
/// `margin` on both sides they are contained in V. An unused lane has n = 0 and cuts nothing.
struct SlabArrays {
  const double* data;
  int count;
  bool outer_only = false;  ///< the margins are without end: nothing is said of the inside

  const double* nx() const { return data; }
  const double* ny() const { return data + count; }
  const double* nz() const { return data + 2 * count; }
  const double* lo() const { return data + 3 * count; }
  const double* hi() const { return data + 4 * count; }
  const double* margin() const { return data + 5 * count; }
};

/// Number of arrays of a SlabArrays.
inline constexpr int kSlabFields = 6;

/// Slabs of a pair of triangles: two face normals, nine edge cross products, one unused lane.
inline constexpr int kTriangleSlabs = 12;

/// What the rounding of a C-obstacle's planes depends on, axis by axis: whitening may stretch one
/// axis by far more than another.
struct SlabExtent {
  double width[3];  ///< of the longest edge
  double reach[3];  ///< bound on the coordinates of a cell and of the pieces added up, and of V
  double error[3];  ///< bound on the error of a vertex of one piece plus one of the other
};

/// An axis-aligned cell by its centre and half extents.
struct CellBox {
  double center[3];
  double half[3];
};

/// Coordinates of points. `count` is a multiple of 4; what is not a number is no point.
struct PointArrays {
  const double* coordinates[3];
  int count;
};

enum class CellRelation { outside, inside, cut };

/// How a C-obstacle meets a cell. For `cut`: over how many planes the cell sticks out of the
/// obstacle's inner slabs, and one of them: slab `slab`, its upper or lower plane. Only that one if
/// sides is 1. No slice of the cell with a larger share of its width than `covered` is within the
/// obstacle.
struct CellCut {
  CellRelation relation;
  int sides;
  int slab;
  bool upper_side;
  double covered;
};

/// A slice of a cell across `axis`, `width` wide, at the cell's lower or upper end. No slice: axis
/// -1.
struct CellSlice {
  int axis;
  bool at_lower_end;
  double width;
};

/// The kernels, compiled for several instruction sets with identical results.
struct SlabKernels {
  CellCut (*classify)(const SlabArrays& slabs, const CellBox& cell);

  /// The same of a single point; what `classify` says of a cell without extent.
  CellRelation (*classifyPoint)(const SlabArrays& slabs, const double* point);

  /// Which of the points are in the box [lo, hi]: writes their places in the arrays to `inside`,
  /// which has room for all, and returns how many they are.
  int (*pointsInBox)(const PointArrays& points, const double* lo, const double* hi, int* inside);

  /// A lower bound of `m·y` over V ∩ cell: the dual of the linear program, one slab at a time,
  /// which is a bound for any multiplier, so no convergence is needed.
  double (*minimumAlong)(const SlabArrays& slabs, const CellBox& cell, const double* m);

  /// Shrinks the box [lo, hi] to what V ∩ cell can reach, one plane at a time; lo > hi if it is
  /// empty.
  void (*contract)(const SlabArrays& slabs, const CellBox& cell, double* lo, double* hi);

  /// The largest slice of the cell that is certainly within V.
  CellSlice (*coveredSlice)(const SlabArrays& slabs, const CellBox& cell);

  /// The normals p × q of `count` slabs (a multiple of 4) and their margins into `out`, laid out as
  /// SlabArrays; as lo and hi only the padding, to which the extent of V along n is to be added.
  /// Where p and q are too nearly parallel to give a normal the slab is left out, and the margins
  /// of the others pay for it.
  /// \param p, q  edges of the two pieces, or two of one face: x, y, z of `count` each; taken to be
  ///              rounded as differences of vertices are
  void (*planes)(const double* p, const double* q, int count, const SlabExtent& extent,
                 double* out);

  /// Slabs of the C-obstacle of two triangles (kSlabFields * kTriangleSlabs doubles into `out`).
  /// \param a, b   vertices, 3 × (x, y, z), in the whitened frame
  /// \param error  bound on the error of a vertex of a plus one of b, for each axis
  void (*triangleSlabs)(const double* a, const double* b, const double* error, double* out);
};

/// The fastest kernels that this processor runs. All give the same bits.
const SlabKernels& slabKernels();

/// Those that every processor runs.
SlabKernels portableSlabKernels();

/// Cells lie within this distance of the origin along every axis; beyond it no mass is left in
/// double precision.
inline constexpr double kReach = 38.6;

/// The offset of a slab that does not bound anything.
inline constexpr double kUnbounded = 1e300;

}  // namespace fcl_prob::detail
