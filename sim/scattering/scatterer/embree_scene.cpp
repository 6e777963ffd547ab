// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scattering/scatterer/embree_scene.h"

#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "sim/geometry/mesh/coinciding_faces.h"

namespace seaglint {

struct RayScene::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  // By facet: the unit normal of one-sided facets that coincide with others of opposite orientation, else 0. Empty
  // where there are none.
  std::vector<Vec3> coinciding_normal;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
};

namespace {

constexpr std::size_t kPacket = 16;  // rays that Embree traces together

// Embree omits triangles with corners beyond 1.844e18 without an error.
constexpr double kMaxCoordinate = 1e18;  // m

// Sets denormal numbers to zero, as Embree requires, and restores the caller's floating-point mode at the end of the
// scope.
class DenormalsAreZero {
 public:
  DenormalsAreZero() : before_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~DenormalsAreZero() { _mm_setcsr(before_); }
  DenormalsAreZero(const DenormalsAreZero&) = delete;
  DenormalsAreZero& operator=(const DenormalsAreZero&) = delete;

 private:
  unsigned before_;
};

}  // namespace

namespace {

// Nodes of the builder, in its own memory: a leaf, or an inner node where box < 0.
struct Built {
  int box = -1;
};
struct BuiltNode : Built {
  unsigned children = 0;
  std::array<Built*, kMaxChildren> child{};
  std::array<RTCBounds, kMaxChildren> bounds{};
};

// Normals as RayScene::Impl::coinciding_normal.
std::vector<Vec3> coinciding_normals(std::span<const Facet> facets) {
  TriangleMesh mesh;
  for (const Facet& facet : facets) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), facet.corner.begin(), facet.corner.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_material.push_back(facet.material);
  }
  const auto kind = [](std::uint32_t, std::uint32_t) { return Coincidence::kSheet; };
  std::vector<Vec3> normals;
  for (const std::uint32_t f : find_coinciding_faces(mesh, {{}, kind}).all) {
    if (facets[f].two_sided) continue;
    normals.resize(facets.size(), Vec3::Zero());
    normals[f] = facets[f].normal;
  }
  return normals;
}

// Embree's filter of hits: rejects those of coinciding facets that face away from the ray.
void reject_backs(const RTCFilterFunctionNArguments* arguments) {
  const auto& normals = *static_cast<const std::vector<Vec3>*>(arguments->geometryUserPtr);
  for (unsigned lane = 0; lane < arguments->N; ++lane) {
    if (arguments->valid[lane] == 0) continue;
    const Vec3& normal = normals[RTCHitN_primID(arguments->hit, arguments->N, lane)];
    const Vec3 direction(RTCRayN_dir_x(arguments->ray, arguments->N, lane),
                         RTCRayN_dir_y(arguments->ray, arguments->N, lane),
                         RTCRayN_dir_z(arguments->ray, arguments->N, lane));
    if (normal.dot(direction) > 0) arguments->valid[lane] = 0;
  }
}

float rounded_down(double x) {
  const auto f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float rounded_up(double x) { return -rounded_down(-x); }

RTCBuildPrimitive primitive(const Box3& box, unsigned number) {
  RTCBuildPrimitive p;
  p.lower_x = rounded_down(box.lower.x());
  p.lower_y = rounded_down(box.lower.y());
  p.lower_z = rounded_down(box.lower.z());
  p.upper_x = rounded_up(box.upper.x());
  p.upper_y = rounded_up(box.upper.y());
  p.upper_z = rounded_up(box.upper.z());
  p.geomID = 0;
  p.primID = number;
  return p;
}

template <typename T>
T* create(RTCThreadLocalAllocator allocator) {
  return new (rtcThreadLocalAlloc(allocator, sizeof(T), alignof(T))) T;
}

BuiltNode& node_at(void* built) { return static_cast<BuiltNode&>(*static_cast<Built*>(built)); }

std::int32_t lay_out(const BuiltNode& built, std::vector<BvhNode>& nodes) {
  const auto index = static_cast<std::int32_t>(nodes.size());
  nodes.emplace_back();
  BvhNode node;
  node.children = static_cast<int>(built.children);
  for (unsigned i = 0; i < built.children; ++i) {
    const RTCBounds& b = built.bounds[i];
    const Built& child = *built.child[i];
    node.child[i] = {child.box >= 0 ? -1 - child.box : lay_out(static_cast<const BuiltNode&>(child), nodes),
                     {b.lower_x, b.lower_y, b.lower_z},
                     {b.upper_x, b.upper_y, b.upper_z}};
  }
  nodes[index] = node;
  return index;
}

}  // namespace

