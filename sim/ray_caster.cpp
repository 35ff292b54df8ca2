// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ray_caster.hpp"

#include <embree4/rtcore.h>
#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <type_traits>

namespace lego_loam_sc {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kPacket = 8;

// Rays that Embree follows side by side.
struct Packet {
  Packet(const Vector3d& origin, std::span<const Vector3d> directions, double max_range) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      valid[i] = -1;
      query.ray.org_x[i] = static_cast<float>(origin.x());
      query.ray.org_y[i] = static_cast<float>(origin.y());
      query.ray.org_z[i] = static_cast<float>(origin.z());
      query.ray.dir_x[i] = static_cast<float>(directions[i].x());
      query.ray.dir_y[i] = static_cast<float>(directions[i].y());
      query.ray.dir_z[i] = static_cast<float>(directions[i].z());
      query.ray.tfar[i] = static_cast<float>(max_range);
      query.ray.mask[i] = 0xffffffff;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
  }

  alignas(32) std::array<int, kPacket> valid{};
  RTCRayHit8 query{};
};

template <class Element>
void copy_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
                 const std::vector<Element>& elements) {
  void* buffer =
      rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Element), elements.size());
  if (buffer) std::ranges::copy(elements, static_cast<Element*>(buffer));
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

RayCaster::RayCaster(const Mesh& mesh) : scene_(std::make_unique<Scene>(mesh)) {
  surfaces_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = [&](int k) -> Vector3d {
      return mesh.vertices[mesh.triangles[i][k]].cast<double>();
    };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    surfaces_.push_back({normal, normal.dot(corner(0)), mesh.reflectivity[i]});
  }
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;

std::optional<Hit> RayCaster::hit_on(unsigned triangle, const Vector3d& origin,
                                     const Vector3d& direction, float found_range) const {
  const Surface& surface = surfaces_[triangle];
  const double cosine = surface.normal.dot(direction);
  const double range = (surface.offset - surface.normal.dot(origin)) / cosine;
  // Single and double precision part only where the ray runs along the surface: no echo there.
  if (!(std::abs(range - found_range) < 0.01)) return std::nullopt;
  return Hit{range, std::abs(cosine), surface.reflectivity};
}

std::optional<Hit> RayCaster::cast(const Vector3d& origin, const Vector3d& direction,
                                   double max_range) const {
  std::optional<Hit> hit;
  cast(origin, {&direction, 1}, max_range, {&hit, 1});
  return hit;
}

void RayCaster::cast(const Vector3d& origin, std::span<const Vector3d> directions, double max_range,
                     std::span<std::optional<Hit>> hits) const {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  for (std::size_t first = 0; first < directions.size(); first += kPacket) {
    const std::size_t count = std::min(kPacket, directions.size() - first);
    Packet packet(origin, directions.subspan(first, count), max_range);
    rtcIntersect8(packet.valid.data(), scene_->scene.get(), &packet.query, &arguments);
    for (std::size_t i = 0; i < count; ++i) {
      const RTCRayHit8& found = packet.query;
      hits[first + i] =
          found.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
              ? std::nullopt
              : hit_on(found.hit.primID[i], origin, directions[first + i], found.ray.tfar[i]);
    }
  }
}

}  // namespace lego_loam_sc
