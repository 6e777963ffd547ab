// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/radiation/edge_diffraction.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/real_functions.h"
#include "sim/core/numbers/rotation.h"
#include "sim/core/process/parallel.h"
#include "sim/scattering/coefficients/fade_windows.h"
#include "sim/scattering/coefficients/material.h"
#include "sim/scattering/coefficients/material_edge.h"
#include "sim/scattering/coefficients/wedge_diffraction.h"
#include "sim/scattering/geometry/image_transform.h"
#include "sim/scattering/geometry/look_basis.h"
#include "sim/scattering/radiation/multiple_diffraction.h"

namespace seaglint {

namespace {

// Within this angle of the specular direction, rad, the end-point contributions are evaluated at this offset to either
// side, where their poles cancel: an error of the offset squared times their second derivative, 1e-6 at 10 deg.
constexpr double kAtSpecular = 1e-3, kAside = 1e-4;

// n x (k^ x E): half of the PO current times eta, for a wave incident from vacuum.
Vec3 half_po_current(const Vec3& n, const Vec3& k_hat, const Vec3& E) { return n.cross(k_hat.cross(E)); }

// Weight 0..1 of the end-point contribution of the last reflector, for the slopes of psi per metre of the edge's face,
// `of_face`, and of its image on that reflector, `of_last`; `across`: a metre of either, seen along the beam across the
// edge. Both slopes are zero in the direction of the beam, where the poles cancel: only the difference of the two
// contributions must stay finite, 1 / of_last - 1 / of_face = (1 - of_last / of_face) / of_last. Where the edge is not
// parallel to the reflector, `of_last` has a second zero on Keller's cone, a pole of this difference. psi varies there
// along the shadow-boundary line, which radiates from its ends only, and beam_boundary.h leaves the contribution there,
// by the slope across the line.
double last_end_weight(double of_last, double of_face, double across) {
  const double not_common = std::max(1 - of_last / of_face, 0.0);
  return 1 - smooth_taper(std::abs(of_last) / (not_common * across), kSlopeWindow);
}

}  // namespace

std::array<double, 2> reflected_face_weights(const WedgeFrame& wedge, const EdgeIllumination& in,
                                             const EdgeIllumination& out) {
  std::array<double, 2> weights{};
  const Vec3 &k_hat = in.direction, s = -out.direction;
  for (int i = 0; i < 2; ++i) {
    const auto& [x, n, t] = wedge.face[i];
    if (n.dot(k_hat) >= 0 || n.dot(s) <= 0) continue;
    weights[i] = 1;
    if (out.reflections > 0) weights[i] = reflected_edge_weight(n, t, k_hat, s, out.first_reflector_normal);
    if (in.reflections > 0)
      weights[i] = std::min(weights[i], reflected_edge_weight(n, t, -s, -k_hat, in.first_reflector_normal));
    if (in.reflections + out.reflections > kMaxCorrectedReflections) {
      weights[i] *= smooth_taper((s - reflect_direction(k_hat, n)).norm(), kOffSpecularWindow);
    }
  }
  return weights;
}

std::array<double, 4> endpoint_correction(const WedgeFace& face, const EdgeIllumination& in,
                                          const EdgeIllumination& out) {
  std::array<double, 4> ends{};
  if (out.reflections == 0) return ends;
  const Vec3 &k_hat = in.direction, s = -out.direction;
  const Vec3 beam = reflect_direction(k_hat, face.n), n = out.first_reflector_normal.dot(beam) < 0
                                                              ? out.first_reflector_normal
                                                              : Vec3(-out.first_reflector_normal);
  // Directions on the last reflector, of the same lengths as at the edge: along the edge's shadow boundary, and into
  // the lit region.
  const double cosine = n.dot(beam), lands = beam_incidence_taper(beam, s, n);
  const Vec3 shadow = face.t - face.t.dot(n) / cosine * beam, into = face.x - face.x.dot(n) / cosine * beam;
  const double area = shadow.cross(into).norm(), across = std::abs(face.n.dot(beam)) / face.t.cross(beam).norm();
  const auto about_edge = [&](const Vec3& x) { return std::atan2(face.n.dot(x), face.x.dot(x)); };
  const double off = std::remainder(about_edge(s) - about_edge(beam), 2 * kPi);
  const auto add = [&](double angle, double weight) {
    const Vec3 on_cone = axis_rotation(angle, face.t) * beam, away = on_cone - beam;
    const Quaternion turned = rotation_between(s, on_cone);
    const std::array<Vec3, 2> received{turned * out.E_h, turned * out.E_v};
    const double ends_there = lands * last_end_weight(away.dot(into), away.dot(face.x), across);
    // Where the last reflector has no end-point contribution, that of the edge's face is used alone, away from its
    // pole.
    const double alone = 1 - (1 - ends_there) * smooth_taper(std::abs(off), kOffSpecularWindow);
    for (int t = 0; t < 2; ++t) {
      const Vec3& E = t == 0 ? in.E_h : in.E_v;
      // The integral of e^{jk away.x u} du from 0 on, times -jk / 2 pi.
      Vec3 of_face = alone / (2 * kPi * away.dot(face.x)) * half_po_current(face.n, k_hat, E), of_last = Vec3::Zero();
      if (ends_there > 0)
        of_last =
            ends_there * area / (2 * kPi * away.dot(into)) * half_po_current(n, beam, -reflect_direction(E, face.n));
      for (int r = 0; r < 2; ++r)
        ends[2 * r + t] += weight * (received[r].dot(of_face) + reflect_direction(received[r], n).dot(of_last));
    }
  };
  if (std::abs(off) < kAtSpecular) {
    add(-kAside, 0.5);
    add(kAside, 0.5);
  } else {
    add(off, 1);
  }
  return ends;
}

namespace {

// A sharp edge of one request, with the surfaces of its faces at every wavenumber where one is no perfect conductor.
struct RadiatingEdge {
  const EdgeDiffractionRequest& request;
  const SharpEdge& edge;
  std::span<const MaterialFaces> materials;
};

// Pattern of an incident and an exit path at an edge of a perfect conductor. The received polarisation is the field of
// the receiver's wave at the edge. A sheet's thickness changes it with the wavenumber.
Pattern pattern(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out,
                std::span<const double> wavenumbers, double shadow = kShadowBoundaryGuard) {
  const auto received = [&](const auto& J_h, const auto& J_v) -> ScatteringMatrix {
    return {out.E_h.dot(J_h), out.E_h.dot(J_v), out.E_v.dot(J_h), out.E_v.dot(J_v)};
  };
  const auto [J_h, J_v] = equivalent_edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction, shadow);
  Pattern pattern{received(J_h, J_v)};
  if (wedge.thickness_m <= 0) return pattern;
  const auto [T_h, T_v] = thick_edge_currents(wedge, in.direction, {in.E_h, in.E_v}, -out.direction);
  const ScatteringMatrix constant = received(T_h.constant, T_v.constant),
                         logarithm = received(T_h.logarithm, T_v.logarithm);
  for (const double k : wavenumbers) {
    const double kt = k * wedge.thickness_m;
    ScatteringMatrix& thick = pattern.at_node.emplace_back(pattern.value);
    for (int i = 0; i < 4; ++i) thick[i] += kt * (constant[i] + std::log(kt) * logarithm[i]);
  }
  return pattern;
}

// Diffracted field of the edge via reflectors, in addition to the beams that its faces reflect to them, with the weight
// of each face (endpoint_correction()).
Pattern edge_field_pattern(const WedgeFrame& wedge, const std::array<double, 2>& weights, const EdgeIllumination& in,
                           const EdgeIllumination& out, std::span<const double> wavenumbers) {
  Pattern sum = pattern(wedge, in, out, wavenumbers, kReflectedBoundaryGuard);
  for (int f = 0; f < 2; ++f) {
    if (weights[f] <= 0) continue;
    const std::array<double, 4> ends = endpoint_correction(wedge.face[f], in, out);
    Pattern weighted;
    for (int i = 0; i < 4; ++i) weighted.value[i] = weights[f] * ends[i];
    sum += weighted;
  }
  return sum;
}

// Where that field is not separable from the beam: fringe currents, of the wave that is reflected more often, since the
// facets radiate that one directly to the receiver. A path with more reflections on its exit is replaced by its
// reciprocal; with equal numbers the mean of both is used.
Pattern fringe_pattern(const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out,
                       std::span<const double> wavenumbers) {
  if (in.reflections > out.reflections) return pattern(wedge, in, out, wavenumbers);
  if (in.reflections < out.reflections) return transposed(pattern(wedge, out, in, wavenumbers));
  return reciprocal_mean(pattern(wedge, in, out, wavenumbers), pattern(wedge, out, in, wavenumbers));
}

// Adds the pattern of a path; nothing where its tapers are zero near the forward direction. The part that belongs
// together with the facets' direct radiation, and that of the boundary terms of the beams on the last reflector, whose
// wave and order of reflections it shares.
void add_path(const RadiatingEdge& of, const WedgeFrame& wedge, const EdgeIllumination& in, const EdgeIllumination& out,
              std::optional<Pattern>& sum) {
  const std::span<const double> wavenumbers = of.request.wavenumbers;
  const auto add = [&](Pattern part, double weight) {
    part *= weight;
    if (sum) {
      *sum += part;
    } else {
      sum = std::move(part);
    }
  };
  if (in.reflections + out.reflections == 0) return add(pattern(wedge, in, out, wavenumbers), 1);
  std::array<double, 2> reflecting = reflected_face_weights(wedge, in, out);
  const double by_edge = std::ranges::max(reflecting),
               by_beam = (1 - by_edge) * fringe_forward_taper(in.direction, -out.direction);
  if (by_edge > 0) {
    for (double& weight : reflecting) weight /= by_edge;
    add(edge_field_pattern(wedge, reflecting, in, out, wavenumbers), by_edge);
  }
  if (by_beam > 0) add(fringe_pattern(wedge, in, out, wavenumbers), by_beam);
}

// Pattern of a pair of illuminations; none where it vanishes. For one antenna a path and its reciprocal have the same
// length and are one contribution. For two antennas only the transmitter's wave gives Keller's field together with the
// facets.
std::optional<Pattern> pair_pattern(const RadiatingEdge& of, const WedgeFrame& wedge, const EdgeIllumination& in,
                                    const EdgeIllumination& out) {
  std::optional<Pattern> sum;
  add_path(of, wedge, in, out, sum);
  if (of.request.geometry.monostatic && &in != &out) add_path(of, wedge, out, in, sum);
  return sum;
}

// Pattern of direct incident and exit paths at an edge with a face that is no perfect conductor.
Pattern material_pattern(const WedgeFrame& wedge, std::span<const MaterialFaces> materials, const EdgeIllumination& in,
                         const EdgeIllumination& out) {
  Pattern pattern;
  for (const MaterialFaces& faces : materials) {
    const auto [J_h, J_v] =
        material_edge_currents(wedge, faces, in.direction, {in.E_h, in.E_v}, -out.direction, kShadowBoundaryGuard);
    pattern.at_node.push_back({component_along(out.E_h, J_h), component_along(out.E_h, J_v),
                               component_along(out.E_v, J_h), component_along(out.E_v, J_v)});
  }
  return pattern;
}

// The interval of the edge that both paths have in common, `first` to `last` metres from its start.
EdgeInterval common_interval(const BistaticGeometry& geometry, const EdgeIllumination& in, const EdgeIllumination& out,
                             double first, double last) {
  EdgeInterval interval;
  interval.length = last - first;
  const RadarBasis &t = geometry.transmit, &r = geometry.receive;
  const double slope = t.r.dot(in.image_edge_direction) + r.r.dot(out.image_edge_direction);  // of psi along the edge
  for (int end = 0; end < 2; ++end) {
    const double s = end == 0 ? first : last;
    const Vec3 X = in.image_start + s * in.image_edge_direction, Y = out.image_start + s * out.image_edge_direction;
    interval.psi[end] = t.r.dot(X) + r.r.dot(Y);
    // An end belongs to the path whose interval ends there, and slides with it.
    const bool by_in = end == 0 ? in.s[0] >= out.s[0] : in.s[1] <= out.s[1];
    const Vec2 slide = slope * (by_in ? in.slide[end] : out.slide[end]);
    PathGradient& gradient = interval.gradient[end];
    if (by_in) {
      gradient.transmit_slide = slide.x() * t.h + slide.y() * t.v;
    } else {
      gradient.receive_slide = slide.x() * r.h + slide.y() * r.v;
    }
    gradient.transmit = X + gradient.transmit_slide;
    gradient.receive = Y + gradient.receive_slide;
  }
  return interval;
}

// Appends the contributions of all intervals of an edge common to an illumination by the transmitter and one by the
// receiver, with at most max_bounces interactions, the diffraction included.
void append_single_diffraction(const RadiatingEdge& of, EdgeIlluminations incoming, EdgeIlluminations outgoing,
                               std::vector<Contribution>& contributions) {
  const SharpEdge& edge = of.edge;
  const std::span<const Facet> facets = of.request.scatterer.facets();
  const BistaticGeometry& geometry = of.request.geometry;
  const int max_reflections = std::min(kMaxEdgeReflections, of.request.settings.max_bounces - 1);
  const auto append = [&](const EdgeIllumination& in, const EdgeIllumination& out) {
    const double first = std::max(in.s[0], out.s[0]), last = std::min(in.s[1], out.s[1]);
    const int reflections = in.reflections + out.reflections;
    if (last - first <= kCoincident || reflections > max_reflections) return;
    const WedgeFrame* wedge = illuminated_wedge(edge, in.direction);
    if (!wedge || illuminated_wedge(edge, out.direction) != wedge) return;
    const std::optional<Pattern> pattern =
        edge.conducts ? pair_pattern(of, *wedge, in, out) : material_pattern(*wedge, of.materials, in, out);
    if (!pattern) return;
    const Mechanism direct = wedge->N < 1 ? Mechanism::kConcaveEdge : Mechanism::kSingleDiffraction;
    const ContributionSource source{edge.facet[0], facets[edge.facet[0]].part, facets[edge.facet[1]].part,
                                    static_cast<std::uint8_t>(reflections + 1),
                                    reflections > 0 ? Mechanism::kReflectedEdge : direct};
    contributions.emplace_back(*pattern, source, common_interval(geometry, in, out, first, last));
  };
  for (std::size_t a = 0; a < incoming.size(); ++a) {
    for (std::size_t b = geometry.monostatic ? a : 0; b < outgoing.size(); ++b) append(*incoming[a], *outgoing[b]);
  }
}

// In sides of the smallest illuminated patch kept.
constexpr double kMinRunForMultiple = 42, kMinRunForHighOrder = 280;

// Materials of the target at every wavenumber, for the edges that they bound.
class EdgeMaterials {
 public:
  EdgeMaterials(const Scatterer& scatterer, std::span<const double> wavenumbers)
      : scatterer_(scatterer), wavenumbers_(wavenumbers) {
    if (std::ranges::all_of(scatterer.edges().edges, &SharpEdge::conducts)) return;
    for (const MaterialSpec& material : scatterer.materials()) {
      std::vector<MaterialSurface>& surfaces = surfaces_.emplace_back();
      for (const double k : wavenumbers_) surfaces.emplace_back(material, k);
    }
  }

