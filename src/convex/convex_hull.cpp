// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the fcl_prob authors
#include <libqhullcpp/QhullError.h>
#include <libqhullcpp/QhullFacetList.h>
#include <libqhullcpp/QhullQh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "convex/spanning_frame.h"
#include "fcl_prob/convex_polytope.h"
#include "fcl_prob/exceptions.h"
#include "geometry/directed_edges.h"
#include "geometry/length.h"
#include "geometry/quiet_qhull.h"

namespace fcl_prob {
namespace {

using detail::SpanningFrame;

/// Indices of the extreme points of a point, a segment or a flat polygon (counter-clockwise about
/// the frame's third direction). The frame's dimension is below 3, or its third is to be ignored.
std::vector<int> flatHull(const std::vector<Eigen::Vector3d>& points, const SpanningFrame& frame);

using PlanePoints = std::vector<Eigen::Vector2d>;

double turn(const PlanePoints& plane, int a, int b, int c) {
  const Eigen::Vector2d first = plane[b] - plane[a];
  const Eigen::Vector2d second = plane[c] - plane[b];
  return first.x() * second.y() - first.y() * second.x();
}

// One half of Andrew's monotone chain, over indices in the given order.
template <class Iterator>
void appendChain(const PlanePoints& plane, Iterator begin, Iterator end, std::vector<int>& hull) {
  const std::size_t start = hull.size();
  for (Iterator it = begin; it != end; ++it) {
    while (hull.size() >= start + 2 && turn(plane, hull[hull.size() - 2], hull.back(), *it) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*it);
  }
  hull.pop_back();  // the first of the other half
}

std::vector<int> flatHull(const std::vector<Eigen::Vector3d>& points, const SpanningFrame& frame) {
  if (frame.dimension == 0) return {0};
  PlanePoints plane;
  plane.reserve(points.size());
  for (const Eigen::Vector3d& point : points) {
    plane.push_back(frame.coordinates(point).head<2>());
  }
  const auto before = [&](int a, int b) {
    return plane[a].x() != plane[b].x() ? plane[a].x() < plane[b].x() : plane[a].y() < plane[b].y();
  };
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), before);
  const auto same = [&](int a, int b) { return plane[a] == plane[b]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  if (order.size() < 2) return {0};

  std::vector<int> hull;
  appendChain(plane, order.begin(), order.end(), hull);
  appendChain(plane, order.rbegin(), order.rend(), hull);
  return hull;
}

using detail::SpanningFrame;
using orgQhull::QhullError;  // QH_TRY_ expects it unqualified

// A face of the hull of the normalised points.
struct Facet {
  Eigen::Vector3d normal;
  std::vector<int> points;
};

// Facets are merged first; triangulated ones if merging left a surface that does not close.
constexpr std::array<const char*, 3> kQhullOptions{"Pp", "Qt Pp", "Qt Qx Pp"};

void requirePositions(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) throw InvalidGeometry("convex hull of no points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!detail::isPosition(points[i])) {
      throw InvalidGeometry("point " + std::to_string(i) +
                            " of a convex hull is no position: " + detail::numberText(points[i]));
    }
  }
}

// The vertices of a facet in order around it. Qhull reports errors by longjmp, so nothing that has
// a destructor may be created in here.
std::vector<int> orderedPoints(orgQhull::QhullQh* qh, facetT* facet) {
  std::vector<int> ids;
  ids.reserve(static_cast<std::size_t>(qh_setsize(qh, facet->vertices)));
  QH_TRY_(qh) {
    setT* vertices = qh_facet3vertex(qh, facet);
    vertexT *vertex, **vertexp;
    FOREACHvertex_(vertices) { ids.push_back(qh_pointid(qh, vertex->point)); }
    qh_settempfree(qh, &vertices);
  }
  qh->NOerrexit = true;
  qh->maybeThrowQhullMessage(QH_TRY_status);
  return ids;
}

// Twice the area vector of a polygon, relative to its first point.
Eigen::Vector3d areaVector(const std::vector<Eigen::Vector3d>& points,
                           const std::vector<int>& loop) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& first = points[loop[0]];
  for (std::size_t k = 2; k < loop.size(); ++k) {
    sum += (points[loop[k - 1]] - first).cross(points[loop[k]] - first);
  }
  return sum;
}

