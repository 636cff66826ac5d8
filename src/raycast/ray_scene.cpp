// A mesh of triangle fans in Embree; a filter function skips polygons by their number.
#include "raycast/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace enfilade {
namespace {

/// Embree's context, with the two polygons that a ray passes through.
struct SkipContext {
  RTCIntersectContext embree;  // first member: Embree hands its address back to the filter
  const std::uint32_t* polygon_of_triangle;
  std::uint32_t skip_a, skip_b;
};

void skip_filter(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const SkipContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const std::uint32_t polygon =
        context->polygon_of_triangle[RTCHitN_primID(args->hit, args->N, i)];
    if (polygon == context->skip_a || polygon == context->skip_b) args->valid[i] = 0;
  }
}

/// The same, with the hits that a ray has had; none of them stops it.
struct CrossingContext {
  SkipContext skip;
  std::vector<PaneCrossing>* found;
};

void note_crossing(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const CrossingContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    args->valid[i] = 0;
    const std::uint32_t polygon =
        context->skip.polygon_of_triangle[RTCHitN_primID(args->hit, args->N, i)];
    if (polygon == context->skip.skip_a || polygon == context->skip.skip_b) continue;
    // On the line between two triangles of a fan a ray meets both.
    const auto same = [polygon](const PaneCrossing& c) { return c.polygon == polygon; };
    if (std::any_of(context->found->begin(), context->found->end(), same)) continue;
    context->found->push_back({polygon, RTCRayN_tfar(args->ray, args->N, i), 1.0});
  }
}

}  // namespace

struct RayScene::Impl {
  /// Triangle fans of some of the polygons.
  struct Mesh {
    RTCScene scene = nullptr;
    std::vector<std::uint32_t> polygon_of_triangle;
    void release() const {
      if (scene != nullptr) rtcReleaseScene(scene);
    }
    void build(RTCDevice embree, std::span<const Polygon> polygons,
               const std::vector<std::uint32_t>& members, const Vec3& origin,
               RTCFilterFunctionN met);
  };

  RTCDevice device = nullptr;
  Mesh walls, panes;
  Vec3 center{0.0};
  float epsilon = 0.0f;
  std::vector<Vec3> normals;

  ~Impl() {
    walls.release();
    panes.release();
    if (device != nullptr) rtcReleaseDevice(device);
  }

  SkipContext context(std::uint32_t skip_a, std::uint32_t skip_b) const {
    SkipContext c;
    rtcInitIntersectContext(&c.embree);
    c.polygon_of_triangle = walls.polygon_of_triangle.data();
    c.skip_a = skip_a;
    c.skip_b = skip_b;
    return c;
  }

  RTCRay ray(const Vec3& from, const Vec3& unit_direction, double near_m, double far_m) const {
    const Vec3 o = from - center;
    RTCRay r{};
    r.org_x = static_cast<float>(o.x);
    r.org_y = static_cast<float>(o.y);
    r.org_z = static_cast<float>(o.z);
    r.dir_x = static_cast<float>(unit_direction.x);
    r.dir_y = static_cast<float>(unit_direction.y);
    r.dir_z = static_cast<float>(unit_direction.z);
    r.tnear = static_cast<float>(near_m);
    r.tfar = static_cast<float>(far_m);
    r.mask = 0xFFFFFFFFu;
    return r;
  }

  double near_m(RayStart start) const { return start == RayStart::in_air ? 0.0 : epsilon; }
  void build(std::span<const Polygon> polygons, std::span<const char> is_pane);
  RayHit closest(const Vec3& from, const Vec3& unit_direction, std::uint32_t skip, double near_m,
                 double far_m) const;
};