  // Surfaces of both faces per wavenumber; empty for perfect conductors.
  std::vector<MaterialFaces> of(const SharpEdge& edge) const {
    std::vector<MaterialFaces> faces;
    if (edge.conducts) return faces;
    const auto material = [&](int i) { return scatterer_.facets()[edge.facet[i]].material; };
    const MaterialSpec& first = scatterer_.materials()[material(0)];
    const bool is_sheet = edge.is_free_edge() && first.kind == SurfaceKind::kLayers && first.backing == Backing::kAir;
    for (std::size_t q = 0; q < wavenumbers_.size(); ++q)
      faces.push_back({{&surfaces_[material(0)][q], &surfaces_[material(1)][q]}, wavenumbers_[q], is_sheet});
    return faces;
  }

 private:
  const Scatterer& scatterer_;
  std::span<const double> wavenumbers_;
  std::vector<std::vector<MaterialSurface>> surfaces_;  // [material][wavenumber]
};

}  // namespace

MultipleDiffractionLimits multiple_diffraction_limits(const Scatterer& scatterer, const TracingSettings& settings,
                                                      double lowest) {
  const double patch = min_patch(scatterer, settings);
  return {kMinRunForMultiple * patch, kMinRunForHighOrder * patch, min_amplitude(scatterer, settings, lowest), lowest};
}

