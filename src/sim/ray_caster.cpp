// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ray_caster.hpp"

#include <embree4/rtcore.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace lego_loam_sc {
namespace {

template <class Element>
void copy_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 const std::vector<Element>& elements) {
  void* buffer =
      rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
  if (buffer) std::memcpy(buffer, elements.data(), elements.size() * sizeof(Element));
}

}  // namespace

struct RayCaster::Scene {
  explicit Scene(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    copy_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
    copy_buffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    // One thread, so that the tree, and with it the choice between two triangles at the same
    // distance, is the same on every machine.
    tbb::task_arena(1).execute([&] { rtcJoinCommitScene(scene.get()); });
    if (rtcGetDeviceError(device.get()) != RTC_ERROR_NONE)
      throw std::runtime_error("Embree could not build the scene of " +
                               std::to_string(mesh.triangles.size()) + " triangles");
  }

  template <auto release>
  struct Release {
    template <class Handle>
    void operator()(Handle* handle) const {
      release(handle);
    }
  };
  template <class Handle, auto release>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release<release>>;

  Owned<RTCDevice, rtcReleaseDevice> device{rtcNewDevice(nullptr)};
  Owned<RTCScene, rtcReleaseScene> scene{rtcNewScene(device.get())};
};

RayCaster::RayCaster(Mesh mesh) : mesh_(std::move(mesh)), scene_(std::make_unique<Scene>(mesh_)) {}

RayCaster::~RayCaster() = default;

std::optional<Hit> RayCaster::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                   double max_range) const {
  const Eigen::Vector3f from = origin.cast<float>();
  const Eigen::Vector3f along = direction.cast<float>();
  RTCRayHit query{};
  query.ray.org_x = from.x();
  query.ray.org_y = from.y();
  query.ray.org_z = from.z();
  query.ray.dir_x = along.x();
  query.ray.dir_y = along.y();
  query.ray.dir_z = along.z();
  query.ray.tfar = static_cast<float>(max_range);
  query.ray.mask = 0xffffffff;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene_->scene.get(), &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const auto& triangle = mesh_.triangles[query.hit.primID];
  const auto corner = [&](int i) -> Eigen::Vector3d {
    return mesh_.vertices[triangle[i]].cast<double>();
  };
  const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  const double cosine = normal.dot(direction);
  const double range = normal.dot(corner(0) - origin) / cosine;
  // Single and double precision part only where the ray runs along the surface: no echo there.
  if (!(std::abs(range - query.ray.tfar) < 0.01)) return std::nullopt;
  return Hit{range, std::abs(cosine), mesh_.reflectivity[query.hit.primID]};
}

}  // namespace lego_loam_sc