std::vector<Facet> runQhull(const std::vector<Eigen::Vector3d>& normalised,
                            const std::string& options) {
  detail::QuietQhull qhull;
  qhull.runQhull("", 3, static_cast<int>(normalised.size()), normalised.front().data(),
                 options.c_str());
  std::vector<Facet> facets;
  for (const orgQhull::QhullFacet& facet : qhull.facetList()) {
    const double* normal = facet.getFacetT()->normal;
    Facet result{{normal[0], normal[1], normal[2]}, orderedPoints(qhull.qh(), facet.getFacetT())};
    if (areaVector(normalised, result.points).dot(result.normal) < 0) {
      std::reverse(result.points.begin(), result.points.end());
    }
    facets.push_back(std::move(result));
  }
  return facets;
}

bool isClosed(const std::vector<Facet>& facets) {
  std::vector<detail::DirectedEdge> edges;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    if (facets[f].points.size() < 3) return false;
    detail::addSides(facets[f].points, static_cast<int>(f), edges);
  }
  return facets.size() >= 4 && !detail::pairEdges(std::move(edges)).fault;
}

// Facets that are coplanar to `tolerance` (normalised, on top of Qhull's own rounding) become one.
std::string mergeOption(double tolerance) { return "C-" + detail::numberText(tolerance) + " "; }

// Facets of the body in normalised coordinates; nothing if it is too flat for Qhull.
std::optional<std::vector<Facet>> closedFacets(const std::vector<Eigen::Vector3d>& normalised,
                                               double merge_tolerance) {
  for (const char* options : kQhullOptions) {
    try {
      std::vector<Facet> facets = runQhull(normalised, mergeOption(merge_tolerance) + options);
      if (isClosed(facets)) return facets;
    } catch (const QhullError&) {
      // The next option, or flat.
    }
  }
  return std::nullopt;
}

ConvexPolytope withoutFaces(const std::vector<Eigen::Vector3d>& points,
                            const SpanningFrame& frame) {
  ConvexPolytope polytope;
  for (const int index : flatHull(points, frame)) {
    polytope.vertices.push_back(points[index]);
  }
  return polytope;
}

// Normals transform with the inverse transpose of the map to normalised coordinates.
Eigen::Vector3d worldNormal(const SpanningFrame& frame, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d scaled = normal.cwiseQuotient(frame.widths / frame.widths[2]);
  return (frame.directions * scaled).stableNormalized();
}

ConvexPolytope withFaces(const std::vector<Eigen::Vector3d>& points, const SpanningFrame& frame,
                         const std::vector<Facet>& facets) {
  ConvexPolytope polytope;
  std::vector<int> vertex_of_point(points.size(), -1);
  for (const Facet& facet : facets) {
    ConvexPolytope::Face face;
    face.normal = worldNormal(frame, facet.normal);
    face.offset = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : points) {
      face.offset = std::max(face.offset, face.normal.dot(point));
    }
    for (const int point : facet.points) {
      int& vertex = vertex_of_point[point];
      if (vertex < 0) {
        vertex = static_cast<int>(polytope.vertices.size());
        polytope.vertices.push_back(points[point]);
      }
      face.vertices.push_back(vertex);
    }
    polytope.faces.push_back(std::move(face));
  }
  return polytope;
}

}  // namespace

ConvexPolytope convexHull(const std::vector<Eigen::Vector3d>& points) {
  requirePositions(points);
  const SpanningFrame frame = detail::spanningFrame(points);
  if (frame.dimension < 3) return withoutFaces(points, frame);

  std::vector<Eigen::Vector3d> normalised;
  normalised.reserve(points.size());
  double largest_norm = 0;
  for (const Eigen::Vector3d& point : points) {
    normalised.push_back(frame.coordinates(point));
    largest_norm = std::max(largest_norm, point.stableNorm());
  }
  // Points far from the origin are rounded by more than their differences are. Along the widest
  // direction, so that a thin one is not merged away.
  const double rounding = std::numeric_limits<double>::epsilon() * largest_norm / frame.widths[0];
  const std::optional<std::vector<Facet>> facets = closedFacets(normalised, rounding);
  return facets ? withFaces(points, frame, *facets) : withoutFaces(points, frame);
}

}  // namespace fcl_prob