void RayScene::Impl::Mesh::build(RTCDevice embree, std::span<const Polygon> polygons,
                                 const std::vector<std::uint32_t>& members, const Vec3& origin,
                                 RTCFilterFunctionN met) {
  std::size_t vertices = 0, triangles = 0;
  for (const std::uint32_t k : members) {
    vertices += polygons[k].size();
    triangles += polygons[k].size() >= 3 ? polygons[k].size() - 2 : 0;
  }
  scene = rtcNewScene(embree);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  polygon_of_triangle.reserve(triangles);
  RTCGeometry mesh = rtcNewGeometry(embree, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (triangles > 0) {
    auto* xyz = static_cast<float*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
    if (xyz == nullptr || index == nullptr)
      throw RunError("Embree: not enough memory for the polygons; use a larger machine");
    std::uint32_t first = 0;
    for (const std::uint32_t k : members) {
      for (const Vec3& v : polygons[k]) {
        const Vec3 q = v - origin;
        *xyz++ = static_cast<float>(q.x);
        *xyz++ = static_cast<float>(q.y);
        *xyz++ = static_cast<float>(q.z);
      }
      const auto n = static_cast<std::uint32_t>(polygons[k].size());
      for (std::uint32_t i = 2; i < n; ++i) {
        *index++ = first;
        *index++ = first + i - 1;
        *index++ = first + i;
        polygon_of_triangle.push_back(k);
      }
      first += n;
    }
  }
  rtcSetGeometryIntersectFilterFunction(mesh, met);
  rtcSetGeometryOccludedFilterFunction(mesh, met);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene, mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(embree);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
    throw RunError("Embree: not enough memory for its tree of the polygons; use a larger machine");
  if (error != RTC_ERROR_NONE)
    throw RunError("Embree: cannot build its tree of the polygons (its error " +
                   std::to_string(error) + "); report it with the scene");
}

void RayScene::Impl::build(std::span<const Polygon> polygons, std::span<const char> is_pane) {
  Box box;
  std::vector<std::uint32_t> opaque, passing;
  normals.reserve(polygons.size());
  for (std::uint32_t k = 0; k < polygons.size(); ++k) {
    for (const Vec3& v : polygons[k]) box.add(v);
    normals.push_back(normal(polygons[k]));
    (!is_pane.empty() && is_pane[k] != 0 ? passing : opaque).push_back(k);
  }
  center = box.empty() ? Vec3(0.0) : box.center();
  // A float's step at half the diagonal is 6e-8 of it; an intersection is good to a few such steps.
  epsilon = static_cast<float>(1e-6 * std::max(box.diagonal(), 1e-30));
  device = rtcNewDevice("threads=1,set_affinity=0");
  if (device == nullptr) {
    const bool memory = rtcGetDeviceError(nullptr) == RTC_ERROR_OUT_OF_MEMORY;
    throw RunError(std::string("Embree: cannot start") + (memory ? ": memory ran out" : "") +
                   "; it needs some 200 MiB beside the scene: raise the limits of memory and "
                   "threads (ulimit -a)");
  }
  walls.build(device, polygons, opaque, center, skip_filter);
  if (!passing.empty()) panes.build(device, polygons, passing, center, note_crossing);
}

RayScene::RayScene(std::span<const Polygon> polygons, std::span<const char> panes)
    : impl_(std::make_unique<Impl>()) {
  impl_->build(polygons, panes);
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::occluded(const Vec3& a, const Vec3& b, std::uint32_t skip_a, std::uint32_t skip_b,
                        RayStart start) const {
  const Vec3 d = b - a;
  const double length = glm::length(d);
  const double epsilon = impl_->epsilon;
  if (length <= 2.0 * epsilon) return false;
  RTCRay ray = impl_->ray(a, d / length, impl_->near_m(start), length - epsilon);
  SkipContext context = impl_->context(skip_a, skip_b);
  rtcOccluded1(impl_->walls.scene, &context.embree, &ray);
  return ray.tfar < 0.0f;
}

RayHit RayScene::Impl::closest(const Vec3& from, const Vec3& unit_direction, std::uint32_t skip,
                               double near_m, double far_m) const {
  RTCRayHit query{};
  query.ray = ray(from, unit_direction, near_m, far_m);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  SkipContext skipping = context(skip, skip);
  rtcIntersect1(walls.scene, &skipping.embree, &query);
  RayHit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.polygon = walls.polygon_of_triangle[query.hit.primID];
  hit.distance_m = query.ray.tfar;
  hit.front = glm::dot(unit_direction, normals[hit.polygon]) < 0.0;
  return hit;
}

RayHit RayScene::closest(const Vec3& from, const Vec3& direction, std::uint32_t skip,
                         double max_distance_m, RayStart start) const {
  const double length = glm::length(direction);
  if (!(length > 0.0)) return {};
  const Vec3 d = direction / length;
  const double epsilon = impl_->epsilon, near_m = impl_->near_m(start);
  const RayHit hit = impl_->closest(from, d, skip, near_m, max_distance_m);
  if (!hit.any() || hit.front) return hit;
  // A wall without thickness is two polygons in one place; the ray meets the one that faces it.
  RayHit twin = impl_->closest(from, d, hit.polygon, std::max(near_m, hit.distance_m - epsilon),
                               hit.distance_m + epsilon);
  return twin.any() && twin.front && twin.polygon != skip ? twin : hit;
}

// One ray at a time. Embree 3's streams of incoherent rays gave the same hits in the same time
// (2.6e5 random rays among 3,000 quads, some of them back to back), its coherent mode other hits
// and less speed: nothing is gained by packets for rays that leave in all directions.
void RayScene::occluded(std::span<const Sight> segments, std::span<std::uint8_t> blocked,
                        RayStart start) const {
  ENFILADE_CHECK(segments.size() == blocked.size(), std::to_string(blocked.size()));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Sight& s = segments[i];
    blocked[i] = occluded(s.a, s.b, s.skip_a, s.skip_b, start) ? 1 : 0;
  }
}

void RayScene::closest(std::span<const Ray> rays, std::span<RayHit> hits, RayStart start) const {
  ENFILADE_CHECK(rays.size() == hits.size(), std::to_string(hits.size()));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Ray& r = rays[i];
    hits[i] = closest(r.from, r.direction, r.skip, r.max_distance_m, start);
  }
}

bool RayScene::has_panes() const { return impl_->panes.scene != nullptr; }

void RayScene::crossings(const Vec3& from, const Vec3& direction, double max_distance_m,
                         std::uint32_t skip_a, std::uint32_t skip_b, RayStart start,
                         std::vector<PaneCrossing>& found) const {
  found.clear();
  const double length = glm::length(direction);
  if (!has_panes() || !(length > 0.0)) return;
  const Vec3 d = direction / length;
  CrossingContext context{impl_->context(skip_a, skip_b), &found};
  context.skip.polygon_of_triangle = impl_->panes.polygon_of_triangle.data();
  RTCRayHit query{};
  query.ray = impl_->ray(from, d, impl_->near_m(start), max_distance_m);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->panes.scene, &context.skip.embree, &query);
  for (PaneCrossing& c : found) c.cosine = -glm::dot(d, impl_->normals[c.polygon]);
  std::sort(found.begin(), found.end(), [](const PaneCrossing& a, const PaneCrossing& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.polygon < b.polygon;
  });
}

double RayScene::epsilon_m() const { return impl_->epsilon; }

std::size_t RayScene::bytes() const {
  // Embree's BVH takes about 100 bytes a triangle beside the vertices (measured with its memory
  // monitor).
  const std::size_t triangles =
      impl_->walls.polygon_of_triangle.size() + impl_->panes.polygon_of_triangle.size();
  return triangles * (100 + 12 + 36) + impl_->normals.size() * sizeof(Vec3);
}

}  // namespace enfilade