std::vector<BvhNode> build_bvh(std::span<const Box3> boxes) {
  std::vector<BvhNode> nodes;
  if (boxes.empty()) return nodes;
  std::vector<RTCBuildPrimitive> primitives;
  primitives.reserve(boxes.size());
  for (const Box3& box : boxes) primitives.push_back(primitive(box, static_cast<unsigned>(primitives.size())));

  // One building thread, so that the tree does not depend on the machine's load.
  const RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
  if (!device) throw std::runtime_error("Embree: no device");
  const RTCBVH bvh = rtcNewBVH(device);
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.byteSize = sizeof(arguments);
  arguments.maxBranchingFactor = kMaxChildren;
  arguments.maxDepth = kMaxLevels;
  arguments.sahBlockSize = 1;
  arguments.minLeafSize = 1;
  arguments.maxLeafSize = 1;
  arguments.bvh = bvh;
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = [](RTCThreadLocalAllocator allocator, unsigned, void*) -> void* {
    return static_cast<Built*>(create<BuiltNode>(allocator));
  };
  arguments.setNodeChildren = [](void* node, void** children, unsigned count, void*) {
    BuiltNode& built = node_at(node);
    built.children = count;
    for (unsigned i = 0; i < count; ++i) built.child[i] = static_cast<Built*>(children[i]);
  };
  arguments.setNodeBounds = [](void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) node_at(node).bounds[i] = *bounds[i];
  };
  arguments.createLeaf = [](RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* leaf, std::size_t,
                            void*) -> void* {
    Built* const built = create<Built>(allocator);
    built->box = static_cast<int>(leaf->primID);
    return built;
  };
  const auto* root = static_cast<const Built*>(rtcBuildBVH(&arguments));
  if (root && root->box >= 0) {
    // A single box is a leaf without a parent node.
    const RTCBuildPrimitive p = primitive(boxes[0], 0);
    BvhNode node;
    node.children = 1;
    node.child[0] = {-1, {p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}};
    nodes.push_back(node);
  } else if (root) {
    lay_out(static_cast<const BuiltNode&>(*root), nodes);
  }
  const RTCError error = rtcGetDeviceError(device);
  rtcReleaseBVH(bvh);
  rtcReleaseDevice(device);
  if (nodes.empty()) throw std::runtime_error("Embree: no tree, error " + std::to_string(static_cast<int>(error)));
  return nodes;
}

RayScene::RayScene(std::span<const Facet> facets) : impl_(std::make_unique<Impl>()) {
  // One building thread, so that the tree and the order of ties do not depend on the machine's load.
  impl_->device = rtcNewDevice("threads=1,set_affinity=0");
  if (!impl_->device) throw std::runtime_error("Embree: no device");
  impl_->scene = rtcNewScene(impl_->device);
  // Robust mode: of rays aimed at shared edges of closed surfaces 0.1 % pass through, without it 7 %.
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_HIGH);

  RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), 3 * facets.size()));
  auto* triangles = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                   3 * sizeof(unsigned), facets.size()));
  if (!vertices || !triangles) {
    rtcReleaseGeometry(geometry);
    throw std::bad_alloc();
  }
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(facets[f].corner[i].cwiseAbs().maxCoeff() < kMaxCoordinate)) {
        rtcReleaseGeometry(geometry);
        throw std::invalid_argument("Embree takes no triangle " + std::to_string(f) + " of " +
                                    std::to_string(facets.size()) + ": a corner lies beyond 1e18 m");
      }
      for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(facets[f].corner[i][axis]);
      *triangles++ = static_cast<unsigned>(3 * f + i);
    }
  }
  impl_->coinciding_normal = coinciding_normals(facets);
  if (!impl_->coinciding_normal.empty()) {
    rtcSetGeometryUserData(geometry, &impl_->coinciding_normal);
    rtcSetGeometryIntersectFilterFunction(geometry, reject_backs);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(impl_->scene);
  if (const RTCError error = rtcGetDeviceError(impl_->device); error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree builds no tree of " + std::to_string(facets.size()) + " triangles, error " +
                             std::to_string(static_cast<int>(error)));
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

void RayScene::first_hits(std::span<const Ray> rays, std::span<int> facets) const {
  RayBatch batch;
  for (const Ray& ray : rays) batch.add(ray.origin, ray.direction);
  first_hits(batch, facets);
}

void RayScene::first_hits(const RayBatch& rays, std::span<int> facets) const {
  const DenormalsAreZero mode;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(64) RTCRayHit16 packet{};
  const std::array<float*, 6> component{packet.ray.org_x, packet.ray.org_y, packet.ray.org_z,
                                        packet.ray.dir_x, packet.ray.dir_y, packet.ray.dir_z};
  for (std::size_t first = 0; first < rays.size(); first += kPacket) {
    const std::size_t used = std::min(kPacket, rays.size() - first);
    alignas(64) int valid[kPacket];
    for (std::size_t lane = 0; lane < kPacket; ++lane) {
      valid[lane] = lane < used ? -1 : 0;
      packet.ray.tnear[lane] = 0;
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.mask[lane] = ~0u;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    for (int i = 0; i < 6; ++i) std::copy_n(rays.component(i) + first, used, component[i]);
    rtcIntersect16(valid, impl_->scene, &context, &packet);
    for (std::size_t lane = 0; lane < used; ++lane) {
      facets[first + lane] =
          packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? kNoFacet : static_cast<int>(packet.hit.primID[lane]);
    }
  }
}

}  // namespace seaglint