void edge_diffraction(const EdgeDiffractionRequest& request,
                      const std::function<void(std::size_t, std::span<const Contribution>)>& visit) {
  const Scatterer& scatterer = request.scatterer;
  const IlluminationByEdge& incoming = request.incoming;
  const GrazingWaves grazing{
      scatterer, request.geometry, request.wavenumbers, request.outgoing,
      multiple_diffraction_limits(scatterer, request.settings, std::ranges::min(request.wavenumbers))};
  const std::vector<SharpEdge>& edges = scatterer.edges().edges;
  const EdgeMaterials materials(scatterer, request.wavenumbers);
  // Chunks with about equal numbers of edge illuminations.
  const auto chunk_start = [&](std::size_t chunk) {
    return chunk < kEdgeChunks ? incoming.edge_after(incoming.all().size() * chunk / kEdgeChunks)
                               : static_cast<int>(edges.size());
  };
  const auto is_rejected = [&](const Contribution& contribution) {
    const auto& [facet, part, other_part, bounces, mechanism] = contribution.source;
    return !request.settings.filter.accepts_edge(part, other_part, bounces, mechanism);
  };
  parallel_for(kEdgeChunks, request.threads, [&](std::size_t chunk) {
    std::vector<Contribution> contributions;
    for (int edge = chunk_start(chunk); edge < chunk_start(chunk + 1); ++edge) {
      contributions.clear();
      const std::vector<MaterialFaces> faces = materials.of(edges[edge]);
      append_single_diffraction({request, edges[edge], faces}, incoming.of(edge), request.outgoing.of(edge),
                                contributions);
      if (edges[edge].conducts) trace_multiple_diffraction(grazing, incoming.of(edge), contributions);
      std::erase_if(contributions, is_rejected);
      if (!contributions.empty()) visit(chunk, contributions);
    }
  });
}

}  // namespace seaglint
